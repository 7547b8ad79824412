#include "nacre/subsurface/technique.h"

#include <fmt/format.h>

#include <sstream>

#include "nacre/math/error.h"
#include "nacre/render/path_tracer.h"
#include "nacre/render/surface_sampling.h"
#include "nacre/render/volume_path_tracer.h"
#include "nacre/subsurface/rough_half_space.h"
#include "nacre/text/names.h"
#include "nacre/text/split_words.h"

namespace nacre {
namespace {

constexpr TechniqueDescription catalogue[] = {
    {.name = "volpath",
     .title = "complete simulation",
     .authors = "J. T. Kajiya, B. P. Von Herzen",
     .year = 1984,
     .paper = "Ray Tracing Volume Densities, SIGGRAPH 84",
     .how = "paths through the medium, without approximation: the reference",
     .precomputes = "distance grid and exit guide",
     .may_change = "view, light, material"},
    {.name = "brdf",
     .title = "local reflection",
     .authors = "J. H. Lambert",
     .year = 1760,
     .paper = "Photometria; with the total of a diffusion profile as albedo",
     .how = "all light leaves where it came in, through the same boundary",
     .precomputes = "",
     .may_change = "view, light, material, geometry",
     .profiles = "all",
     .options = "exit_fresnel",
     .variants = "profile=dipole",
     .make = make_local_reflection},
    {.name = "hanrahan_krueger",
     .title = "local reflection with single scattering",
     .authors = "P. Hanrahan, W. Krueger",
     .year = 1993,
     .paper = "Reflection from Layered Surfaces due to Subsurface Scattering, SIGGRAPH 93; with "
              "what a diffusion profile holds of higher orders",
     .how = "all light leaves where it came in: the first order of a half space in closed form, "
            "higher orders as Lambert's law with the profile's total, less the first order where "
            "the profile includes it",
     .precomputes = "",
     .may_change = "view, light, material, geometry",
     .profiles = "all",
     .options = "exit_fresnel single_scattering",
     .variants = "profile=dipole|profile=better_dipole",
     .make = make_hanrahan_krueger},
    {.name = "surface",
     .title = "BSSRDF by surface sampling",
     .authors = "H. W. Jensen, S. Marschner, M. Levoy, P. Hanrahan; A. King, C. Kulla, A. Conty, "
                "M. Fajardo",
     .year = 2001,
     .paper = "A Practical Model for Subsurface Light Transport, SIGGRAPH 2001; BSSRDF Importance "
              "Sampling, SIGGRAPH Talks 2013",
     .how = "for each exit one point of entry around it, drawn by probe rays after the profile",
     .precomputes = "tables of the profile",
     .may_change = "view, light, geometry",
     .profiles = "all",
     .options = "exit_fresnel single_scattering",
     // The six Gaussians are those of skin whatever the medium: only who asks for them gets them.
     .variants = "profile=dipole|profile=better_dipole|profile=quantised_diffusion|"
                 "profile=photon_beam_diffusion|profile=normalised_diffusion|"
                 "profile=multipole",
     .make = make_surface_sampling},
    {.name = "random_walk",
     .title = "random walk from surface albedo",
     .authors = "M. J.-Y. Chiang, P. Kutz, B. Burley",
     .year = 2016,
     .paper = "Practical and Controllable Subsurface Scattering for Production Path Tracing, "
              "SIGGRAPH 2016 Talks",
     .how = "a walk without refraction, isotropic and of diffuse entry and exit, in the medium "
            "whose half space would return the same share of the light, by their fit",
     .precomputes = "",
     .may_change = "view, light, material, geometry",
     .options = "exit_fresnel free_path",
     .variants = "free_path=transport|free_path=diffuse",
     .make = make_random_walk},
    {.name = "two_pass",
     .title = "two-pass hierarchy",
     .authors = "H. W. Jensen, J. Buhler",
     .year = 2002,
     .paper = "A Rapid Hierarchical Rendering Technique for Translucent Materials, SIGGRAPH 2002",
     .how = "irradiance at points spread over the surface, then for each exit a sum over the "
            "points, far ones in groups",
     .precomputes = "surface points, irradiance, hierarchy",
     .may_change = "view",
     .profiles = "dipole, better_dipole",
     .options = "exit_fresnel single_scattering spacing error irradiance_samples points",
     .variants = "error=1|error=0.2|error=0.05",
     .make = make_two_pass},
};

constexpr auto names = [] {
    std::array<std::string_view, std::size(catalogue)> n;
    for (std::size_t i = 0; i < n.size(); ++i) n[i] = catalogue[i].name;
    return n;
}();

/// Calls `f` so that what it refuses names the place in the scene file.
template <class F>
auto at_place(const SubsurfaceSettings& settings, F&& f) {
    try {
        return f();
    } catch (const InputError& error) {
        throw InputError(settings.prefix() + error.what());
    }
}

std::shared_ptr<const ProfileTables> tables_of(const TechniqueInput& in) {
    return std::make_shared<ProfileTables>(*in.scene.shapes[in.shape].interior, in.eta,
                                           in.settings.profile, Bands(in.scene.mode),
                                           in.rough_return, in.work);
}

/// What a translucent shape is to light on its way to another place: a Lambert surface that returns
/// what the boundary and the medium do on average. Its mirror images of lamps would be found by one
/// path in thousands and show as bright points.
class StandIn final : public Translucency {
  public:
    StandIn(std::shared_ptr<const ProfileTables> profile, float mirror, float below)
        : Translucency(1.f), profile_(std::move(profile)), mirror_(mirror), below_(below) {}

