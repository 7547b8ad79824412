#pragma once
// What a rough boundary does to light, by samples of its material.
#include <cstdint>

#include "nacre/render/sampler.h"
#include "nacre/scene/material.h"

namespace nacre {

/// Light that meets a boundary from directions `direction(u)`, u uniform: calls `f(wi, share,
/// back)` for each of `samples` ways that it goes on, `share` a part of all its power and `back`
/// whether that stays on its side. Same `key`, same samples. `uv`: where, in the coordinates of the
/// material's textures.
template <class Direction, class F>
void for_boundary_samples(const Material& material, int samples, std::uint64_t key,
                          Direction&& direction, F&& f, Vec2f uv = {}) {
    Sampler sampler(Sampler::Kind::sobol, 0, samples);
    BsdfScratch scratch;
    SurfacePoint at;
    at.uv = uv;
    const Bsdf& bsdf = material.at(at, Wavelengths::rgb_bands(), scratch);
    for (int i = 0; i < samples; ++i) {
        sampler.start(key, std::uint32_t(i));
        const Vec3f wo = direction(sampler.next2d());
        const float u1 = sampler.next1d();
        const auto s = bsdf.sample(wo, u1, sampler.next2d());
        // Weights are those of radiance, which changes by 1 / eta^2; power does not.
        if (s) f(s->wi, double(s->weight[0] * s->eta * s->eta) / samples, s->wi.z * wo.z > 0.f);
    }
}

}  // namespace nacre
