#pragma once
// What the viewer changes of a scene: matter, lights, form. The changes are made in the scene's
// tree and its meshes; nobody else knows of them.
#include "apps/viewer/orbit.h"
#include "nacre/realtime/gpu_scene.h"
#include "nacre/scene/rebuild.h"

namespace nacre::viewer {

/// What translucent shapes are made of.
struct MaterialEdit {
    enum class Kind { scene, measured, coefficients, artist } kind = Kind::scene;
    std::string name = "marble";               ///< measured: a medium's, or skin
    Vec3f sigma_s{2.19f, 2.62f, 3.f};          ///< coefficients: reduced, mm^-1
    Vec3f sigma_a{0.0021f, 0.0041f, 0.0071f};  ///< coefficients: mm^-1
    Vec3f color{0.8f, 0.55f, 0.45f};           ///< artist: of a thick body
    Vec3f radius{3.f, 1.5f, 1.f};              ///< artist: over which light spreads, mm
    float eta = 1.4f;                          ///< coefficients, artist
    bool operator==(const MaterialEdit&) const = default;
};
/// Throws InputError for values that no scene file could hold.
void check(const MaterialEdit& material);

/// A light of the scene, as its tree has it.
struct SceneLight {
    std::string name;                     ///< for people
    std::vector<std::size_t> place;       ///< child of the root, of that
    std::size_t shape = ~std::size_t{0};  ///< of the scene, for lamps
    bool turns = false;                   ///< it has a direction
    double azimuth = 0, elevation = 0;    ///< in which it stands, seen from the object's middle
    /// Of lamps that stand between the viewer's first place and the object or beside them: how many
    /// times as far, and as large, they are once they are turned, so that they do not come to stand
    /// in the viewer's way. Their light stays as it is.
    double behind = 1;
    LightPtr light = {};  ///< as it was built
};
std::vector<SceneLight> lights_of(const Scene& scene, const OrbitCamera& camera);

/// How one of them is changed.
struct LightEdit {
    double azimuth = 0, elevation = 0, brightness = 1;
    bool operator==(const LightEdit&) const = default;
};

/// The scene's lights as those edits make them, at once and for frames in the making: lamps shine
/// from where they go, while their shapes stay until the scene is built anew.
std::vector<LightPtr> moved_lights(const Scene& scene, const std::vector<SceneLight>& lights,
                                   const std::vector<LightEdit>& edits, const Compass& compass,
                                   const Vec3d& middle);

/// A scene's tree with its meshes, one a shape.
struct SceneParts {
    SceneNodePtr root;
    SceneMeshes meshes;
};

/// `from` in another material (kind scene: as it is), with lights turned and brighter or darker:
/// `edits`, one each of `lights`.
SceneParts edited(const Scene& scene, const SceneParts& from, const MaterialEdit& material,
                  const std::vector<SceneLight>& lights, const std::vector<LightEdit>& edits,
                  const Compass& compass, const Vec3d& middle);

/// Places and normals of the translucent shapes as the device bends them (deform.glsl): of a tree's
/// own meshes. Analytic shapes cannot be bent; `left_out` gets how many there were.
SceneMeshes deformed(const Scene& scene, const SceneMeshes& meshes, const Deformation& deformation,
                     int* left_out = nullptr);

}  // namespace nacre::viewer
