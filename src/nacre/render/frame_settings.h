#pragma once
// What one picture of a scene is: seen by which camera, on which film, from how many samples.
#include "nacre/scene/scene.h"

namespace nacre {

/// A scene says it too; whoever renders it many times (comparisons, viewers, other seeds) asks for
/// frames of their own and leaves the scene as it is.
struct FrameSettings {
    CameraPtr camera;
    FilmSettings film;
    SamplerSettings sampler;

    /// What the scene's own <sensor> says.
    static FrameSettings of(const Scene& scene) {
        return {scene.camera, scene.film, scene.sampler};
    }
};

}  // namespace nacre
