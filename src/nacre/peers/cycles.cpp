// Blender's Cycles: complete simulation of media as volumes, or Blender's own subsurface
// scattering.
#include <fmt/format.h>

#include "nacre/peers/cycles_job.h"
#include "nacre/peers/cycles_scene.h"
#include "nacre/peers/job.h"
#include "nacre/peers/process.h"
#include "nacre/text/whole_file.h"

namespace nacre {
namespace {

void turn_over(Image& image) {
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width / 2; ++x)
            for (int c = 0; c < image.channel_count(); ++c)
                std::swap(image.at(x, y, c), image.at(image.width - 1 - x, y, c));
}

PeerResult run(const PeerRequest& asked, const std::string& name, bool random_walk) {
    const PeerDescription& peer = peers().find(name);
    const auto blender = find_blender(asked.search_path);
    if (!blender) throw_absent("Blender", peer.how_to_install);
    check_comparable(asked.scene, "Blender Cycles");
    PeerRequest request = asked;
    request.folder = std::filesystem::absolute(asked.folder);
    make_output_folder(request.folder);
    Substitutions substitutions;
    const nlohmann::json scene = cycles_scene(
        request, picture_file(request, name).filename().string(), random_walk, substitutions);
    const std::string description = name + ".json";
    const std::filesystem::path job = request.folder / (name + ".py");
    write_whole_file(request.folder / description, scene.dump(1));
    write_whole_file(job, cycles_job());
    PeerResult result = run_peer_job(
        request, name,
        {blender->string(), "-b", "--factory-startup", "-P", job.string(), "--", description},
        std::move(substitutions.sentences));
    if (view_of(*request.scene.camera).mirrored) turn_over(result.picture);
    return result;
}

}  // namespace

std::optional<std::filesystem::path> find_blender(const std::string& search_path) {
    const auto found = find_programs("blender", search_path);
    return found.empty() ? std::nullopt : std::optional(found.front());
}

PeerResult run_cycles(const PeerRequest& request) { return run(request, "cycles", false); }

PeerResult run_cycles_random_walk(const PeerRequest& request) {
    return run(request, "cycles_random_walk", true);
}

}  // namespace nacre
