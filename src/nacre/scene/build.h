#pragma once
// From nodes of a scene file to the objects that integrators use. One function a family; each knows
// its types by a table of names and factories, so that an unknown type is answered with the nearest
// known one.
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "nacre/image/image.h"
#include "nacre/scene/camera.h"
#include "nacre/scene/light.h"
#include "nacre/scene/material.h"
#include "nacre/scene/medium.h"
#include "nacre/scene/texture.h"
#include "nacre/scene/xml/scene_node.h"

namespace nacre {

/// What a colour means, which decides how RGB becomes a spectrum.
enum class ColorRole { reflectance, unbounded, illuminant };

/// State of building one scene: where files are looked for, what was built already (a <ref> shares
/// it), warnings.
struct BuildContext {
    std::vector<std::filesystem::path>
        search_path;  ///< folder of the scene file first, then <path> elements
    double mm_per_unit = 1.0;
    std::vector<std::string> warnings;
    std::vector<std::filesystem::path>* files = nullptr;  ///< gets those that `file` finds
    int film_width = 0, film_height = 0;                  ///< instead of the scene's if positive

    // What was built, by its node; nodes that are made on the way, and no file's, stand in `made` and
    // live as long.
    std::vector<SceneNodePtr> made;
    std::map<const SceneNode*, MaterialPtr> materials;
    std::map<const SceneNode*, MediumPtr> media;
    std::map<std::pair<const SceneNode*, ColorRole>, TexturePtr> textures;
    /// Meshes that are in memory already, by the shape that they stand for.
    std::map<const SceneNode*, std::shared_ptr<Mesh>> meshes;
    /// Pictures of linear values that are in memory already, by the texture that they stand for.
    std::map<const SceneNode*, std::shared_ptr<const Image>> images;
    /// Lights that need the finished scene's bounding sphere (directional, constant, envmap) get it
    /// here.
    Point3f scene_center;
    float scene_radius = 1.f;

    /// The file named by the string parameter `name` of `node`; throws with the folders searched if
    /// it is not there.
    std::filesystem::path file(const SceneNode& node, std::string_view name) const;
    /// The same, or a folder.
    std::filesystem::path file_or_folder(const SceneNode& node, std::string_view name) const;
};

/// Throws InputError for negative values, and for a reflectance by a black body. Light given as one
/// number or as RGB is D65 of that colour (as in Mitsuba 3).
SpectrumPtr make_spectrum(const ColorValue& color, ColorRole role);
/// Parameter `name` of `node` as a spectrum; `otherwise` if absent.
SpectrumPtr get_spectrum(const SceneNode& node, std::string_view name, ColorRole role,
                         SpectrumPtr otherwise);
/// Parameter or nested <texture> `name` of `node`; a number, colour or texture.
TexturePtr get_texture(const SceneNode& node, std::string_view name, ColorRole role,
                       float otherwise, BuildContext& context);

MaterialPtr make_material(const SceneNode& node, BuildContext& context);
/// The types of <bsdf> that make_material knows.
std::vector<std::string> material_types();
TexturePtr make_texture(const SceneNode& node, ColorRole role, BuildContext& context);
MediumPtr make_medium(const SceneNode& node, BuildContext& context);
PhaseFunction make_phase(const SceneNode& node);
VolumePtr make_volume(const SceneNode& node, ColorRole role, BuildContext& context);
/// `aspect` is width over height of the full film.
CameraPtr make_camera(const SceneNode& node, float aspect, BuildContext& context);
/// Lights that are objects of their own: point, spot, directional, constant, envmap. Called after
/// all shapes are known.
LightPtr make_light(const SceneNode& node, BuildContext& context);
/// Light of a shape: <emitter type="area">. `rays` outlives the light.
LightPtr make_area_light(const SceneNode& node, const RayScene& rays, std::uint32_t shape,
                         BuildContext& context);

}  // namespace nacre
