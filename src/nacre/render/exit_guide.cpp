#include "nacre/render/exit_guide.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "nacre/math/sampling.h"
#include "nacre/optics/fresnel.h"
#include "nacre/render/guide_targets.h"
#include "nacre/scene/medium.h"

namespace nacre {

namespace {

// Below this cosine outside the density of refraction is cut off; it would go to infinity.
constexpr float min_cosine = 1e-4f;
// Proposals are made within so many mean free paths of the boundary: from deeper, exp(-4) of the
// light gets out.
constexpr float depth_in_free_paths = 4.f;
// A proposal is certain where it is expected to bring this share of the most that it could bring
// anywhere. Smaller: more proposals, each costing two rays. Chosen on the marble bunny, where
// variance times time has a flat minimum there.
constexpr float certain_share = 0.25f;
// Share of the proposals below a rough boundary that know of no light: facets turn light into
// directions that the planes would not.
constexpr float broad_share = 0.15f;
// Cells from which less than this can be won are left to the walk alone.
constexpr float min_probability = 0.01f;

// Direction inside that refracts to `outside` through a plane of normal n; eta is inside over
// outside.
Vec3f refract_in(const Vec3f& outside, const Vec3f& n, float cos_outside, float eta) {
    const float cos_inside = std::sqrt(1.f - (1.f - cos_outside * cos_outside) / (eta * eta));
    return (outside - n * cos_outside) * (1.f / eta) + n * cos_inside;
}

/// Mean of red, green and blue.
float mean_extinction(const Medium& medium, const Point3f& p) {
    const Spectral s = medium.coefficients(p, Wavelengths::rgb_bands()).sigma_t;
    return (s[0] + s[1] + s[2]) / 3.f;
}

/// The same, and over the line from a to b.
float mean_extinction(const Medium& medium, const Point3f& a, const Point3f& b) {
    constexpr int steps = 8;
    float sum = 0.f;
    for (int i = 0; i < steps; ++i)
        sum += mean_extinction(medium, a + (b - a) * ((static_cast<float>(i) + 0.5f) / steps));
    return sum / steps;
}

/// The same, and over a box.
float mean_extinction(const Medium& medium, const Box3f& box) {
    if (medium.homogeneous()) {
        const Vec3f sigma_t = medium.sigma_t->rgb();
        return (sigma_t.x + sigma_t.y + sigma_t.z) / 3.f * medium.scale;
    }
    constexpr int steps = 16;
    const Vec3f step = box.diagonal() * (1.f / steps);
    float sum = 0.f;
    for (int x = 0; x < steps; ++x)
        for (int y = 0; y < steps; ++y) {
            const Vec3f at{(static_cast<float>(x) + 0.5f) * step.x,
                           (static_cast<float>(y) + 0.5f) * step.y, 0.f};
            for (int z = 0; z < steps; ++z)
                sum += mean_extinction(
                    medium,
                    box.lower + at + Vec3f(0.f, 0.f, (static_cast<float>(z) + 0.5f) * step.z));
        }
    return sum / (steps * steps * steps);
}

}  // namespace

ExitGuide::ExitGuide(const Scene& scene, const Medium& medium, const ExitBoundary& boundary,
                     DistanceGrid& grid, GuideSkies& skies, const Work& work,
                     std::int32_t first_index)
    : eta_(boundary.eta), spread_(boundary.spread) {
    Box3f bounds;
    for (const std::uint32_t shape : boundary.shapes) bounds.extend(scene.rays.bounds(shape));
    const float sigma_t = mean_extinction(medium, bounds);
    targets_ = find_guide_targets(scene, bounds, boundary, skies, max_targets);
    if (targets_.empty() || !(sigma_t > 0.f)) return;

    // The most that the targets could bring: at the surface, facing each. Under a sky that brings
    // much by itself proposals are worth less.
    float most = 0.f, cos_in;
    for (const GuideTarget& target : targets_)
        most += target.sky
                    ? target.sky->most() + target.sky->rest()
                    : strength(target, bounds.center(), target.towards(bounds.center()), cos_in);
    if (!(most > 0.f)) return;
    reference_ = certain_share * most;

    const float limit = depth_in_free_paths / sigma_t + 2.f * grid.half_diagonal();
    std::vector<std::uint32_t> near;
    for (std::size_t c = 0; c < grid.cell_count(); ++c)
        if (grid.clearance(c) + grid.half_diagonal() < limit)
            near.push_back(static_cast<std::uint32_t>(c));
    cells_.resize(near.size());
    const auto nearest = [&](const Point3f& p, float within) -> std::optional<SurfacePoint> {
        std::optional<Hit> best;
        for (const std::uint32_t shape : boundary.shapes)
            if (const auto hit = scene.rays.closest(p, best ? best->t : within, shape, 0.1f))
                best = hit;
        if (!best) return {};
        return scene.rays.surface_point(Ray{p, {0.f, 0.f, 1.f}}, *best);
    };
    WorkPhase phase(work, "exit guide", near.size());
    tbb::parallel_for(std::size_t(0), near.size(), [&](std::size_t i) {
        phase.advance();
        const Point3f c = grid.center(near[i]);
        const auto first = nearest(c, 2.f * limit);
        // Cells that are outside as a whole see no collisions.
        if (!first || dot(c - first->p, first->ng) > grid.half_diagonal()) return;
        const float depth = length(c - first->p);
        for (const std::uint32_t shape : boundary.others)
            if (scene.rays.closest(c, depth, shape, 0.1f)) return;
        Cell& cell = cells_[i];
        cell.normals.fill(first->shading.n);
        cell.offset = dot(first->shading.n, first->p);
        // Three more planes, from points around the first, displaced by the cell's size or the
        // depth, whichever is larger: what leaves from here leaves through about that much of the
        // surface. No point so displaced is farther from the surface than the centre and the
        // displacement together, which keeps the searches short.
        const float step = std::max(depth, grid.cell_size());
        for (int k = 1; k < planes; ++k) {
            const float angle =
                2.f * std::numbers::pi_v<float> * static_cast<float>(k - 1) / (planes - 1);
            const Vec3f aside =
                first->shading.s * std::cos(angle) + first->shading.t * std::sin(angle);
            if (const auto other = nearest(c + aside * step, 1.001f * (depth + step)))
                cell.normals[static_cast<std::size_t>(k)] = other->shading.n;
        }
        const float over = medium.homogeneous() ? sigma_t : mean_extinction(medium, first->p, c);
        for (std::size_t j = 0; j < targets_.size(); ++j) {
            float cosine = 1.f;
            cell.strength[j] =
                strength(targets_[j], first->p, cell.normals[0], cosine) / reference_;
            if (targets_[j].sky) {
                // Small bright parts are seen by one plane and not by the next.
                cell.strength[j] *= plane_weight[0];
                for (std::size_t k = 1; k < planes; ++k) {
                    const GuideSky::Strength& s = targets_[j].sky->strength(cell.normals[k]);
                    cell.strength[j] += plane_weight[k] * s.value / reference_;
                    cosine = std::max(cosine, s.cos_in);
                }
            }
            cell.fall[j] = over / cosine;
        }
        float total = 0.f;
        for (std::size_t j = 0; j < targets_.size(); ++j) total += cell.strength[j];
        if (total > min_probability)
            grid.set_guide(near[i], first_index + static_cast<std::int32_t>(i));
    });
}

float ExitGuide::strength(const GuideTarget& target, const Point3f& at, const Vec3f& normal,
                          float& cos_in) const {
    if (target.sky) {
        const GuideSky::Strength& s = target.sky->strength(normal);
        cos_in = s.cos_in;
        return s.value;
    }
    const Vec3f to = target.center - at;
    const float d2 = std::max(1e-12f, dot(to, to));
    const Vec3f direction = target.point ? target.towards(at) : to * (1.f / std::sqrt(d2));
    const float cos_out = dot(direction, normal);
    if (cos_out < 0.02f) return 0.f;
    cos_in = std::sqrt(1.f - (1.f - cos_out * cos_out) / (eta_ * eta_));
    float arriving;  // radiance times solid angle
    if (target.point) {
        arriving = irradiance_of(*target.point, at);
    } else {
        const float facing =
            target.radius > 0.f ? 1.f : std::max(0.f, -dot(direction, target.normal));
        arriving = target.radiance *
                   std::min(2.f * std::numbers::pi_v<float>, target.area() * facing / d2);
    }
    return arriving * cos_out / (eta_ * eta_ * cos_in) * (1.f - fresnel_dielectric(cos_out, eta_));
}

ExitGuide::Proposal ExitGuide::at(const Point3f& y, std::int32_t index) const {
    Proposal p;
    const Cell& cell = cells_[static_cast<std::size_t>(index)];
    const float depth = std::max(0.f, cell.offset - dot(cell.normals[0], y));
    float total = 0.f;
    for (std::size_t j = 0; j < targets_.size(); ++j)
        if (cell.strength[j] > 0.f)
            total += p.choice_[j] = cell.strength[j] * std::exp(-cell.fall[j] * depth);
    p.probability_ = std::min(1.f, total);
    if (!(total > 0.f)) return p;
    for (std::size_t j = 0; j < targets_.size(); ++j) p.choice_[j] /= total;
    p.guide_ = this;
    p.normals_ = cell.normals.data();
    p.y_ = y;
    if (rough())
        for (std::size_t j = 0; j < targets_.size(); ++j)
            if (p.choice_[j] > 0.f && !targets_[j].sky) p.lobes_[j] = targets_[j].lobe(y, spread_);
    return p;
}

std::optional<Vec3f> ExitGuide::Proposal::sample(Random& random) const {
    const float u = random.next();
    float sum = 0.f;
    std::size_t target = 0, plane = 0;
    while (target + 1 < guide_->targets_.size() && u >= (sum += choice_[target])) ++target;
    const float v = random.next();
    sum = 0.f;
    while (plane + 1 < planes && v >= (sum += plane_weight[plane])) ++plane;
    const GuideTarget& towards = guide_->targets_[target];
    if (guide_->rough() && random.next() < broad_share)
        return Framef::around(normals_[plane])
            .to_world(square_to_cosine_hemisphere(random.next2()));
    const Vec3f outside = guide_->rough() && !towards.sky ? lobes_[target].sample(random.next2())
                                                          : towards.sample(y_, random);
    const float cos_outside = dot(outside, normals_[plane]);
    if (cos_outside < min_cosine) return {};
    return refract_in(outside, normals_[plane], cos_outside, guide_->eta_);
}

float ExitGuide::Proposal::pdf(const Vec3f& direction) const {
    const float eta = guide_->eta_;
    const bool rough = guide_->rough();
    const float aimed = rough ? 1.f - broad_share : 1.f;
    float density = 0.f;
    for (int k = 0; k < planes; ++k) {
        const Vec3f& n = normals_[k];
        const float cos_in = dot(direction, n);
        if (rough) density += plane_weight[k] * broad_share * cosine_hemisphere_pdf(cos_in);
        const float sin2_out = eta * eta * (1.f - cos_in * cos_in);
        if (cos_in <= 0.f || sin2_out >= 1.f) continue;
        const float cos_out = std::sqrt(1.f - sin2_out);
        if (cos_out < min_cosine) continue;
        const Vec3f outside = (direction - n * cos_in) * eta + n * cos_out;
        float towards = 0.f;
        for (std::size_t j = 0; j < guide_->targets_.size(); ++j)
            if (choice_[j] > 0.f) {
                const GuideTarget& target = guide_->targets_[j];
                towards += choice_[j] * (rough && !target.sky ? lobes_[j].pdf(outside)
                                                              : target.pdf(y_, outside));
            }
        density += plane_weight[k] * aimed * towards * eta * eta * cos_in / cos_out;
    }
    return density;
}

}  // namespace nacre
