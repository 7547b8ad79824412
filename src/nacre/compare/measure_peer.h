#pragma once
// Another renderer on the same scene, measured as techniques are.
#include "nacre/compare/measurement.h"
#include "nacre/peers/peer.h"

namespace nacre {

/// What peers need to know of a scene beside itself.
struct PeerSource {
    std::filesystem::path scene_file;            ///< empty for scenes made in memory
    std::map<std::string, std::string> defines;  ///< its -D
    int samples = 16;                            ///< a pixel
};

/// "cycles 16 spp"
std::string peer_id(const PeerDescription& peer, int samples);

/// Runs the peer `options.repeats` times with different seeds. `folder` keeps its jobs. The time
/// before the frame is all that the process took but for rendering; CPU time is not known and 0. An
/// absent program or a failure makes it `failed`, a stop `missing`.
Measurement measure_peer(const Scene& scene, const PeerDescription& peer, const PeerSource& source,
                         const std::filesystem::path& folder, const MeasurementOptions& options);

}  // namespace nacre
