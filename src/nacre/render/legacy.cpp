#include "nacre/render/legacy.h"

#include <algorithm>

#include "nacre/illumination/distance_attenuation.h"
#include "nacre/math/error.h"
#include "nacre/math/lanes_math.h"
#include "nacre/math/warp.h"
#include "nacre/optics/fresnel.h"
#include "nacre/render/shadow_walk.h"

namespace nacre {

namespace {

using illumination::LightDistance;
using illumination::Part;
using Lighting = illumination::Lighting<float, Spectral>;

// Where light from infinity is put for models that divide by |L|: so far that no |V| matters, and
// its fourth power is still a float.
constexpr float far_away = 1e9f;

// Lights at infinity say 1e30.
constexpr float infinitely_far = 1e29f;

// Surfaces looked through without a limit of depth; only total reflection could go on longer.
constexpr int most_surfaces = 64;

/// Wavelengths in nm. The three bands stand for the dominant wavelengths of the sRGB primaries.
Spectral wavelengths_of(const Wavelengths& w) {
    return w.mode == ColorMode::spectral ? w.lambda : Spectral(611.4f, 549.1f, 464.2f, 549.1f);
}

/// Frame with the normal on the viewer's side.
Framef facing(const SurfacePoint& at, const Vec3f& to_viewer) {
    const Framef& f = at.shading;
    return dot(to_viewer, at.ng) >= 0.f ? f : Framef{f.s, -f.t, -f.n};
}

/// The surface's own colour.
Spectral color_of(const Material& material, const SurfacePoint& at, const Wavelengths& w) {
    if (!(material.flags() & has_smooth)) return Spectral(1.f);
    const Vec3f up{0.f, 0.f, 1.f};
    BsdfScratch scratch;
    return min(material.at(at, w, scratch).eval(up, up) * std::numbers::pi_v<float>, Spectral(1.f));
}

}  // namespace

LegacyShading::LegacyShading(const Scene& scene)
    : scene_(scene), settings_(scene.integrator.legacy) {
    if (!settings_)
        throw InputError(
            "integrator 'legacy' needs to know the illumination model: give the scene an "
            "<integrator type=\"legacy\"> with a <string name=\"model\">, such as \"3+13\"");
    ambient_ = settings_->find(Part::ambient);
    diffuse_ = settings_->find(Part::diffuse);
    specular_ = settings_->find(Part::specular);
    transparency_ = settings_->find(Part::transparency);
}

bool LegacyShading::is_transparent(const ShapeBinding& shape) const {
    return transparency_ && (shape.material->flags() & (transmits | has_null)) != 0;
}

Spectral LegacyShading::transmittance(const Vec3f& wo, const Wavelengths& w) const {
    return illumination::transmittance(*transparency_->model, transparency_->values(w), wo);
}

/// What lies on the way of a shadow ray: surfaces that the transparency model lets light through.
struct LegacyShading::WayToLight {
    const LegacyShading& shading;
    const Wavelengths& wavelengths;
    Spectral kept{1.f};

