#include "nacre/peers/albedo.h"

#include "nacre/math/warp.h"
#include "nacre/render/sampler.h"

namespace nacre {

Vec3f mean_albedo(const Material& material) {
    constexpr int samples = 4096;
    const Wavelengths w = Wavelengths::rgb_bands();
    Sampler sampler(Sampler::Kind::sobol, 0, samples);
    SurfacePoint at{};
    at.ng = {0.f, 0.f, 1.f};
    at.shading = Framef::around(at.ng);
    at.uv = {0.5f, 0.5f};
    BsdfScratch scratch;
    const Bsdf& bsdf = material.at(at, w, scratch);
    Vec3d sum{};
    for (int i = 0; i < samples; ++i) {
        sampler.start(0, std::uint32_t(i));
        const Vec3f wo = square_to_cosine_hemisphere(sampler.next2d());
        const float u1 = sampler.next1d();
        const auto s = bsdf.sample(wo, u1, sampler.next2d());
        if (s && s->wi.z > 0.f) sum += Vec3d(s->weight[0], s->weight[1], s->weight[2]);
    }
    const Vec3f mean(sum * (1.0 / samples));
    return {std::clamp(mean.x, 0.f, 1.f), std::clamp(mean.y, 0.f, 1.f),
            std::clamp(mean.z, 0.f, 1.f)};
}

}  // namespace nacre
