#include "nacre/render/auxiliary_path.h"

#include <algorithm>
#include <cmath>

#include "nacre/math/lanes_math.h"
#include "nacre/render/shading_normal.h"

namespace nacre {
namespace {

/// Mirrors and boundaries that are looked through.
constexpr int deepest = 8;
/// Surfaces that are not there for light.
constexpr int most_null_surfaces = 64;
/// What is seen through this much is no longer looked at.
constexpr float least_weight = 0.01f;

float mean3(const Spectral& s) { return (s[0] + s[1] + s[2]) * (1.f / 3.f); }
Spectral clipped(const Spectral& s) { return max(min(s, Spectral(1.f)), Spectral(0.f)); }

Spectral albedo_of(const MediumCoefficients& c) {
    return select(c.sigma_t > Spectral(0.f), c.sigma_s / max(c.sigma_t, Spectral(1e-30f)),
                  Spectral(0.f));
}

bool scatters(const Medium* medium, const Point3f& p, const Wavelengths& wavelengths) {
    return medium &&
           (!medium->homogeneous() || max_lane(medium->coefficients(p, wavelengths).sigma_s) > 0.f);
}

/// Part [begin, end] of a ray's first `distance` within a box.
std::pair<float, float> within(const Box3f& box, const Ray& ray, float distance) {
    float begin = 0.f, end = distance;
    for (int i = 0; i < 3; ++i) {
        const float inverse = 1.f / ray.d[i];
        float a = (box.lower[i] - ray.o[i]) * inverse, b = (box.upper[i] - ray.o[i]) * inverse;
        if (a > b) std::swap(a, b);
        // A ray within a side of the box gives 0 / 0, and is not cut by it.
        begin = a > begin ? a : begin;
        end = b < end ? b : end;
    }
    return {begin, end};
}

}  // namespace

FirstSight AuxiliaryPath::trace(const Ray& ray) {
    albedo_ = Spectral(0.f);
    normal_ = {0.f, 0.f, 0.f};
    depth_.reset();
    follow({.ray = ray, .medium = scene_.camera_medium});
    const Spectral albedo = clipped(albedo_);
    return {{albedo[0], albedo[1], albedo[2]}, normal_, depth_};
}

void AuxiliaryPath::follow(Branch branch) {
    float travelled = 0.f;
    for (int nulls = 0; branch.depth < deepest && nulls < most_null_surfaces;) {
        const auto hit = scene_.rays.intersect(branch.ray);
        if (!pass_medium(branch, hit ? hit->t : 1e30f)) return;
        if (!hit) {
            const Light* beyond = scene_.beyond(branch.depth);
            if (!beyond || (branch.depth == 0 && scene_.integrator.hide_emitters)) return;
            albedo_ +=
                branch.weight * clipped(beyond->radiance(nullptr, branch.ray.d, wavelengths_));
            return;
        }
        const SurfacePoint at = scene_.rays.surface_point(branch.ray, *hit);
        travelled += hit->t;
        const Material& material = *scene_.shapes[at.shape].material;
        if (material.flags() == has_null) {
            BsdfScratch scratch;
            branch.weight *= material.at(at, wavelengths_, scratch)
                                 .null_transmission(at.shading.to_local(-branch.ray.d));
            leave(branch, at, at.shading.to_local(branch.ray.d));
            ++nulls;
            continue;
        }
        if (branch.depth == 0 && !depth_) depth_ = travelled;
        if (!meet(branch, at)) return;
        ++branch.depth;
    }
}

bool AuxiliaryPath::pass_medium(Branch& branch, float distance) {
    if (!branch.medium) return true;
    return branch.medium->homogeneous() ? pass_homogeneous(branch, distance)
                                        : pass_heterogeneous(branch, distance);
}

bool AuxiliaryPath::pass_homogeneous(Branch& branch, float distance) {
    const MediumCoefficients c = branch.medium->coefficients(branch.ray.o, wavelengths_);
    const Spectral passing = exp(-min(c.sigma_t * Spectral(distance), Spectral(80.f)));
    const Spectral stopped = Spectral(1.f) - passing;
    albedo_ += branch.weight * stopped * albedo_of(c);
    normal_ += branch.entrance * (branch.normal_weight * mean3(stopped));
    branch.weight *= passing;
    branch.normal_weight *= mean3(passing);
    return max_lane(branch.weight) > least_weight;
}

bool AuxiliaryPath::pass_heterogeneous(Branch& branch, float distance) {
    // Equal steps from a random start: features need not be free of bias, but of noise.
    constexpr int steps = 16;
    const Medium& medium = *branch.medium;
    float begin = 0.f, end = distance;
    for (const Volume* volume : {medium.sigma_t_volume.get(), medium.albedo_volume.get()})
        if (volume) {
            std::tie(begin, end) = within(volume->bounds(), branch.ray, distance);
            break;
        }
    if (!(begin < end)) return true;
    if (!(end < 1e30f)) end = begin + length(scene_.rays.bounds().diagonal());
    const float step = (end - begin) / steps, start = sampler_.random().next();
    for (int i = 0; i < steps; ++i) {
        const float t = begin + (float(i) + start) * step;
        const MediumCoefficients c =
            medium.coefficients(branch.ray.o + branch.ray.d * t, wavelengths_);
        const Spectral passing = exp(-min(c.sigma_t * Spectral(step), Spectral(80.f)));
        const Spectral stopped = Spectral(1.f) - passing;
        albedo_ += branch.weight * stopped * albedo_of(c);
        normal_ += branch.entrance * (branch.normal_weight * mean3(stopped));
        branch.weight *= passing;
        branch.normal_weight *= mean3(passing);
        if (!(max_lane(branch.weight) > least_weight)) return false;
    }
    return true;
}

bool AuxiliaryPath::meet(Branch& branch, SurfacePoint at) {
    const ShapeBinding& shape = scene_.shapes[at.shape];
    const Material& material = *shape.material;
    if (shape.light && !(branch.depth == 0 && scene_.integrator.hide_emitters)) {
        const Spectral emitted = shape.light->radiance(&at, branch.ray.d, wavelengths_);
        if (max_lane(emitted) > 0.f) {
            albedo_ += branch.weight * clipped(emitted);
            add_normal(branch, 1.f, at.shading.n);
            return false;
        }
    }
    if (!(material.flags() & transmits))
        turn_to_viewer(at, -branch.ray.d, !material.is_lambertian());
    return see(branch, at, material);
}

bool AuxiliaryPath::see(Branch& branch, const SurfacePoint& at, const Material& material) {
    const Vec3f wo = at.shading.to_local(-branch.ray.d);
    BsdfScratch scratch;
    const Bsdf& bsdf = material.at(at, wavelengths_, scratch);
    const bool first = branch.depth == 0, smooth = material.flags() & has_smooth;
    if (first && !smooth && wo.z > 0.f && material.smooth_boundary_eta() > 0.f)
        return split(branch, at, bsdf, wo);
    if (!smooth) {
        // The likelier way: features need not be free of bias, but of noise.
        const auto sample = bsdf.sample(wo, 0.5f, sampler_.next2d());
        if (!sample || !(max_lane(sample->weight) > 0.f)) return false;
        branch.weight *= sample->weight * Spectral(sample->eta * sample->eta);
        leave(branch, at, sample->wi);
        if (sample->wi.z * wo.z < 0.f) branch.entrance = wo.z < 0.f ? -at.shading.n : at.shading.n;
        return max_lane(branch.weight) > least_weight;
    }
    const int directions = first && !material.is_lambertian() ? 4 : 1;
    const float part = 1.f / float(directions), offset = sampler_.next1d();
    const Medium* interior = scene_.shapes[at.shape].interior;
    const bool translucent = scatters(interior, at.p, wavelengths_);
    Spectral albedo(0.f);
    float own = 1.f;  // share of the directions that show this surface and its normal
    for (int i = 0; i < directions; ++i) {
        const float u1 = std::min((float(i) + offset) * part, 0x1.fffffep-1f);
        const auto sample = bsdf.sample(wo, u1, sampler_.next2d());
        if (!sample) continue;
        const Spectral share = sample->weight * Spectral(sample->eta * sample->eta * part);
        const bool passes = sample->wi.z * wo.z < 0.f;
        if (!sample->delta && !sample->null) {
            // Light that enters scattering matter comes back with its colour.
            albedo += share * (passes && translucent && wo.z > 0.f
                                   ? albedo_of(interior->coefficients(at.p, wavelengths_))
                                   : Spectral(1.f));
            continue;
        }
        Branch other = branch;
        other.weight *= share;
        other.normal_weight *= passes ? part : 0.f;
        if (passes) own -= part;
        leave(other, at, sample->wi);
        ++other.depth;
        if (max_lane(other.weight) > least_weight) follow(other);
    }
    albedo_ += branch.weight * clipped(albedo);
    add_normal(branch, own, at.shading.n);
    return false;
}

bool AuxiliaryPath::split(Branch& branch, const SurfacePoint& at, const Bsdf& bsdf,
                          const Vec3f& wo) {
    const Vec2f u2 = sampler_.next2d();
    const auto reflected = bsdf.sample(wo, 0.f, u2),
               refracted = bsdf.sample(wo, 0x1.fffffep-1f, u2);
    const bool translucent = scatters(scene_.shapes[at.shape].interior, at.p, wavelengths_);
    if (reflected && reflected->wi.z > 0.f) {
        Branch other = branch;
        const float share = refracted && refracted->wi.z < 0.f ? reflected->pdf : 1.f;
        other.weight *= Spectral(share);
        other.normal_weight *= share;
        // The matter below is what one sees: its normal holds for all of it.
        if (translucent) {
            add_normal(branch, share, at.shading.n);
            other.normal_weight = 0.f;
        }
        leave(other, at, reflected->wi);
        ++other.depth;
        follow(other);
    }
    if (!refracted || !(refracted->wi.z < 0.f)) return false;
    branch.weight *= Spectral(refracted->pdf);
    branch.normal_weight *= refracted->pdf;
    branch.entrance = at.shading.n;
    leave(branch, at, refracted->wi);
    return max_lane(branch.weight) > least_weight;
}

void AuxiliaryPath::add_normal(const Branch& branch, float share, const Vec3f& normal) {
    const float side = dot(normal, branch.ray.d) > 0.f ? -1.f : 1.f;
    normal_ += normal * (side * share * branch.normal_weight);
}

void AuxiliaryPath::leave(Branch& branch, const SurfacePoint& at, const Vec3f& local) const {
    const Vec3f direction = at.shading.to_world(local);
    branch.ray = {at.spawn(direction), direction};
    const ShapeBinding& shape = scene_.shapes[at.shape];
    if (shape.separates_media)
        branch.medium = dot(direction, at.ng) > 0.f ? shape.exterior : shape.interior;
}

}  // namespace nacre
