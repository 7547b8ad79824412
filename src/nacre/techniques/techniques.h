#pragma once
// The one list of all techniques, and what it takes to render a scene with them: the command line,
// comparisons and the documentation walk it. A technique appears everywhere by its line in
// techniques.cpp.
#include "nacre/catalogue/catalogue.h"
#include "nacre/technique/technique.h"

namespace nacre {

/// All descriptions; finds one by name, regardless of case, blanks, dashes and underscores.
const Catalogue<TechniqueDescription>& techniques();

/// A technique and what is asked of it beyond the scene's own settings.
struct TechniqueChoice {
    std::string technique;
    std::vector<std::pair<std::string, std::string>> options = {};  ///< name, value

    /// The value of an option, the last that was given; empty: none was.
    std::string option(std::string_view name) const;
};
/// The description's variants, one at least.
std::vector<TechniqueChoice> variants_of(const TechniqueDescription& technique);
/// The choice with the names of the list: "Better Dipole" is better_dipole. Throws InputError for
/// what is wrong with it whatever the scene: unknown names and values, options that the technique
/// does not have.
TechniqueChoice checked(const TechniqueChoice& choice);

/// Which integrator renders a scene, and which techniques its shapes.
struct RenderPlan {
    std::string integrator;  ///< ray, path, volpath, legacy, or the name of a technique of its own
    std::vector<ShapeTechnique> shapes;  ///< one a shape; none where the integrator alone counts
    /// Of what techniques draw before the first frame (points on surfaces, paths to them).
    std::uint64_t seed = 0;

    bool has_technique(std::uint32_t shape) const {
        return shape < shapes.size() && shapes[shape].technique != nullptr;
    }
    /// Complete simulation: the integrator is volpath.
    bool is_simulation() const { return integrator == "volpath"; }
};

/// As the scene says: its integrator, its seed and, if that is `path`, the techniques of its <subsurface>.
/// If all of them are complete simulation, `volpath`. Throws InputError, with the place in the
/// file, for names and values that no technique knows. Options of other techniques than the
/// shape's are checked and not heeded: one file serves all.
RenderPlan plan_of(const Scene& scene);
/// All translucent shapes by one technique, whatever the scene says, with its options where the
/// choice is silent. Throws InputError as above and as `checked`, and if nothing in the scene is
/// translucent.
RenderPlan plan_of(const Scene& scene, const TechniqueChoice& choice);

/// Precomputation happens here. `scene` outlives it. Throws InputError, with the place in the file
/// where there is one, for what a technique cannot do, and Stopped if `work` says so.
TechniquePtr prepare(const Scene& scene, const RenderPlan& plan, const Work& work = {});
/// Prepares and renders one frame; progress, times and interruption as of render.h.
RenderResult render(const Scene& scene, const RenderPlan& plan, const FrameSettings& frame,
                    const RenderOptions& options = {});

}  // namespace nacre
