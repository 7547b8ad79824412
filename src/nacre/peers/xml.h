#pragma once
// A scene as a file that Mitsuba 3 reads. Used by the peer Mitsuba only.
#include "nacre/peers/job.h"

namespace nacre {

struct MitsubaScene {
    std::string xml;
    /// The scene's own file says the same to Mitsuba, so that this text is not needed.
    bool same_as_file = false;
};

/// Writes the scene; meshes and an environment made in memory go to files in request.folder.
/// What Mitsuba does not have is replaced by what it has. Throws InputError for volumes that it
/// cannot read.
MitsubaScene mitsuba_scene(const PeerRequest& request, Substitutions& substitutions);

}  // namespace nacre
