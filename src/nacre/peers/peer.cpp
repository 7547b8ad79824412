#include "nacre/peers/peer.h"

#include <cstdlib>

#include "nacre/math/error.h"
#include "nacre/peers/job.h"
#include "nacre/peers/process.h"

namespace nacre {
namespace {

constexpr PeerDescription listed[] = {
    {.name = "cycles",
     .title = "Blender Cycles",
     .how_to_install = "apt-get install blender",
     .find = find_blender,
     .run = run_cycles},
    {.name = "cycles_random_walk",
     .title = "Blender Cycles with its subsurface scattering",
     .how_to_install = "apt-get install blender",
     .find = find_blender,
     .run = run_cycles_random_walk},
    {.name = "mitsuba",
     .title = "Mitsuba 3",
     .how_to_install = "pip install mitsuba",
     .find = find_mitsuba,
     .run = run_mitsuba},
};

}  // namespace

const Catalogue<PeerDescription>& peers() {
    static const Catalogue<PeerDescription> all("peer", listed);
    return all;
}

void Substitutions::add(std::string sentence) {
    if (std::find(sentences.begin(), sentences.end(), sentence) == sentences.end())
        sentences.push_back(std::move(sentence));
}

void throw_absent(std::string_view title, std::string_view how_to_install) {
    throw InputError(
        fmt::format("{} is not installed; install it with: {}", title, how_to_install));
}

void check_comparable(const Scene& scene, std::string_view title) {
    if (scene.integrator.legacy || scene.integrator.type == "legacy")
        throw InputError(
            fmt::format("{} has no illumination models from before the BRDF; compare scenes of "
                        "integrator path or volpath",
                        title));
    if (scene.film.quantity != FilmQuantity::radiance)
        throw InputError(fmt::format(
            "{} renders radiance only; leave 'quantity' of the film out of the scene", title));
}

std::filesystem::path picture_file(const PeerRequest& request, std::string_view name) {
    return request.folder / fmt::format("{}.exr", name);
}

PeerResult run_peer_job(const PeerRequest& request, std::string_view name,
                        const std::vector<std::string>& words,
                        std::vector<std::string> substitutions) {
    constexpr int shown = 5;  // lines of the log: enough for an exception's last frame
    const std::filesystem::path log = request.folder / fmt::format("{}.log", name),
                                picture = picture_file(request, name);
    std::filesystem::remove(picture);  // lest an older one be taken for this
    const ProcessResult process = run_process(words, log, request.stop);
    if (process.stopped) throw RunError(fmt::format("{} was stopped", name));
    if (process.status != 0 || !std::filesystem::exists(picture))
        throw RunError(fmt::format("{} failed with exit status {}; the end of {}:\n{}", name,
                                   process.status, log.string(), last_lines(log, shown)));
    PeerResult result;
    result.picture = read_image(picture);
    const std::string seconds = log_value(log, "seconds");
    result.seconds = seconds.empty() ? process.seconds : std::strtod(seconds.c_str(), nullptr);
    result.wall_seconds = process.seconds;
    result.peak_mb = process.peak_mb;
    result.version = log_value(log, "version");
    result.command = command_line(words);
    result.substitutions = std::move(substitutions);
    return result;
}

}  // namespace nacre
