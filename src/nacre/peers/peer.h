#pragma once
// Peers: other renderers on the user's machine that render the same scene, for comparison. nacre
// writes what the peer needs into a folder (meshes, a job, its log, the picture), runs it as a
// child process and reads the picture back. What a peer cannot do is replaced by the nearest that
// it can, and every replacement is listed.
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "nacre/catalogue/catalogue.h"
#include "nacre/image/image.h"
#include "nacre/scene/scene.h"

namespace nacre {

struct PeerRequest {
    const Scene& scene;
    /// The file that the scene was read from and its -D; empty for scenes made in memory.
    std::filesystem::path scene_file = {};
    std::map<std::string, std::string> defines = {};
    int samples = 16;  ///< a pixel
    std::uint64_t seed = 0;
    int threads = 0;                    ///< 0: all cores
    std::filesystem::path folder = {};  ///< made if absent; what is written there stays
    const std::atomic<bool>* stop = nullptr;
    std::string search_path = {};  ///< folders of programs, as in PATH; empty: PATH itself
};

struct PeerResult {
    Image picture;            ///< linear RGB, as nacre's film: its size, or that of its crop window
    double seconds = 0;       ///< of rendering alone, as the peer's job measures it
    double wall_seconds = 0;  ///< of the whole process
    double peak_mb = 0;       ///< largest resident memory of the process, MB
    std::string version;      ///< of the peer
    std::string command;      ///< what was run
    /// What the peer could not do and what stands for it, a sentence each.
    std::vector<std::string> substitutions;
};

struct PeerDescription {
    std::string_view name;   ///< on the command line
    std::string_view title;  ///< as its authors call it
    std::string_view how_to_install;
    /// The program on that search path (see PeerRequest), or nothing.
    std::optional<std::filesystem::path> (*find)(const std::string& search_path);
    /// Throws InputError if the program is absent or the scene is nothing that it could render, and
    /// RunError, with the last lines of its log, if it fails or was stopped.
    PeerResult (*run)(const PeerRequest& request);
};

const Catalogue<PeerDescription>& peers();

}  // namespace nacre
