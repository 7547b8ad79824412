#include "nacre/render/object_boundary.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "nacre/math/sampling.h"
#include "nacre/optics/fresnel_moments.h"
#include "nacre/render/boundary_samples.h"
#include "nacre/scene/subsurface.h"

namespace nacre {
namespace {

constexpr int table_size = 64;
constexpr int samples_each = 1024, samples_of_means = 32768;

/// What becomes of light that meets the material: mean shares of power.
struct Shares {
    double reflected = 0., transmitted = 0.;
};

/// `direction(u)` makes the direction from which light comes.
template <class F>
Shares shares_of(const Material& material, int samples, std::uint64_t key, const F& direction) {
    Shares shares;
    for_boundary_samples(material, samples, key, direction,
                         [&](const Vec3f&, double share, bool back) {
                             (back ? shares.reflected : shares.transmitted) += share;
                         });
    return shares;
}

}  // namespace

ObjectBoundary::ObjectBoundary(float eta) : eta_(eta) {
    if (eta == 1.f) return;
    mean_reflectance_ = diffuse_reflectance_external(eta);
    mean_transmittance_ = 1. - mean_reflectance_;
}

ObjectBoundary::ObjectBoundary(const Material& material)
    : eta_(material.rough_boundary_eta()), rough_(&material) {
    std::vector<float> table(table_size);
    for (int i = 0; i < table_size; ++i) {
        const float mu = std::max(1e-3f, float(i) / float(table_size - 1));
        const float sine = std::sqrt(std::max(0.f, 1.f - mu * mu));
        // All azimuths: the facets may be longer than wide.
        table[std::size_t(i)] =
            float(shares_of(material, samples_each, std::uint64_t(i), [&](Vec2f u) {
                      const float phi = 2.f * std::numbers::pi_v<float> * u.x;
                      return Vec3f{sine * std::cos(phi), sine * std::sin(phi), mu};
                  }).transmitted);
    }
    table_ = std::make_shared<const std::vector<float>>(std::move(table));
    const Shares outside = shares_of(material, samples_of_means, table_size,
                                     [](Vec2f u) { return square_to_cosine_hemisphere(u); });
    mean_transmittance_ = outside.transmitted;
    mean_reflectance_ = outside.reflected;
}

ObjectBoundary ObjectBoundary::of(const ShapeBinding& shape) {
    if (shape.material->rough_boundary_eta() > 0.f) return ObjectBoundary(*shape.material);
    return ObjectBoundary(boundary_eta(shape));
}

float ObjectBoundary::over_smooth(float cosine) const {
    const float smooth = 1.f - fresnel_dielectric(cosine, eta_);
    return rough_ && smooth > 0.f ? tabulated(cosine) / smooth : 1.f;
}

float ObjectBoundary::tabulated(float cosine) const {
    const float x = std::clamp(cosine, 0.f, 1.f) * float(table_size - 1);
    const auto i = std::min(std::size_t(x), std::size_t(table_size - 2));
    const float t = x - float(i);
    return (1.f - t) * (*table_)[i] + t * (*table_)[i + 1];
}

}  // namespace nacre
