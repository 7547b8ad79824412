#pragma once
// The stage of a bare mesh as nodes of a scene. Used by the loader only.
#include "nacre/geometry/mesh.h"
#include "nacre/scene/build.h"
#include "nacre/scene/stage.h"
#include "nacre/scene/xml/write_nodes.h"

namespace nacre {

/// What stands on the stage, and the film.
struct StagePlan {
    Box3f object;
    double height;  ///< of the object
    int width_pixels, height_pixels;
};

/// Adds camera, lights and floor to the scene's root. Throws InputError for a viewer below the
/// floor.
void set_stage(const NodePtr& root, const StagePlan& plan, const StageOptions& options);
/// What only the viewer sees; null if that is what lights.
LightPtr stage_background(const StageOptions& options, BuildContext& context);

}  // namespace nacre
