#pragma once
// What a scene is, ready to render.
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "nacre/geometry/ray_scene.h"
#include "nacre/scene/camera.h"
#include "nacre/scene/light.h"
#include "nacre/scene/material.h"
#include "nacre/scene/medium.h"

namespace nacre {

struct SubsurfaceSettings;
class SceneNode;

/// What is attached to shape i of the ray scene.
struct ShapeBinding {
    std::string name;                  ///< id or file name, for messages
    MaterialPtr material;              ///< never null
    const Light* light = nullptr;      ///< area light on it
    const Medium* interior = nullptr;  ///< medium below the surface; null is vacuum
    const Medium* exterior = nullptr;
    /// How `path` approximates the medium below (scene/subsurface.h); null: not at all.
    std::shared_ptr<const SubsurfaceSettings> subsurface;
    bool separates_media =
        false;  ///< interior or exterior was given: crossing the shape changes the medium
};

struct FilterSettings {
    std::string type = "gaussian";  ///< box, tent, gaussian, mitchell
    float radius = 0.f;  ///< 0: the type's default (box 0.5, tent 1, gaussian 4 stddev, mitchell 2)
    float stddev = 0.5f;                 ///< gaussian
    float b = 1.f / 3.f, c = 1.f / 3.f;  ///< mitchell

    bool operator==(const FilterSettings&) const = default;
};

enum class FilmQuantity { radiance, luminance, illuminance };

struct FilmSettings {
    int width = 768, height = 576;
    int crop_x = 0, crop_y = 0, crop_width = 0,
        crop_height = 0;  ///< crop_width = 0: the whole film
    FilterSettings filter;
    bool sample_border = false;  ///< whether wide filters also take samples from beyond the film
    FilmQuantity quantity = FilmQuantity::radiance;
};

struct SamplerSettings {
    std::string type = "independent";  ///< independent, stratified, sobol
    int samples = 16;
    std::uint64_t seed = 0;
};

struct LegacySettings;

struct IntegratorSettings {
    std::string type = "path";  ///< ray, path, volpath, legacy
    int max_depth = -1;         ///< number of path segments; -1: no limit; 1 shows only what shines
    int rr_depth = 5;           ///< from this depth on Russian roulette may end a path
    bool hide_emitters = false;
    bool moment = false;  ///< also write the per-pixel variance of a single sample
    // The accelerations of volpath, each to be switched off by itself.
    bool distance_grid = true;
    bool guided_exits = true;
    /// Of `legacy` (scene/legacy_settings.h); null otherwise.
    std::shared_ptr<const LegacySettings> legacy;
};

struct Scene {
    /// Behind a pointer because lights refer to it: it stays where it is when the scene is moved.
    std::unique_ptr<RayScene> rays_owner = std::make_unique<RayScene>();
    RayScene& rays = *rays_owner;
    std::vector<ShapeBinding> shapes;  ///< one for each shape of `rays`
    std::vector<LightPtr> lights;
    const Light* environment =
        nullptr;  ///< what rays that leave the scene meet; also among `lights`
    /// What the viewer sees instead of the environment where nothing is, and what lights nothing;
    /// null: the environment.
    LightPtr background;
    std::vector<MediumPtr> media;
    CameraPtr camera;
    const Medium* camera_medium = nullptr;
    ColorMode mode = ColorMode::rgb_bands;
    double mm_per_unit = 1.0;
    FilmSettings film;
    SamplerSettings sampler;
    IntegratorSettings integrator;
    std::vector<std::string> warnings;
    /// What it was built from, for those who write it for other programs; its <shape> children, in
    /// order, are `shapes`. Files that it names are in the first of these folders that has them.
    std::shared_ptr<const SceneNode> root;
    std::vector<std::filesystem::path> search_path;

    /// What a ray meets that leaves the scene after so many bounces; null: nothing.
    const Light* beyond(int bounces) const {
        return bounces == 0 && background ? background.get() : environment;
    }
};

}  // namespace nacre
