#include "nacre/subsurface/two_pass.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "nacre/bssrdf/better_dipole.h"
#include "nacre/bssrdf/dipole.h"
#include "nacre/geometry/area_sampler.h"
#include "nacre/geometry/surface_points.h"
#include "nacre/geometry/tessellate.h"
#include "nacre/math/error.h"
#include "nacre/render/path_tracer.h"
#include "nacre/render/profile_tables.h"
#include "nacre/subsurface/daylight.h"
#include "nacre/subsurface/stopwatch.h"
#include "nacre/technique/common_parameters.h"

namespace nacre {

namespace {

constexpr double pi = std::numbers::pi;
// Between two looks at whether to stop.
constexpr int paths_at_a_time = 64;
// Errors of single shares average out in the sum: few candidates a point will do.
constexpr float elimination_candidates = 4.f;
// Points farther apart than so many mean free paths show nothing of the object.
constexpr double most_spacing = 100.;

// In the order of PointMethod.
const std::array<Choice, 3> point_methods{{{"random", "independently"},
                                           {"repulsion", "by forces between them"},
                                           {"elimination", "of candidates, the closest first"}}};

/// The points of a shape as the ray scene knows them.
struct ShapePoints {
    std::vector<SurfacePoint> at;
    std::vector<Point3f> p;
    std::vector<float> area;
};

/// Rounded up in the third digit: what is advised should do.
double advised(double x) {
    const double digit = std::pow(10., std::floor(std::log10(x)) - 2.);
    return std::ceil(x * (1. + 1e-9) / digit) * digit;
}

void multiply(DipoleKernel& kernel, double factor) {
    for (DipoleKernel::Source* s : {&kernel.real, &kernel.image}) {
        s->p *= float(factor);
        s->q *= float(factor);
    }
}

ShapePoints spread_points(const ShapeInput& in, const TwoPassOptions& own, double free_path) {
    const RayScene& rays = in.scene.rays;
    const Mesh* mesh = rays.mesh(in.shape);
    std::optional<Mesh> made;
    if (!mesh) {
        made = tessellate(*rays.primitive(in.shape));
        mesh = &*made;
    }
    in.work.begin("surface points");
    // Errors of single shares average out in the sum: the cheap settings do.
    SurfacePointOptions options;
    options.samples_per_point = 16;
    options.elimination.candidates = elimination_candidates;
    check_spacing(own, AreaSampler(*mesh).area(), free_path);
    const SurfacePointSet set =
        points_for_spacing(*mesh, own.spacing * free_path, own.points, in.seed, options, in.work);
    ShapePoints result;
    result.area = set.area;
    for (std::size_t i = 0; i < set.p.size(); ++i) {
        const std::optional<Hit> hit =
            made ? rays.closest(set.p[i], 1e30f, in.shape)
                 : Hit{0.f, in.shape, set.triangle[i], set.barycentric[i].x, set.barycentric[i].y};
        result.at.push_back(rays.surface_point({}, *hit));
        result.p.push_back(result.at.back().p);
    }
    return result;
}

/// Power that enters at each point in each band: irradiance behind the boundary times area.
std::vector<float> power_at(const ShapeInput& in, const ShapePoints& points, int paths,
                            const Bands& bands) {
    const EntryLobe entry(in.boundary);
    const int groups = bands.groups(), samples = std::max(1, paths / groups);
    std::vector<float> power(points.p.size() * std::size_t(bands.count()));
    const Sampler prototype(Sampler::Kind::sobol, in.seed + 1, samples);
    WorkPhase phase(in.work, "irradiance",
                    points.p.size() * std::size_t(groups) * std::size_t(samples));
    tbb::parallel_for(std::size_t(0), points.p.size(), [&](std::size_t i) {
        Sampler sampler = prototype;
        RayCounts counts;
        for (int g = 0; g < groups; ++g) {
            const Wavelengths w = bands.group(g);
            Spectral sum(0.f);
            for (int s = 0; s < samples; ++s) {
                // Thousands of paths a point may be asked for.
                if (s > 0 && s % paths_at_a_time == 0) phase.advance(paths_at_a_time);
                sampler.start(i * std::size_t(groups) + std::size_t(g), std::uint32_t(s));
                sum +=
                    in.light->reflected(points.at[i], entry, {0.f, 0.f, 1.f}, sampler, w, counts);
            }
            phase.advance(std::uint64_t((samples - 1) % paths_at_a_time + 1));
            // `reflected` is irradiance over pi.
            sum *= Spectral(float(pi) / float(samples) * points.area[i]) / daylight(w);
            for (int b = 4 * g; b < std::min(4 * g + 4, bands.count()); ++b)
                power[i * std::size_t(bands.count()) + std::size_t(b)] = sum[b - 4 * g];
        }
    });
    return power;
}

}  // namespace

Translucency::Emergence TwoPass::emerge(const SurfacePoint& exit, const Vec3f& wo, Sampler& sampler,
                                        const Wavelengths& w, RayCounts& counts) const {
    float exitance[IrradianceTree::max_bands];
    tree_.gather(exit.p, kernels_, exitance);
    Emergence result;
    result.radiance = bands_.at(exitance, w) * daylight(w) * Spectral(exit_scale_ * float(1. / pi));
    if (single_) result.radiance += single_->radiance(exit, wo, sampler, w, counts);
    return result;
}

void check_spacing(const TwoPassOptions& options, double area, double free_path) {
    const auto least = [&](double limit) {
        return std::sqrt(2. / std::numbers::sqrt3 * area / limit) / free_path;
    };
    const double all = double(kMaxSurfacePoints),
                 eliminated = std::floor(all / elimination_candidates);
    const bool elimination = options.points == PointMethod::elimination;
    const double limit = elimination ? eliminated : all;
    if (options.spacing >= least(limit)) return;
    const double count = limit * std::pow(least(limit) / options.spacing, 2.);
    const double spacing = advised(least(limit));
    // The most points take minutes and more than ten gigabytes.
    const double easy = advised(std::min(std::sqrt(10.) * spacing, most_spacing));
    std::string advice = fmt::format(
        "set spacing to at least {:g}, or to {:g}, which takes a tenth of the time and memory",
        spacing, easy);
    if (spacing > most_spacing)
        advice = fmt::format(
            "spacing would have to be {:g}, and {:g} is the most: the object is too large for its "
            "medium; make it smaller by a factor of {:.3g}, or choose another technique",
            spacing, most_spacing, advised(spacing / most_spacing));
    else if (elimination && options.spacing >= least(all))
        advice += "; or set points to repulsion";
    throw InputError(fmt::format(
        "spacing = {:g} transport mean free paths takes {:.3g} surface points; with points = {} "
        "the limit is {:.0f}: {}",
        options.spacing, count, point_methods[std::size_t(options.points)].name, limit, advice));
}

DipoleKernel make_kernel(std::string_view profile, const ProfileMedium& medium) {
    const double s = medium.sigma_s_prime(), a = medium.sigma_a, over_4_pi = 0.25 / pi;
    if (profile == "dipole") {
        const Dipole<double> d(s, a, medium.eta);
        const auto source = [&](double z) {
            return DipoleKernel::Source{float(z * z), 0.f, float(d.albedo * z * over_4_pi)};
        };
        return {float(d.sigma_tr), source(d.z_r), source(d.z_v)};
    }
    if (profile == "better_dipole") {
        const BetterDipole<double> d(s, a, medium.eta);
        const auto source = [&](double z, double sign) {
            const double scale = d.albedo_squared * over_4_pi;
            return DipoleKernel::Source{float(z * z), float(sign * scale * d.c_phi / d.diffusion),
                                        float(scale * d.c_e * z)};
        };
        return {float(d.sigma_tr), source(d.z_r, 1.), source(d.z_v, -1.)};
    }
    throw InputError(
        fmt::format("two passes take the profiles dipole and better_dipole, not '{}'", profile));
}

namespace {

TwoPassOptions options_of(const ParameterValues& values) {
    return {.spacing = values.number("spacing"),
            .error = values.number("error"),
            .irradiance_samples = values.whole("irradiance_samples"),
            .points = values.choice<PointMethod>("points")};
}

TranslucencyPtr make_two_pass(const ShapeInput& in) {
    const TwoPassOptions options = options_of(in.options);
    const Bands bands(in.scene.mode);
    std::vector<DipoleKernel> kernels;
    double densest = 0.;
    for (const ProfileMedium& m : medium_in_bands(in.medium(), in.eta(), bands)) {
        check(m);
        DipoleKernel& kernel = kernels.emplace_back(make_kernel(in.profile, m));
        if (!in.rough_return.empty()) multiply(kernel, in.rough_return[kernels.size() - 1]);
        densest = std::max(densest, m.sigma_t_prime());
    }
    const auto profile = make_profile(in.profile, {});
    Stopwatch watch;
    const ShapePoints points = spread_points(in, options, 1. / densest);
    const double seconds_points = watch.lap();
    const std::vector<float> power = power_at(in, points, options.irradiance_samples, bands);
    const double seconds_irradiance = watch.lap();
    in.work.begin("hierarchy of the points");
    IrradianceTree tree(points.p, points.area, power, bands.count(), float(options.error));
    in.statistics.push_back({"points", double(points.p.size()), ""});
    in.statistics.push_back({"points_seconds", seconds_points, "s"});
    in.statistics.push_back({"irradiance_seconds", seconds_irradiance, "s"});
    in.statistics.push_back({"tree_seconds", watch.lap(), "s"});
    in.statistics.push_back({"tree_bytes", double(tree.bytes()), "bytes"});
    return std::make_shared<TwoPass>(
        in.boundary, std::move(tree), std::move(kernels), bands, exit_scale(in),
        single_scattering_of(in, profile->includes_single_scattering()));
}

}  // namespace

/// In the list of techniques/techniques.cpp.
const TechniqueDescription& two_pass_technique() {
    static const TechniqueDescription description{
        .name = "two_pass",
        .title = "two-pass hierarchy",
        .authors = "H. W. Jensen, J. Buhler",
        .year = 2002,
        .paper =
            "A Rapid Hierarchical Rendering Technique for Translucent Materials, SIGGRAPH "
            "2002",
        .how =
            "irradiance at points spread over the surface, then for each exit a sum over the "
            "points, far ones in groups",
        .precomputes = "surface points, irradiance, hierarchy",
        .keeps = {.view = true},
        .parameters = {profile_parameter({"dipole", "better_dipole"}),
                       exit_fresnel_parameter(),
                       single_scattering_parameter(),
                       {.name = "spacing",
                        .meaning = "of surface points, in transport mean free paths of the densest "
                                   "band",
                        .low = 0.01,
                        .high = most_spacing,
                        .otherwise = TwoPassOptions().spacing},
                       {.name = "error",
                        .meaning = "largest solid angle of points that count as one",
                        .unit = "sr",
                        .high = 10.,
                        .otherwise = TwoPassOptions().error},
                       // Mitsuba 0.6 writes irrSamples.
                       {.name = "irradiance_samples",
                        .meaning = "paths at each surface point",
                        .kind = ParameterKind::integer,
                        .low = 1.,
                        .high = 65536.,
                        .otherwise = double(TwoPassOptions().irradiance_samples),
                        .aliases = {"irr_samples"}},
                       choice_parameter("points", "how surface points are spread",
                                        {point_methods.begin(), point_methods.end()},
                                        int(TwoPassOptions().points))},
        .variants = "error=1|error=0.2|error=0.05",
        .prepare = prepare_path_technique,
        .below = make_two_pass};
    return description;
}

}  // namespace nacre