    Emergence emerge(const SurfacePoint& exit, const Vec3f&, Sampler&, const Wavelengths& w,
                     RayCounts&) const override {
        return {Spectral(0.f), exit, Spectral(mirror_) + Spectral(below_) * profile_->total(w)};
    }

  private:
    std::shared_ptr<const ProfileTables> profile_;
    float mirror_, below_;
};

TranslucencyPtr make_stand_in(const TechniqueInput& in) {
    const float mirror = float(in.boundary.mean_reflectance());
    const float enters =
        in.boundary.rough() ? float(in.boundary.mean_transmittance()) : 1.f - mirror;
    return std::make_shared<StandIn>(tables_of(in), mirror, enters * enters * in.exit_scale);
}

/// A sheet has no inside for light to be scattered in.
void refuse_flat(const Scene& scene, std::uint32_t shape) {
    const Vec3f size = scene.rays.bounds(shape).diagonal();
    const float least = std::min({size.x, size.y, size.z}),
                most = std::max({size.x, size.y, size.z});
    if (!(least > 1e-6f * most))
        throw InputError(fmt::format(
            "{}'{}' is flat: it has no inside for light to be scattered in; give it a thickness",
            scene.shapes[shape].subsurface->prefix(), scene.shapes[shape].name));
}

const TechniqueDescription& technique_of(const SubsurfaceSettings& settings) {
    return *at_place(settings, [&] { return &find_technique(settings.technique); });
}

bool has_technique(const ShapeBinding& shape) { return shape.subsurface != nullptr; }

/// Whether the shape asks for complete simulation.
bool wants_simulation(const ShapeBinding& shape) {
    return shape.subsurface && !technique_of(*shape.subsurface).make;
}

class TechniqueIntegrator final : public Integrator {
  public:
    TechniqueIntegrator(const Scene& scene, const Work& work) {
        for (const ShapeBinding& shape : scene.shapes)
            surfaces_.push_back(surface_of(scene, shape, work));
        Translucencies local(scene.shapes.size());
        for (std::uint32_t i = 0; i < scene.shapes.size(); ++i)
            if (scene.shapes[i].subsurface) local[i] = make(scene, i, make_stand_in, nullptr, work);
        // Its paths are averaged over, so they may end early: an object that stands on a floor sees
        // light go to and fro in the gap for ever.
        const PathTracer light(scene, local, 2);
        Translucencies below(scene.shapes.size());
        for (std::uint32_t i = 0; i < scene.shapes.size(); ++i)
            if (const auto& settings = scene.shapes[i].subsurface) {
                const TechniqueDescription& technique = technique_of(*settings);
                if (!technique.make)
                    throw InputError(
                        fmt::format("{}'{}' simulates the whole scene: give all translucent shapes "
                                    "this method, or none",
                                    settings->prefix(), technique.name));
                below[i] = make(scene, i, technique.make, &light, work);
            }
        tracer_ = std::make_unique<PathTracer>(scene, std::move(below));
    }

    Spectral radiance(const Ray& ray, Sampler& sampler, const Wavelengths& wavelengths,
                      RayCounts& counts) const override {
        return tracer_->radiance(ray, sampler, wavelengths, counts);
    }
    Statistics statistics() const override { return statistics_; }

  private:
    TranslucencyPtr make(const Scene& scene, std::uint32_t shape,
                         TranslucencyPtr (*maker)(const TechniqueInput&), const PathTracer* light,
                         const Work& work) {
        const SubsurfaceSettings& settings = *scene.shapes[shape].subsurface;
        refuse_flat(scene, shape);
        const Surface& surface = surfaces_[shape];
        const ObjectBoundary& boundary = surface.boundary;
        const float scale =
            float(1. / (settings.exit == "paper" ? 1. : boundary.mean_transmittance()));
        return at_place(settings, [&] {
            return maker({scene, shape, settings, boundary.eta(), scale, boundary,
                          surface.rough_return, light, statistics_, work});
        });
    }

