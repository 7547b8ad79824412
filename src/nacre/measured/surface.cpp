#include "nacre/measured/surface.h"

#include <cmath>

#include "nacre/math/warp.h"
#include "nacre/measured/held.h"
#include "nacre/measured/rgl.h"

namespace nacre {
namespace {

Vec3f mirrored(const Vec3f& w) { return {w.x, w.y, -w.z}; }

void raise_to_zero(std::span<float> values) {
    for (float& v : values) v = std::max(v, 0.f);
}

}  // namespace

MeasuredSurface::MeasuredSurface(std::unique_ptr<Measured> data) : data_(std::move(data)) {
    if (const auto* rgl = dynamic_cast<const RglMeasured*>(data_.get())) {
        rgl_ = &rgl->brdf();
        return;
    }
    if (const auto* klems = dynamic_cast<const KlemsMeasured*>(data_.get())) {
        klems_.emplace(*klems);
        return;
    }
    front_ = make_side(true);
    back_ = make_side(false);
    if (!info().reflection_front) return;
    // A lattice of pairs, uniform in the cosines' measure.
    constexpr int n = 1024;
    std::vector<float> out(std::size_t(info().channels));
    int without = 0;
    for (int i = 0; i < n; ++i) {
        const auto part = [i](double step) {
            return float((i + 0.5) * step - std::floor((i + 0.5) * step));
        };
        const Vec3f wi =
            square_to_cosine_hemisphere(Vec2f{(i + 0.5f) / n, part(0.7548776662466927)});
        const Vec3f wo =
            square_to_cosine_hemisphere(Vec2f{part(0.5698402909980532), part(0.3247179572447460)});
        without += !value(wi, wo, out);
    }
    black_ = double(without) / n;
}

bool MeasuredSurface::value(const Vec3f& wi, const Vec3f& wo, std::span<float> out) const {
    return eval_held(info(), wi, wo,
                     [&](const Vec3f& i, const Vec3f& o) { return data_->eval_float(i, o, out); });
}

MeasuredSurface::Side MeasuredSurface::make_side(bool front) const {
    const MeasuredInfo& i = info();
    const auto sampler = [&](bool reflected) {
        return HalfVectorSampler(
            [&, reflected](const Vec3f& wi, const Vec3f& wo) {
                float channels[max_measured_channels];
                const std::span<float> out(channels, std::size_t(i.channels));
                Vec3f from = wi, to = wo;
                if (!front) to.z = -to.z;
                if (front != reflected) from.z = -from.z;
                if (!value(from, to, out)) return 0.;
                double sum = 0.;
                for (const float v : out) sum += std::max(v, 0.f);
                return sum * double(wi.z);
            },
            i.isotropic);
    };
    // Light that is reflected to a viewer in front comes from the front; what passes, from behind.
    Side side;
    if (front ? i.reflection_front : i.reflection_back) side.reflected = sampler(true);
    if (front ? i.transmission_back : i.transmission_front) side.transmitted = sampler(false);
    if (!side.reflected) side.reflect_chance = 0.f;
    if (side.reflected && side.transmitted) {
        const double r = side.reflected->mean(), t = side.transmitted->mean();
        side.reflect_chance = r + t > 0. ? std::clamp(float(r / (r + t)), 0.05f, 0.95f) : 0.5f;
    }
    return side;
}

void MeasuredSurface::eval(const Vec3f& wi, const Vec3f& wo, std::span<float> out) const {
    const std::size_t n = std::size_t(info().channels);
    if (rgl_) {
        if (!rgl_->eval(wo, wi, out)) std::fill_n(out.begin(), n, 0.f);
        return raise_to_zero(out.first(n));
    }
    const bool known = value(wi, wo, out);
    const float cosine = std::abs(wi.z);
    for (std::size_t c = 0; c < n; ++c) out[c] = known ? std::max(out[c], 0.f) * cosine : 0.f;
}

std::optional<Vec3f> MeasuredSurface::sample(const Vec3f& wo, float u1, Vec2f u2) const {
    if (rgl_) {
        const auto s = rgl_->sample(wo, u2.x, u2.y);
        if (!s) return std::nullopt;
        return s->direction;
    }
    if (klems_) return klems_->sample(wo, u1, u2);
    const Side& side = side_of(wo);
    const bool reflect = u1 < side.reflect_chance;
    const auto& sampler = reflect ? side.reflected : side.transmitted;
    if (!sampler || wo.z == 0.f) return std::nullopt;
    const float rest = reflect ? u1 / side.reflect_chance
                               : (u1 - side.reflect_chance) / (1.f - side.reflect_chance);
    const bool front = wo.z > 0.f;
    const Vec3f wi = sampler->sample(front ? wo : mirrored(wo), rest, u2);
    if (!(wi.z > 0.f)) return std::nullopt;
    return front == reflect ? wi : mirrored(wi);
}

float MeasuredSurface::pdf(const Vec3f& wi, const Vec3f& wo) const {
    if (rgl_) return rgl_->pdf(wo, wi);
    if (klems_) return klems_->pdf(wi, wo);
    const Side& side = side_of(wo);
    const bool reflect = (wi.z > 0.f) == (wo.z > 0.f);
    const auto& sampler = reflect ? side.reflected : side.transmitted;
    if (!sampler) return 0.f;
    const float chance = reflect ? side.reflect_chance : 1.f - side.reflect_chance;
    return chance * sampler->pdf(wi.z > 0.f ? wi : mirrored(wi), wo.z > 0.f ? wo : mirrored(wo));
}

float MeasuredSurface::eval_pdf(const Vec3f& wi, const Vec3f& wo, std::span<float> out) const {
    if (!rgl_) {
        eval(wi, wo, out);
        return pdf(wi, wo);
    }
    const std::span<float> values = out.first(std::size_t(info().channels));
    const auto pdf = rgl_->eval_pdf(wo, wi, values);
    if (!pdf) std::ranges::fill(values, 0.f);
    raise_to_zero(values);
    return pdf.value_or(0.f);
}

std::optional<MeasuredSurface::Drawn> MeasuredSurface::draw(const Vec3f& wo, float u1, Vec2f u2,
                                                            std::span<float> out) const {
    if (rgl_) {
        const std::span<float> values = out.first(std::size_t(info().channels));
        const auto s = rgl_->sample(wo, u2.x, u2.y, values);
        if (!s) return std::nullopt;
        raise_to_zero(values);
        return Drawn{s->direction, s->pdf};
    }
    const auto wi = sample(wo, u1, u2);
    if (!wi) return std::nullopt;
    return Drawn{*wi, eval_pdf(*wi, wo, out)};
}

}  // namespace nacre
