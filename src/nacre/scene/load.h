#pragma once
// Reads a scene file, or makes a scene around a bare mesh.
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "nacre/scene/scene.h"
#include "nacre/scene/scene_node.h"

namespace nacre {

struct LoadOptions {
    std::map<std::string, std::string> defines;  ///< -D name=value
    /// Unset: RGB bands, unless the scene carries genuine wavelength data (tabulated spectra, black
    /// bodies, dispersion).
    std::optional<ColorMode> mode;
};

/// Reads the file into a tree of nodes: defaults, -D, includes, references and transforms are
/// resolved. Scenes of version < 2 (Mitsuba 0.x) have their camelCase names turned into today's.
/// Throws InputError "file:line:column: what is wrong; did you mean 'x'?".
SceneNodePtr read_scene_xml(const std::filesystem::path& file,
                            const std::map<std::string, std::string>& defines,
                            std::vector<std::filesystem::path>& search_path);

Scene load_scene(const std::filesystem::path& file, const LoadOptions& options = {});

struct MeshSceneOptions {
    std::string material = "marble";  ///< one of the measured media (optics/media.h)
    std::optional<double> height_mm;  ///< how tall the object is; unset: 100 mm
    int width = 512, height = 512;
    std::optional<ColorMode> mode;
};
/// A mesh file as a scene: the object in the measured medium behind a smooth boundary, standing on
/// a floor, camera and lights chosen to frame it (key light, rim light from behind for
/// translucency, soft environment).
Scene load_mesh_scene(const std::filesystem::path& file, const MeshSceneOptions& options = {});
/// The same for a mesh in memory.
Scene make_mesh_scene(std::shared_ptr<Mesh> mesh, const MeshSceneOptions& options);

}  // namespace nacre
