#include "nacre/compare/measure_peer.h"

#include <fmt/format.h>

#include <algorithm>

#include "nacre/math/error.h"

namespace nacre {
namespace {

Image colors_of(const Image& picture, const Scene& scene) {
    const FilmSettings& film = scene.film;
    const int width = film.crop_width > 0 ? film.crop_width : film.width,
              height = film.crop_width > 0 ? film.crop_height : film.height;
    if (picture.width != width || picture.height != height)
        throw RunError(fmt::format("its picture has {} x {} pixels instead of {} x {}",
                                   picture.width, picture.height, width, height));
    Image image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const Vec3f rgb = picture.rgb(x, y);
            for (int c = 0; c < 3; ++c) image.at(x, y, c) = rgb[c];
        }
    return image;
}

}  // namespace

std::string peer_id(const PeerDescription& peer, int samples) {
    return fmt::format("{} {} spp", peer.name, samples);
}

Measurement measure_peer(const Scene& scene, const PeerDescription& peer, const PeerSource& source,
                         const std::filesystem::path& folder, const MeasurementOptions& options) {
    Measurement m;
    m.id = peer_id(peer, source.samples);
    m.samples = source.samples;
    const auto stopped = [&] { return options.stop && options.stop->load(); };
    std::vector<Image> frames;
    try {
        for (int repeat = 0; repeat < options.repeats; ++repeat) {
            if (stopped()) return m;
            if (options.progress) options.progress(double(repeat) / options.repeats);
            PeerRequest request{.scene = scene,
                                .scene_file = source.scene_file,
                                .defines = source.defines,
                                .samples = source.samples,
                                // What every renderer takes for a seed.
                                .seed = frame_seed(options.seed, repeat) >> 33,
                                .threads = options.threads,
                                .folder = folder,
                                .stop = options.stop};
            const PeerResult r = peer.run(request);
            frames.push_back(colors_of(r.picture, scene));
            m.timings.push_back({r.seconds, 0, std::max(0., r.wall_seconds - r.seconds), 0});
            m.memory_mb = std::max(m.memory_mb, r.peak_mb);
            m.program = r.version;
            m.command = r.command;
            m.notes = r.substitutions;
        }
    } catch (const std::exception& error) {
        if (stopped()) return m;
        m.status = Measurement::Status::failed;
        m.why = error.what();
        return m;
    }
    set_pictures(m, frames);
    m.status = Measurement::Status::done;
    return m;
}

}  // namespace nacre