    /// What is between a translucent shape's matter and the rest.
    struct Surface {
        ObjectBoundary boundary{1.f};
        std::vector<double> rough_return{};
    };
    static Surface surface_of(const Scene& scene, const ShapeBinding& shape, const Work& work) {
        if (!shape.subsurface) return {};
        return at_place(*shape.subsurface, [&] {
            Surface s{ObjectBoundary::of(shape)};
            s.rough_return = rough_return(
                s.boundary, medium_in_bands(*shape.interior, s.boundary.eta(), Bands(scene.mode)),
                work);
            return s;
        });
    }

    std::vector<Surface> surfaces_;  // of each shape; while the techniques are made
    std::unique_ptr<PathTracer> tracer_;
    Statistics statistics_;
};

}  // namespace

std::span<const TechniqueDescription> techniques() { return catalogue; }

const TechniqueDescription& find_technique(std::string_view name) {
    const int i = find_name(name, names);
    if (i < 0) throw InputError(unknown_name("technique", name, names));
    return catalogue[i];
}

std::vector<TechniqueChoice> variants_of(const TechniqueDescription& technique) {
    std::vector<TechniqueChoice> result;
    std::istringstream variants{std::string(technique.variants)};
    for (std::string variant; std::getline(variants, variant, '|');) {
        TechniqueChoice& choice = result.emplace_back(std::string(technique.name));
        std::istringstream settings(variant);
        for (std::string setting; settings >> setting;) {
            const std::size_t equals = setting.find('=');
            const std::string name = setting.substr(0, equals), value = setting.substr(equals + 1);
            if (name == "profile")
                choice.profile = value;
            else
                choice.options.emplace_back(name, value);
        }
    }
    if (result.empty()) result.push_back({std::string(technique.name)});
    return result;
}

void check_choice(const TechniqueChoice& choice) {
    const TechniqueDescription& technique = find_technique(choice.technique);
    if (!choice.profile.empty()) {
        profiles().find(choice.profile);
        if (technique.profiles.empty())
            throw InputError(fmt::format("technique '{}' has no profile: leave out '{}'",
                                         technique.name, choice.profile));
    }
    SubsurfaceSettings checked;
    const std::vector<std::string_view> own = split_words(technique.options);
    for (const auto& [name, value] : choice.options) {
        set_option(checked, name, value);
        if (std::ranges::find(own, name) == own.end())
            throw InputError(fmt::format(
                "technique '{}' has no option '{}'; {}", technique.name, name,
                own.empty() ? "it has none" : fmt::format("it has: {}", fmt::join(own, ", "))));
    }
}

void choose_technique(Scene& scene, const TechniqueChoice& choice) {
    check_choice(choice);
    const TechniqueDescription& technique = find_technique(choice.technique);
    if (!technique.make) {
        scene.integrator.type = "volpath";
        return;
    }
    use_technique(scene, [&](SubsurfaceSettings& settings) {
        settings.technique = std::string(technique.name);
        if (!choice.profile.empty()) settings.profile = choice.profile;
        for (const auto& [name, value] : choice.options) set_option(settings, name, value);
    });
}

bool is_simulated(const Scene& scene) {
    if (scene.integrator.type != "path") return scene.integrator.type == "volpath";
    const auto count = std::ranges::count_if(scene.shapes, wants_simulation);
    return count > 0 && count == std::ranges::count_if(scene.shapes, has_technique);
}

std::unique_ptr<Integrator> make_technique_integrator(const Scene& scene, const Work& work) {
    if (scene.integrator.type != "path" || std::ranges::none_of(scene.shapes, has_technique))
        return make_integrator(scene, work);
    if (is_simulated(scene)) return std::make_unique<VolumePathTracer>(scene, work);
    return std::make_unique<TechniqueIntegrator>(scene, work);
}

std::shared_ptr<const SingleScatteringTerm> single_scattering_of(const TechniqueInput& in,
                                                                 bool profile_includes_it) {
    const std::string& choice = in.settings.single_scattering;
    if (choice == "off" || (choice == "auto" && profile_includes_it)) return nullptr;
    return std::make_shared<SingleScatteringTerm>(in.scene, in.shape, in.boundary);
}

TranslucencyPtr make_local_reflection(const TechniqueInput& in) {
    return std::make_shared<LocalReflection>(in.boundary, tables_of(in), in.exit_scale);
}

TranslucencyPtr make_surface_sampling(const TechniqueInput& in) {
    const auto tables = tables_of(in);
    return std::make_shared<SurfaceSampling>(
        in.scene, in.shape, in.boundary, tables, in.exit_scale,
        single_scattering_of(in, tables->includes_single_scattering()));
}

}  // namespace nacre
