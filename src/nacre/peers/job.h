#pragma once
// What the peers share: running a job that nacre has written, and reading its picture back.
#include "nacre/peers/peer.h"

namespace nacre {

/// Sentences about what was replaced, each once.
class Substitutions {
  public:
    void add(std::string sentence);
    std::vector<std::string> sentences;
};

/// The one line that says that a peer is not installed.
[[noreturn]] void throw_absent(std::string_view title, std::string_view how_to_install);

/// Throws InputError if the picture is one that only nacre makes: illumination models before the
/// BRDF, luminance or illuminance.
void check_comparable(const Scene& scene, std::string_view title);

/// Runs the job `words` with its log in request.folder and reads `picture` there. The job prints
/// the lines "nacre: version VERSION" and "nacre: seconds SECONDS".
PeerResult run_peer_job(const PeerRequest& request, std::string_view name,
                        const std::vector<std::string>& words,
                        std::vector<std::string> substitutions);

/// The file that a job writes its picture to.
std::filesystem::path picture_file(const PeerRequest& request, std::string_view name);

// The peers (peer.cpp lists them).
std::optional<std::filesystem::path> find_blender(const std::string& search_path);
PeerResult run_cycles(const PeerRequest& request);
PeerResult run_cycles_random_walk(const PeerRequest& request);
std::optional<std::filesystem::path> find_mitsuba(const std::string& search_path);
PeerResult run_mitsuba(const PeerRequest& request);

}  // namespace nacre
