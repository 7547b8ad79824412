#include "nacre/render/guide_sky.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "nacre/optics/fresnel.h"
#include "nacre/render/guide_lobe.h"
#include "nacre/spectrum/color.h"

namespace nacre {

namespace {

// 0.7 degrees: windows and lamps keep their shapes; the sun is a cell.
constexpr DirectionCube fine{128};
constexpr int samples_a_side = 3;  // of the light, in each cell
// 2.8 degrees, for what is blurred anyway.
constexpr DirectionCube coarse{32};
constexpr DirectionCube normals{16};

// Most proposals go to the bright part itself, some to its surroundings: refraction through the
// true boundary displaces them, and paths near an edge would otherwise have too small a density
// (fireflies).
constexpr float widened_share = 0.2f, widening = 0.06f;

// The walk finds the sky well enough as long as what stands out of its mean makes less variance
// than this over uniform directions, relative to the squared mean: a soft sky has some 0.1, a half
// that shines and one that does not 1, windows in a room 10 and more, the sun thousands.
constexpr double least_variance = 1.;

float luminance_towards(const Light& light, const Vec3f& d, const Wavelengths& rgb) {
    const Spectral l = light.radiance(nullptr, d, rgb);
    return luminance({l[0], l[1], l[2]});
}

}  // namespace

std::size_t DirectionCube::cell(const Vec3f& d) const {
    const float x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
    float along, a, b;
    std::size_t face;
    if (x >= y && x >= z)
        along = x, a = d.y, b = d.z, face = d.x < 0.f ? 1 : 0;
    else if (y >= z)
        along = y, a = d.z, b = d.x, face = d.y < 0.f ? 3 : 2;
    else
        along = z, a = d.x, b = d.y, face = d.z < 0.f ? 5 : 4;
    const float scale = 0.5f * static_cast<float>(side);
    const auto place = [&](float t) {
        return static_cast<std::size_t>(
            std::clamp(static_cast<int>((t / along + 1.f) * scale), 0, side - 1));
    };
    const auto n = static_cast<std::size_t>(side);
    return (face * n + place(b)) * n + place(a);
}

Vec3f DirectionCube::direction(std::size_t cell, Vec2f uv) const {
    const auto n = static_cast<std::size_t>(side);
    const std::size_t face = cell / (n * n);
    const float scale = 2.f / static_cast<float>(side);
    const float a = (static_cast<float>(cell % n) + uv.x) * scale - 1.f;
    const float b = (static_cast<float>(cell / n % n) + uv.y) * scale - 1.f;
    const float along = face % 2 ? -1.f : 1.f;
    const Vec3f d = face < 2   ? Vec3f(along, a, b)
                    : face < 4 ? Vec3f(b, along, a)
                               : Vec3f(a, b, along);
    return normalize(d);
}

float DirectionCube::per_solid_angle(const Vec3f& d) const {
    const float m = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
    const auto n = static_cast<float>(side);
    return 0.25f * n * n / (m * m * m);
}

CubeDensity::CubeDensity(DirectionCube cube, const std::vector<float>& weights)
    : cube_(cube), share_(weights.size(), 0.f) {
    double sum = 0.;
    for (const float w : weights) sum += w;
    double running = 0.;
    for (std::size_t c = 0; c < weights.size(); ++c) {
        if (!(weights[c] > 0.f)) continue;
        share_[c] = static_cast<float>(weights[c] / sum);
        cells_.push_back(static_cast<std::uint32_t>(c));
        cumulative_.push_back(static_cast<float>((running += weights[c]) / sum));
    }
}

Vec3f CubeDensity::sample(float u, Vec2f within) const {
    const auto at = std::upper_bound(cumulative_.begin(), cumulative_.end() - 1, u);
    return cube_.direction(cells_[static_cast<std::size_t>(at - cumulative_.begin())], within);
}

std::shared_ptr<const GuideSky> GuideSky::of(const Light& light, float eta, float spread) {
    if (light.is_uniform()) return nullptr;
    const Wavelengths rgb = Wavelengths::rgb_bands();
    // Mean luminance of each cell, and its solid angle.
    std::vector<float> flux(fine.size()), solid_angle(fine.size());
    tbb::parallel_for(std::size_t(0), fine.size(), [&](std::size_t c) {
        float sum = 0.f;
        for (int k = 0; k < samples_a_side * samples_a_side; ++k) {
            const auto place = [](int i) {
                return (static_cast<float>(i) + 0.5f) / static_cast<float>(samples_a_side);
            };
            const Vec2f uv{place(k % samples_a_side), place(k / samples_a_side)};
            sum += luminance_towards(light, fine.direction(c, uv), rgb);
        }
        solid_angle[c] = 1.f / fine.per_solid_angle(fine.center(c));
        flux[c] = sum * solid_angle[c] / static_cast<float>(samples_a_side * samples_a_side);
    });
    double total = 0., sphere = 0.;
    for (std::size_t c = 0; c < fine.size(); ++c) total += flux[c], sphere += solid_angle[c];
    const auto mean = static_cast<float>(total / sphere);

    auto sky = std::make_shared<GuideSky>();
    double bright = 0., squared = 0.;
    std::vector<float> coarse_flux(coarse.size(), 0.f);
    for (std::size_t c = 0; c < fine.size(); ++c) {
        flux[c] = std::max(0.f, flux[c] - mean * solid_angle[c]);
        bright += flux[c];
        squared += double(flux[c]) * flux[c] / solid_angle[c];
        coarse_flux[coarse.cell(fine.center(c))] += flux[c];
    }
    if (!(squared * sphere > least_variance * total * total)) return nullptr;
    sky->flux_ = static_cast<float>(bright);
    sky->fine_share_ = spread > 0.f ? 0.f : 1.f - widened_share;
    sky->fine_ = CubeDensity(fine, flux);

    std::vector<std::pair<Vec3f, float>> lamps;
    for (std::size_t c = 0; c < coarse.size(); ++c)
        if (coarse_flux[c] > 1e-5f * sky->flux_)
            lamps.emplace_back(coarse.center(c), coarse_flux[c]);
    const float alpha = std::max(spread, widening);
    std::vector<float> wide(coarse.size());
    tbb::parallel_for(std::size_t(0), coarse.size(), [&](std::size_t c) {
        const GuideLobe lobe{coarse.center(c), alpha * alpha};
        float sum = 0.f;
        for (const auto& [direction, share] : lamps) sum += share * lobe.pdf(direction);
        wide[c] = sum / coarse.per_solid_angle(lobe.axis);
    });
    sky->wide_ = CubeDensity(coarse, wide);

    sky->normals_ = normals;
    sky->strengths_.resize(normals.size());
    tbb::parallel_for(std::size_t(0), normals.size(), [&](std::size_t c) {
        const Vec3f n = normals.center(c);
        float sum = 0.f, cosines = 0.f;
        for (const auto& [direction, share] : lamps) {
            const float cos_out = dot(direction, n);
            if (cos_out < 0.02f) continue;
            const float cos_in = refracted_cosine(cos_out, eta);
            const float value =
                share * cos_out / (eta * eta * cos_in) * (1.f - fresnel_dielectric(cos_out, eta));
            sum += value;
            cosines += value * cos_in;
        }
        if (sum > 0.f) sky->strengths_[c] = {sum, cosines / sum};
    });
    constexpr int steps = 64;  // over the cosine outside
    for (int i = 0; i < steps; ++i) {
        const float cos_out = (static_cast<float>(i) + 0.5f) / steps;
        sky->rest_ += cos_out / (eta * eta * refracted_cosine(cos_out, eta)) *
                      (1.f - fresnel_dielectric(cos_out, eta));
    }
    sky->rest_ *=
        2.f * std::numbers::pi_v<float> / steps * static_cast<float>((total - bright) / sphere);
    for (const Strength& s : sky->strengths_) sky->most_ = std::max(sky->most_, s.value);
    return sky->most_ > 0.f ? sky : nullptr;
}

std::shared_ptr<const GuideSky> GuideSkies::of(const Light& light, float eta, float spread) {
    const auto [place, is_new] = made_.try_emplace({&light, eta, spread});
    if (is_new) place->second = GuideSky::of(light, eta, spread);
    return place->second;
}

Vec3f GuideSky::sample(Random& random) const {
    const Vec2f choice = random.next2(), within = random.next2();
    return (choice.x < fine_share_ ? fine_ : wide_).sample(choice.y, within);
}

float GuideSky::pdf(const Vec3f& direction) const {
    float density = (1.f - fine_share_) * wide_.pdf(direction);
    if (fine_share_ > 0.f) density += fine_share_ * fine_.pdf(direction);
    return density;
}

}  // namespace nacre
