#pragma once
// The techniques that make an image of a translucent object, by name. One list, which the command
// line, the scene reader and comparisons walk: a technique appears in it by its line in
// technique.cpp.
#include <memory>
#include <span>
#include <string_view>

#include "nacre/render/integrator.h"
#include "nacre/render/translucency.h"
#include "nacre/scene/subsurface.h"

namespace nacre {

class PathTracer;

/// What a technique is made of: one shape of a scene.
struct TechniqueInput {
    const Scene& scene;
    std::uint32_t shape;
    const SubsurfaceSettings& settings;
    float eta;         ///< index of the medium over that outside
    float exit_scale;  ///< 1, or 1 over the boundary's mean transmittance (settings.exit)
    const ObjectBoundary& boundary;
    /// In each band, the factor of what returns behind a rough boundary (rough_half_space.h); empty
    /// if it is smooth.
    std::span<const double> rough_return;
    /// Traces paths among surfaces, translucent shapes as local reflectors: for light that falls on
    /// the shape. Null while those are being made.
    const PathTracer* light;
    Statistics& statistics;  ///< what precomputation took
    const Work& work;        ///< whether to stop, and whom to tell how far precomputation is
};

struct TechniqueDescription {
    std::string_view name;   ///< in scene files and on the command line
    std::string_view title;  ///< as the field says
    std::string_view authors;
    int year = 0;
    std::string_view paper;
    std::string_view how;          ///< a sentence or two
    std::string_view precomputes;  ///< before the first picture; empty if nothing
    std::string_view may_change;  ///< without computing that again: view, light, material, geometry
    std::string_view profiles = "";  ///< that it takes; empty if it needs none
    std::string_view options = "";   ///< of subsurface_options that it heeds, separated by blanks
    /// The settings at which comparisons run it, separated by '|', each "name=value name=value" of
    /// options, where "profile" is the profile; all else is as by default. Empty: the defaults
    /// alone.
    std::string_view variants = "";
    TranslucencyPtr (*make)(const TechniqueInput&) = nullptr;  ///< null: complete simulation
};

std::span<const TechniqueDescription> techniques();
/// By name, regardless of case, blanks, dashes and underscores; throws InputError with the nearest.
const TechniqueDescription& find_technique(std::string_view name);

/// What is asked for beyond the scene's own settings.
struct TechniqueChoice {
    std::string technique;
    std::string profile = {};  ///< empty: as the scene says, or the dipole
    std::vector<std::pair<std::string, std::string>> options = {};  ///< as of set_option
};
/// The description's variants, one at least.
std::vector<TechniqueChoice> variants_of(const TechniqueDescription& technique);
/// Has the scene rendered by a technique: complete simulation by volpath, any other by path with
/// that technique in all translucent shapes. Throws InputError for unknown names and values, for a
/// profile or options that the technique does not have, and if nothing in the scene is translucent.
void choose_technique(Scene& scene, const TechniqueChoice& choice);
/// Throws InputError, as above, for what is wrong with a choice whatever the scene.
void check_choice(const TechniqueChoice& choice);

/// Whether the scene is rendered by complete simulation: it asks for `volpath`, or for `path` with
/// that technique in all its translucent shapes. Throws InputError for techniques not known.
bool is_simulated(const Scene& scene);
/// The integrator that the scene names, with the techniques that its shapes name if it is `path`.
/// Precomputation happens here. `scene` outlives it. Throws InputError, with the place in the file
/// where there is one, for names that are not known, and Stopped if `work` says so.
std::unique_ptr<Integrator> make_technique_integrator(const Scene& scene, const Work& work = {});

class SingleScatteringTerm;
/// The term of single scattering, if settings and profile want it; else null.
std::shared_ptr<const SingleScatteringTerm> single_scattering_of(const TechniqueInput& input,
                                                                 bool profile_includes_it);

// The techniques' makers.
TranslucencyPtr make_local_reflection(const TechniqueInput& input);
TranslucencyPtr make_hanrahan_krueger(const TechniqueInput& input);
TranslucencyPtr make_surface_sampling(const TechniqueInput& input);
TranslucencyPtr make_random_walk(const TechniqueInput& input);
TranslucencyPtr make_two_pass(const TechniqueInput& input);

}  // namespace nacre
