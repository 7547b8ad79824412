// MeasuredSurface for many pairs of directions.
#include <algorithm>
#include <cmath>

#include "nacre/measured/surface.h"

namespace nacre {

void MeasuredSurface::eval_many(std::span<const Vec3f> wi, std::span<const Vec3f> wo,
                                std::span<float> values, std::span<float> densities) const {
    if (rgl_) {
        rgl_->eval_many(wo, wi, values, densities);
        for (float& v : values) v = std::max(v, 0.f);
        return;
    }
    if (!values.empty()) values_of_many(wi, wo, values);
    if (densities.empty()) return;
    if (reflects_in_front_alone())
        front_.reflected->pdf_many(wi, wo, densities);
    else
        for (std::size_t i = 0; i < wi.size(); ++i) densities[i] = pdf(wi[i], wo[i]);
}

void MeasuredSurface::values_of_many(std::span<const Vec3f> wi, std::span<const Vec3f> wo,
                                     std::span<float> out) const {
    const std::size_t n = std::size_t(info().channels);
    constexpr std::size_t block = 1024;
    bool known[block];
    for (std::size_t first = 0; first < wi.size(); first += block) {
        const std::size_t count = std::min(block, wi.size() - first);
        data_->eval_float_many(wi.subspan(first, count), wo.subspan(first, count),
                               out.subspan(first * n, count * n), std::span(known, count));
        for (std::size_t k = 0; k < count; ++k) {
            const std::size_t i = first + k;
            const std::span<float> own = out.subspan(i * n, n);
            // Beyond what was measured, others hold.
            const bool any = known[k] || value(wi[i], wo[i], own);
            const float cosine = std::abs(wi[i].z);
            for (float& v : own) v = any ? std::max(v, 0.f) * cosine : 0.f;
        }
    }
}

void MeasuredSurface::sample_many(std::span<const Vec3f> wo, std::span<const float> u1,
                                  std::span<const Vec2f> u2, std::span<Vec3f> wi) const {
    if (rgl_) return rgl_->sample_many(wo, u2, wi);
    if (!reflects_in_front_alone()) {
        for (std::size_t i = 0; i < wo.size(); ++i)
            wi[i] = sample(wo[i], u1[i], u2[i]).value_or(Vec3f{});
        return;
    }
    front_.reflected->sample_many(wo, u1, u2, wi);
    for (std::size_t i = 0; i < wo.size(); ++i)
        if (!(wo[i].z > 0.f && wi[i].z > 0.f)) wi[i] = {};
}

}  // namespace nacre
