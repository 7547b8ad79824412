#pragma once
// From a tree of nodes to a Scene, in parts. Used by the loaders only.
#include <optional>

#include "nacre/geometry/mesh_io.h"
#include "nacre/scene/build.h"
#include "nacre/scene/scene.h"

namespace nacre {

IntegratorSettings read_integrator(const SceneNode& node);
FilmSettings read_film(const SceneNode& node, BuildContext& context);
SamplerSettings read_sampler(const SceneNode& node);

/// The medium that `node` stands for, kept alive by the scene.
const Medium* add_medium(const SceneNode& node, Scene& scene, BuildContext& context);

/// What a <shape> of a mesh file says to its reader, and the file.
MeshOptions read_mesh_options(const SceneNode& shape);
std::filesystem::path find_mesh_file(const SceneNode& shape, BuildContext& context);
/// The id of a shape, else the file that it names, else its type.
std::string name_of_shape(const SceneNode& shape);

/// Light of a shape that cannot be built before all shapes are known.
struct PendingAreaLight {
    const SceneNode* emitter;
    std::uint32_t shape;
};

/// Adds the shape with its material and media to `scene`.
void add_shape(const SceneNode& node, Scene& scene, BuildContext& context,
               std::vector<PendingAreaLight>& lights);

/// Reads <subsurface type="dipole">: gives the shape a medium inside, a smooth boundary if it has
/// none of its own, and the settings.
///
///   material | sigma_s, sigma_a | sigma_t, albedo | surface_color, radius; scale; <phase>
///                     the matter, as in <medium type="homogeneous">
///   int_ior, ext_ior  indices of refraction (of the named material, else bk7; air)
///   method            the technique (two_pass)
///   and the options above
void read_subsurface(const SceneNode& node, ShapeBinding& shape, bool has_material, Scene& scene,
                     BuildContext& context);

/// Adds warnings of a camera in a medium that it does not name, and of closed shapes with media
/// that overlap or touch face to face. Looks at samples: a small overlap may pass.
void warn_about_media(Scene& scene);

/// Builds everything. `mode` unset: RGB bands unless something in the scene is spectral.
Scene build_scene(const SceneNodePtr& root, BuildContext& context, std::optional<ColorMode> mode);

}  // namespace nacre
