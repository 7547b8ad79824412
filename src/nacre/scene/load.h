#pragma once
// Reads a scene file, or makes a scene around a bare mesh.
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "nacre/geometry/mesh_pose.h"
#include "nacre/scene/scene.h"
#include "nacre/scene/stage.h"
#include "nacre/scene/xml/scene_node.h"

namespace nacre {

struct MeasuredMedium;

struct LoadOptions {
    std::map<std::string, std::string> defines = {};  ///< -D name=value
    /// Unset: RGB bands, unless the scene carries genuine wavelength data (tabulated spectra, black
    /// bodies, dispersion).
    std::optional<ColorMode> mode = {};
    int width = 0, height = 0;  ///< of the film, instead of what the scene says; 0: as it says
    /// Gets the files that the scene names: meshes, images, volumes.
    std::vector<std::filesystem::path>* files = nullptr;
};

/// Reads the file into a tree of nodes: defaults, -D, includes, references and transforms are
/// resolved. Scenes of version < 2 (Mitsuba 0.x) have their camelCase names turned into today's.
/// Throws InputError "file:line:column: what is wrong; did you mean 'x'?".
SceneNodePtr read_scene_xml(const std::filesystem::path& file,
                            const std::map<std::string, std::string>& defines,
                            std::vector<std::filesystem::path>& search_path);

Scene load_scene(const std::filesystem::path& file, const LoadOptions& options = {});

/// What a bare mesh may be made of: the measured medium of that name, or null for skin. Throws
/// InputError with the nearest name and the list of all.
const MeasuredMedium* translucent_material(std::string_view name);

struct MeshSceneOptions {
    /// A measured medium (optics/media.h), or skin. Unset: a glTF's own materials if it has any,
    /// else marble.
    std::optional<std::string> material = {};
    /// How tall the object is; unset: 100 mm, or less if that makes it wider than 250 mm.
    std::optional<double> height_mm = {};
    int width = 512, height = 512;
    std::optional<ColorMode> mode = {};
    /// Edges between triangles whose normals differ by more are hard, degrees from 0 to 180; unset:
    /// normals as in the file, else default_crease_angle (mesh_build.h).
    std::optional<double> crease_angle = {};
    std::optional<SignedAxis> up = {};  ///< of the file's axes; unset: guessed (mesh_pose.h)
    StageOptions stage = {};            ///< viewer, lights, surroundings, floor
    MeshPose* pose = nullptr;           ///< gets how the object stands in its file
};
/// A mesh file as a scene: the object in a translucent medium behind a smooth boundary, standing on
/// a floor, camera and lights chosen to frame it (warm key light, strong light from behind for
/// translucency, soft environment), or as `stage` says. The mesh is turned upright, its front to
/// +z, and scaled to its height; a mesh that is inside out is turned round. What is up and where
/// the front is in the file, the shape tells if it is clear (guess_pose), else custom: up is +z in
/// STL and +y elsewhere. glTF says it, and is not guessed. Scene units are millimetres. The medium
/// is the measured one, or that of <medium type="skin"> with its defaults, which makes the scene
/// spectral; either with reduced coefficients and isotropic scattering. A glTF with materials has
/// those instead (docs/gltf.md). Integrator volpath, 64 samples.
/// Throws InputError for unknown media, unreadable or flat meshes.
Scene load_mesh_scene(const std::filesystem::path& file, const MeshSceneOptions& options = {});
/// How the mesh of a file stands in it: what load_mesh_scene takes for up and front.
MeshPose pose_of_file(const std::filesystem::path& file, const Mesh& mesh,
                      std::optional<SignedAxis> given_up = {});
/// The same for a mesh in memory, which is not changed; +y is up by custom.
Scene make_mesh_scene(std::shared_ptr<Mesh> mesh, const MeshSceneOptions& options);

}  // namespace nacre
