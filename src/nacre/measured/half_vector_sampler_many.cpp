// HalfVectorSampler for many pairs of directions: sixteen go through each step together.
#include "nacre/math/warp.h"
#include "nacre/measured/half_vector_sampler.h"
#include "nacre/measured/warp_packs.h"

namespace nacre {

void HalfVectorSampler::pdf_many(std::span<const Vec3f> wi, std::span<const Vec3f> wo,
                                 std::span<float> out) const {
    for_each_pack(wi.size(), [&](std::size_t i, int count) {
        const PackVec in = load(&wi[i], count), to = load(&wo[i], count);
        const PackVec h = normalized(in + to);
        const PackPolar viewer = polar_of(to), half = polar_of(h);
        const Pack x = square_x(half.theta),
                   y = square_y(isotropic_ ? half.phi - viewer.phi : half.phi);
        const Pack table = density(warp_, x, y, slices_at(viewers_, viewer.phi, viewer.theta)) /
                           reflected_solid_angle(x, sin_theta_of(h), dot(to, h));
        const Pack pdf =
            in.z * Pack(by_cosine * std::numbers::inv_pi_v<float>) + Pack(1.f - by_cosine) * table;
        store(select(above(in) & above(to), pdf, Pack(0.f)), &out[i], count);
    });
}

void HalfVectorSampler::sample_many(std::span<const Vec3f> wo, std::span<const float> u1,
                                    std::span<const Vec2f> u2, std::span<Vec3f> wi) const {
    for_each_pack(wo.size(), [&](std::size_t i, int count) {
        const PackVec to = load(&wo[i], count);
        const Vec2<Pack> u = load(&u2[i], count);
        const PackPolar viewer = polar_of(to);
        const PackPoint at =
            nacre::sample(warp_, u.x, u.y, slices_at(viewers_, viewer.phi, viewer.theta));
        const PackVec h = square_vector(at.x, at.y, isotropic_ ? viewer.phi : Pack(0.f));
        const PackVec w = h * (Pack(2.f) * dot(to, h)) - to;
        store(w, &wi[i], count);
        for (std::size_t k = i; k < i + std::size_t(count); ++k)
            if (u1[k] < by_cosine) wi[k] = square_to_cosine_hemisphere(u2[k]);
    });
}

}  // namespace nacre
