#pragma once
// The experiment: a scene, its reference, and every technique at every setting.
#include "nacre/compare/measure_peer.h"
#include "nacre/compare/measurement.h"
#include "nacre/compare/reference.h"
#include "nacre/compare/verdict.h"

namespace nacre {

struct ExperimentProgress {
    std::string what;  ///< "reference", or the id of a setting
    int part = 0, parts = 0;
    double share = 0;  ///< of that part, [0, 1]
    std::string note;  ///< "noise 0.8 %", "kept from before"
};

struct ExperimentOptions {
    std::vector<TechniqueSetting> settings;
    std::vector<const PeerDescription*> peers;  ///< other renderers, after the techniques
    PeerSource peer_source;
    ReferenceOptions reference;  ///< stop, threads and progress are taken from here
    int repeats = 3;
    std::uint64_t seed = 0;
    int threads = 0;
    int block = 16;
    std::filesystem::path folder;  ///< finished pictures are kept there, and reused
    std::string build;             ///< of the program: what another build measured is not reused
    bool fresh = false;            ///< measure everything anew
    /// What techniques other than complete simulation render instead of the scene, if they cannot
    /// take it; null: the scene.
    const Scene* simplified = nullptr;
    const std::atomic<bool>* stop = nullptr;
    std::function<void(const ExperimentProgress&)> progress = {};
    std::function<void(const std::string& message)> warn = {};  ///< what does not end the work
};

struct ExperimentRow {
    TechniqueSetting setting;               ///< of a technique
    const PeerDescription* peer = nullptr;  ///< or another renderer
    Measurement measurement;
    std::optional<Verdict> verdict;  ///< if it is done
};

struct Experiment {
    Reference reference;
    PixelMask mask;            ///< pixels that count
    bool object_only = false;  ///< only translucent objects count, else the whole picture
    std::vector<ExperimentRow> rows;
    bool complete = false;  ///< false: stopped

    bool any_failed() const;
};

/// Pixels all of which show a translucent object; all pixels if there is no such object, and then
/// `object_only` is false.
PixelMask translucent_pixels(const Scene& scene, bool& object_only);

/// Runs it. Throws InputError for a wrong reference, and if
/// the object is too small in the picture to be measured.
Experiment run_experiment(const Scene& scene, const ExperimentOptions& options);

}  // namespace nacre
