#include "nacre/subsurface/surface_sampling.h"

#include "nacre/math/fast.h"
#include "nacre/technique/common_parameters.h"

namespace nacre {

namespace {

constexpr float axis_probability[] = {0.5f, 0.25f, 0.25f};
// A probe ray meets at most so many places; more only where something is wrong with the mesh.
constexpr int most_candidates = 64;

}  // namespace

SurfaceSampling::SurfaceSampling(const Scene& scene, std::uint32_t shape,
                                 const ObjectBoundary& boundary,
                                 std::shared_ptr<const ProfileTables> profile, float exit_scale,
                                 std::shared_ptr<const SingleScatteringTerm> single)
    : Translucency(boundary),
      scene_(scene),
      shape_(shape),
      profile_(std::move(profile)),
      exit_scale_(exit_scale),
      single_(std::move(single)),
      reach_(length(scene.rays.bounds(shape).diagonal())) {}

Translucency::Emergence SurfaceSampling::emerge(const SurfacePoint& exit, const Vec3f& wo,
                                                Sampler& sampler, const Wavelengths& w,
                                                RayCounts& counts) const {
    Emergence result;
    if (single_) result.radiance = single_->radiance(exit, wo, sampler, w, counts);

    const float u_axis = sampler.next1d(), u_lane = sampler.next1d();
    const Vec2f u_disk = sampler.next2d();
    const float u_candidate = sampler.next1d();
    const Framef frame = Framef::around(exit.ng);
    const Vec3f axes[] = {frame.n, frame.s, frame.t};
    const int axis = u_axis < 0.5f ? 0 : u_axis < 0.75f ? 1 : 2;
    const float r = profile_->sample(u_lane, u_disk.x, w);
    const Vec2f turn = fast_unit_circle(u_disk.y);
    const Vec3f along = axes[axis];
    const Vec3f offset = (axes[(axis + 1) % 3] * turn.x + axes[(axis + 2) % 3] * turn.y) * r;

    // Resampling in one pass: each candidate replaces the one before with its share of the weight.
    float total = 0.f, random = u_candidate;
    Spectral chosen(0.f);
    Ray probe{exit.p + offset - along * reach_, along, 0.f, 2.f * reach_};
    for (int i = 0; i < most_candidates; ++i) {
        ++counts.rays;
        const auto hit = scene_.rays.intersect(probe);
        if (!hit) break;
        const SurfacePoint at = scene_.rays.surface_point(probe, *hit);
        if (hit->shape == shape_) {
            const Vec3f to = at.p - exit.p;
            const float r2 = dot(to, to);
            float density = 0.f;
            for (int a = 0; a < 3; ++a) {
                const float height = dot(to, axes[a]);
                density += axis_probability[a] * std::abs(dot(at.ng, axes[a])) *
                           profile_->pdf(std::max(0.f, r2 - height * height), w);
            }
            if (density > 0.f) {
                const Spectral weight = profile_->eval(r2, w) / Spectral(density);
                const float share = mean(weight, w);
                if (share > 0.f) {
                    total += share;
                    const float chance = share / total;
                    if (random < chance) {
                        random /= chance;
                        result.entry = at;
                        chosen = weight / Spectral(share);
                    } else {
                        random = (random - chance) / (1.f - chance);
                    }
                }
            }
        }
        const Point3f next = at.spawn(along);
        probe.tmax -= std::max(hit->t, dot(next - probe.o, along));
        probe.o = next;
        if (!(probe.tmax > 0.f)) break;
    }
    result.weight = chosen * Spectral(total * exit_scale_);
    return result;
}

TranslucencyPtr SurfaceSampling::relit(const Relight&) const {
    if (!single_) return nullptr;
    auto same = std::make_shared<SurfaceSampling>(*this);
    same->single_ = std::make_shared<SingleScatteringTerm>(scene_, shape_, boundary());
    return same;
}

/// In the list of techniques/techniques.cpp.
const TechniqueDescription& surface_sampling_technique() {
    static const TechniqueDescription description{
        .name = "surface",
        .title = "BSSRDF by surface sampling",
        .authors =
            "H. W. Jensen, S. Marschner, M. Levoy, P. Hanrahan; A. King, C. Kulla, A. "
            "Conty, M. Fajardo",
        .year = 2001,
        .paper =
            "A Practical Model for Subsurface Light Transport, SIGGRAPH 2001; BSSRDF "
            "Importance Sampling, SIGGRAPH Talks 2013",
        .how = "for each exit one point of entry around it, drawn by probe rays after the profile",
        .precomputes = "tables of the profile",
        .keeps = {.view = true, .light = true},
        .parameters = {profile_parameter(), exit_fresnel_parameter(),
                       single_scattering_parameter()},
        // The six Gaussians are those of skin whatever the medium: only who asks for them gets
        // them.
        .variants =
            "profile=dipole|profile=better_dipole|profile=quantised_diffusion|"
            "profile=photon_beam_diffusion|profile=normalised_diffusion|profile=multipole",
        .prepare = prepare_path_technique,
        .below = [](const ShapeInput& in) -> TranslucencyPtr {
            const auto tables = profile_tables(in);
            return std::make_shared<SurfaceSampling>(
                in.scene, in.shape, in.boundary, tables, exit_scale(in),
                single_scattering_of(in, tables->includes_single_scattering()));
        }};
    return description;
}

}  // namespace nacre
