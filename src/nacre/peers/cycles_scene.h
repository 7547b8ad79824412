#pragma once
// A scene as the Cycles job (cycles_job.h) takes it. Used by the peer Cycles only.
#include <nlohmann/json.hpp>

#include "nacre/peers/job.h"
#include "nacre/peers/view.h"
#include "nacre/scene/build.h"

namespace nacre {

/// Light of one colour as Blender takes it: a colour within [0, 1] and its strength.
nlohmann::json color_and_strength(const Vec3f& rgb);

/// Turns materials and media of shapes into shader trees; writes the images of textures into
/// `folder`.
class CyclesMaterials {
  public:
    /// `random_walk`: translucent shapes become Blender's subsurface scattering.
    CyclesMaterials(const Scene& scene, std::filesystem::path folder, bool random_walk,
                    Substitutions& substitutions);

    /// Adds "shader" and "volume" of shape i to `spec`, and fits the texture coordinates of `mesh`
    /// to baked images.
    void add_to(nlohmann::json& spec, std::uint32_t shape, Mesh& mesh);

  private:
    nlohmann::json surface(const SceneNode& bsdf);
    nlohmann::json reflecting(const SceneNode& bsdf);
    nlohmann::json plastic(const SceneNode& bsdf);
    nlohmann::json metal(const SceneNode& bsdf);
    nlohmann::json glass(const SceneNode& bsdf);
    nlohmann::json emission(const SceneNode& emitter);
    nlohmann::json subsurface(const ShapeBinding& shape);
    nlohmann::json volume(const Medium& medium);
    /// Parameter `name` of `node`, a colour; a texture as an image.
    nlohmann::json color(const SceneNode& node, const char* name, float otherwise,
                         ColorRole role = ColorRole::reflectance);
    /// The same for a parameter that must be one colour: a texture is replaced by its mean.
    Vec3f mean_color(const SceneNode& node, const char* name, float otherwise,
                     ColorRole role = ColorRole::reflectance);
    nlohmann::json bake(const Texture& texture);
    /// Adds distribution and roughness of a rough surface to a shader.
    void add_roughness(nlohmann::json& shader, const SceneNode& bsdf);
    void substitute(const std::string& sentence);

    const Scene& scene_;
    std::filesystem::path folder_;
    bool random_walk_;
    Substitutions& substitutions_;
    BuildContext context_;
    std::uint32_t shape_ = 0;  ///< at work
    Mesh* mesh_ = nullptr;
    int images_ = 0;
};

/// Three numbers, as scene.json has them.
nlohmann::json triple(const Vec3f& v);

/// Writes meshes and images into `folder` and returns what goes into scene.json, for a picture
/// file of that name.
nlohmann::json cycles_scene(const PeerRequest& request, const std::string& output, bool random_walk,
                            Substitutions& substitutions);

}  // namespace nacre
