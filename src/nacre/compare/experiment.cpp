#include "nacre/compare/experiment.h"

#include <fmt/format.h>

#include <algorithm>

#include "nacre/math/error.h"
#include "nacre/scene/content_key.h"
#include "nacre/scene/subsurface.h"
#include "nacre/text/whole_file.h"

namespace nacre {
namespace {

/// What a part is known by: everything that its pictures and times depend on, but the machine.
std::string key_of(const std::string& scene_key, const Scene& scene, const std::string& id,
                   const ExperimentOptions& o) {
    return fmt::format("{} {} sampler {} repeats {} seed {} threads {} build {}", scene_key, id,
                       scene.sampler.type, o.repeats, o.seed, o.threads, o.build);
}

std::filesystem::path file_of(const ExperimentOptions& o, std::string id) {
    if (o.folder.empty()) return {};
    std::ranges::replace(id, '/', '_');
    std::ranges::replace(id, ' ', '_');
    return o.folder / (id + ".exr");
}

Measurement measure_row(const ExperimentRow& row, const Scene& scene, const ExperimentOptions& o,
                        const std::function<void(double)>& progress) {
    const MeasurementOptions options{.repeats = o.repeats,
                                     .seed = o.seed,
                                     .threads = o.threads,
                                     .stop = o.stop,
                                     .progress = progress};
    if (row.peer) {
        const std::filesystem::path jobs =
            o.folder.empty() ? std::filesystem::temp_directory_path() / "nacre_peer" : o.folder;
        return measure_peer(scene, *row.peer, o.peer_source, jobs / std::string(row.peer->name),
                            options);
    }
    const bool simulates = techniques().find(row.setting.choice.technique).simulates;
    return measure(o.simplified && !simulates ? *o.simplified : scene, row.setting, options);
}

}  // namespace

bool Experiment::any_failed() const {
    return std::ranges::any_of(rows, [](const ExperimentRow& r) {
        return r.measurement.status == Measurement::Status::failed;
    });
}

PixelMask translucent_pixels(const Scene& scene, bool& object_only) {
    const FilmSettings& film = scene.film;
    const int width = film.crop_width > 0 ? film.crop_width : film.width,
              height = film.crop_width > 0 ? film.crop_height : film.height;
    bool any = false;
    const auto shows = [&](double x, double y) {
        const Ray ray = scene.camera->ray(
            {float((film.crop_x + x) / film.width), float((film.crop_y + y) / film.height)},
            {0.5f, 0.5f});
        const auto hit = scene.rays.intersect(ray);
        if (!hit) return false;
        const ShapeBinding& shape = scene.shapes[hit->shape];
        return shape.interior != nullptr || shape.subsurface != nullptr;
    };
    // Corners and middle: what lies at the edge of the object is mixed with what is behind.
    constexpr double places[][2] = {
        {0.5, 0.5}, {0.02, 0.02}, {0.98, 0.02}, {0.02, 0.98}, {0.98, 0.98}};
    const PixelMask mask(width, height, [&](int x, int y) {
        const bool inside = std::ranges::all_of(
            places, [&](const double(&at)[2]) { return shows(x + at[0], y + at[1]); });
        any |= inside;
        return inside;
    });
    object_only = any;
    return any ? mask : PixelMask();
}

Experiment run_experiment(const Scene& scene, const ExperimentOptions& o) {
    if (!o.folder.empty()) make_output_folder(o.folder);
    Experiment e;
    e.mask = translucent_pixels(scene, e.object_only);
    const int parts = int(o.settings.size() + o.peers.size()) + 1;
    const auto report = [&](const std::string& what, int part, double share,
                            std::string note = "") {
        if (o.progress) o.progress({what, part, parts, share, std::move(note)});
    };

    ReferenceOptions reference = o.reference;
    reference.stop = o.stop;
    reference.threads = o.threads;
    reference.block = o.block;
    reference.warn = o.warn;
    reference.progress = [&](double share, double error) {
        report("reference", 1, share, error > 0 ? fmt::format("noise {:.2f} %", 100 * error) : "");
    };
    e.reference = make_reference(scene, e.mask, reference);
    for (const TechniqueSetting& setting : o.settings) {
        e.rows.emplace_back().setting = setting;
        e.rows.back().measurement.id = setting.id();
    }
    for (const PeerDescription* peer : o.peers) {
        e.rows.emplace_back().peer = peer;
        e.rows.back().measurement.id = peer_id(*peer, o.peer_source.samples);
    }
    if (!e.reference.reached) return e;

    const std::string scene_key = content_key(scene);
    for (int i = 0; i < int(e.rows.size()); ++i) {
        ExperimentRow& row = e.rows[i];
        const std::string id = row.measurement.id;
        const std::string key = key_of(scene_key, scene, id, o);
        const std::filesystem::path file = file_of(o, id);
        report(id, i + 2, 0);
        std::optional<Measurement> kept;
        if (!o.fresh && !file.empty()) kept = read_measurement(key, file);
        if (kept) {
            row.measurement = std::move(*kept);
            report(id, i + 2, 1, "kept from before");
        } else {
            row.measurement =
                measure_row(row, scene, o, [&](double share) { report(id, i + 2, share); });
            if (row.measurement.status == Measurement::Status::missing) return e;
        }
        if (row.measurement.status != Measurement::Status::done) continue;
        if (!file.empty() && !row.measurement.reused) write_measurement(row.measurement, key, file);
        try {
            row.verdict =
                judge(row.measurement, e.reference.picture, e.reference.variance, e.mask, o.block);
        } catch (const InputError& error) {  // values that are not finite
            row.measurement.status = Measurement::Status::failed;
            row.measurement.why = error.what();
        }
    }
    e.complete = true;
    return e;
}

}  // namespace nacre
