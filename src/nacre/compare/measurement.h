#pragma once
// One technique at one setting, rendered several times: pictures, times, memory; and its file, so
// that what was measured need not be measured again.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "nacre/compare/technique_setting.h"
#include "nacre/metrics/pictures.h"
#include "nacre/render/render.h"

namespace nacre {

/// What one repeat took, in seconds.
struct Timing {
    double frame = 0, frame_cpu = 0;            ///< rendering
    double precompute = 0, precompute_cpu = 0;  ///< before it
};

struct Measurement {
    std::string id;  ///< TechniqueSetting::id, or the name of a peer
    enum class Status { done, failed, missing } status = Status::missing;
    std::string why;  ///< it failed
    Image frame;      ///< of the first repeat: what one sees for the time of one frame
    Image mean;       ///< over the repeats
    Image variance;   ///< of `mean`, from how the repeats differ: all noise, of precomputation too
    std::vector<Timing> timings;  ///< a repeat each
    double memory_mb = 0;         ///< the most that was held beyond the scene
    Statistics statistics;        ///< of the first repeat
    std::uint64_t invalid_samples = 0;
    // Of another renderer: its version, what was run, and what was replaced for it.
    std::string program, command;
    std::vector<std::string> notes;
    int samples = 0;
    bool reused = false;  ///< read from a file

    int repeats() const { return static_cast<int>(timings.size()); }
    double median_of(double Timing::*what) const;
};

/// Sets `frame`, `mean` and `variance` from the frames, at least two of one size.
void set_pictures(Measurement& m, const std::vector<Image>& frames);

/// Seed of the frame of a repeat.
std::uint64_t frame_seed(std::uint64_t seed, int repeat);

struct MeasurementOptions {
    int repeats = 3;  ///< at least 2: how they differ tells noise from bias
    std::uint64_t seed = 0;
    int threads = 0;
    const std::atomic<bool>* stop = nullptr;
    std::function<void(double share)> progress = {};
};

/// Renders `scene` at a setting. Each repeat has a seed of its own and precomputes anew. What goes
/// wrong makes it `failed`, with the reason; a stop makes it `missing`.
Measurement measure(const Scene& scene, const TechniqueSetting& setting,
                    const MeasurementOptions& options);

/// Channels R, G, B: the mean; variance.*: of one sample, as `variance_of_mean` reads it; frame.*:
/// one frame; and `key` with all numbers in the metadata.
void write_measurement(const Measurement& m, const std::string& key,
                       const std::filesystem::path& file);
/// The measurement that was written under the key; nothing if there is none.
std::optional<Measurement> read_measurement(const std::string& key,
                                            const std::filesystem::path& file);

}  // namespace nacre