    bool opaque_only() const { return false; }
    bool passes(const ShapeBinding& shape) const { return shading.is_transparent(shape); }
    bool segment(const Ray&, float) const { return true; }
    bool surface(const ShapeBinding&, const SurfacePoint& at, const Vec3f& d) {
        kept *= shading.transmittance(at.shading.to_local(-d), wavelengths);
        return true;
    }
};

Spectral LegacyShading::visibility(const SurfacePoint& from, const LightSample& light,
                                   const Wavelengths& w, RayCounts& counts) const {
    WayToLight way{*this, w};
    if (!settings_->shadows) return way.kept;
    return walk_to_light(scene_, shadow_ray(from, light), counts, way) ? way.kept : Spectral(0.f);
}

float LegacyShading::unblocked(const SurfacePoint& at, const Framef& frame, Sampler& sampler,
                               RayCounts& counts) const {
    const Vec3f d = frame.to_world(square_to_cosine_hemisphere(sampler.next2d()));
    ++counts.rays;
    return scene_.rays.occluded({at.spawn(d), d}) ? 0.f : 1.f;
}

Spectral LegacyShading::shade(const SurfacePoint& at, const Framef& frame, const Vec3f& to_viewer,
                              float viewer_distance, Sampler& sampler, const Wavelengths& w,
                              RayCounts& counts) const {
    const float unit = settings_->length_unit;
    Lighting seen{.wi = frame.to_local(to_viewer),
                  .wo = frame.to_local(to_viewer),
                  .ambient = settings_->ambient->eval(w),
                  .viewer_distance = viewer_distance / unit,
                  .wavelength = wavelengths_of(w)};
    Spectral colored(0.f), highlight(0.f);  // what the surface's colour scales, and what not
    if (ambient_) {
        LegacyModel::Values values = ambient_->values(w);
        if (settings_->estimate_unblocked)
            values.numbers[1] = unblocked(at, frame, sampler, counts);
        colored += illumination::intensity(*ambient_->model, values, seen);
    }
    const bool light_at_eye = specular_ && specular_->model->number == 12;
    if (light_at_eye)
        highlight += illumination::intensity(*specular_->model, specular_->values(w), seen);

    const LegacyModel* lit_by_each[] = {diffuse_, light_at_eye ? nullptr : specular_};
    for (const LightPtr& light : scene_.lights) {
        const LightSample s = light->sample(at.p, sampler.next2d(), w);
        if (!(s.pdf > 0.f) || !(max_lane(s.radiance) > 0.f)) continue;
        const Spectral irradiance =
            illumination::light_intensity(s.radiance / s.pdf, settings_->convention);
        const Spectral kept = visibility(at, s, w, counts);
        const bool finite = s.distance < infinitely_far;
        seen.wi = frame.to_local(s.wi);
        for (const LegacyModel* m : lit_by_each) {
            if (!m) continue;
            float distance = finite ? s.distance / unit : far_away;
            seen.light = irradiance;
            if (m->model->light_distance == LightDistance::inverse_square) {
                seen.light *= distance * distance;
                seen.solid_angle = illumination::solid_angle(1.f, distance);
            } else if (finite && (m->model->light_distance == LightDistance::attenuated ||
                                  !settings_->inverse_square)) {
                seen.light *= s.distance * s.distance;
            } else if (!finite) {
                distance = 0.f;
            }
            seen.light_distance = distance;
            (m == diffuse_ ? colored : highlight) +=
                kept * illumination::intensity(*m->model, m->values(w), seen);
        }
    }
    if (settings_->surface_color) colored *= color_of(*scene_.shapes[at.shape].material, at, w);
    return colored + highlight;
}

Spectral LegacyShading::radiance(const Ray& camera_ray, Sampler& sampler,
                                 const Wavelengths& wavelengths, RayCounts& counts) const {
    const IntegratorSettings& limits = scene_.integrator;
    const int most = limits.max_depth < 0 ? most_surfaces : limits.max_depth;
    Ray ray = camera_ray;
    Spectral result(0.f), share(1.f);
    float way = 0.f;
    bool inside = false, single_wavelength = false;
    for (int depth = 0; depth < most; ++depth) {
        ++counts.rays;
        const auto hit = scene_.rays.intersect(ray);
        const Light* light = hit ? scene_.shapes[hit->shape].light : scene_.beyond(depth);
        SurfacePoint at;
        if (hit) at = scene_.rays.surface_point(ray, *hit);
        if (hit && inside)
            share *= illumination::absorption_attenuation(settings_->absorption->eval(wavelengths),
                                                          hit->t);
        if (light && !(depth == 0 && limits.hide_emitters))
            result += share * light->radiance(hit ? &at : nullptr, ray.d, wavelengths);
        if (!hit || light || (limits.max_depth >= 0 && depth + 1 >= most)) break;

        way += hit->t;
        const Vec3f to_viewer = -ray.d;
        const Framef frame = facing(at, to_viewer);
        const Vec3f wo = frame.to_local(to_viewer);
        const bool transparent = is_transparent(scene_.shapes[hit->shape]);
        const Spectral kt = transparent ? transmittance(wo, wavelengths) : Spectral(0.f);
        result += share * (Spectral(1.f) - kt) *
                  shade(at, frame, to_viewer, way, sampler, wavelengths, counts);
        if (!transparent) break;
        share *= kt;

        if (settings_->refraction) {
            const bool enters = dot(to_viewer, at.ng) >= 0.f;
            const Spectral n = transparency_->values(wavelengths).spectra[0];
            if (wavelengths.mode == ColorMode::spectral && !single_wavelength &&
                min_lane(n) < max_lane(n)) {
                // The other wavelengths would have gone elsewhere: the first stands for all.
                single_wavelength = true;
                share *= Spectral(1.f / wavelengths.weight[0], 0.f, 0.f, 0.f);
            }
            const Vec3f up{0.f, 0.f, 1.f};
            const Vec3f bent = refract(wo, up, enters ? n[0] : 1.f / n[0]);
            ray.d = frame.to_world(bent.z < 0.f ? bent : reflect(wo, up));
            inside = dot(ray.d, at.ng) < 0.f;
        }
        ray = {at.spawn(ray.d), ray.d};
    }
    return result;
}

}  // namespace nacre
