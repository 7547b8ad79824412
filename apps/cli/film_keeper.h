#pragma once
// A render that can go on: its film is kept beside the picture, as its state, while it is rendered
// and when it ends, however it ends.
#include <filesystem>
#include <optional>
#include <string>

#include "nacre/techniques/render_state.h"

namespace CLI {
class App;
}

namespace nacre::cli {

/// What the command line says of it.
struct FilmOptions {
    double checkpoint_s = 0;     ///< how often the state is kept; 0: only at the end
    bool keep = false;           ///< the state is kept at the end
    bool resume = false;         ///< go on from a state
    std::string resume_from;     ///< from this one; empty: from that beside the picture
    double noise = 0;            ///< render until the picture has no more; 0: all samples
    bool samples_given = false;  ///< with `noise`: no more than those of the scene

    bool keeps() const { return keep || resume || checkpoint_s > 0; }
};

/// Declares --checkpoint, --resume, --film-state and --noise.
void add_film_options(CLI::App& app, FilmOptions& options);

/// NAME.film.exr beside NAME.*; that itself if it is one.
std::filesystem::path film_path(const std::filesystem::path& picture);
bool is_film_path(const std::filesystem::path& file);

class FilmKeeper {
  public:
    /// Takes up the state that is asked for. Throws InputError for one that is missing (unless
    /// there is a --checkpoint: then it is said, and the render begins anew), damaged, or of
    /// another picture, and says what differs.
    FilmKeeper(const FilmOptions& options, const std::filesystem::path& picture, const Scene& scene,
               const RenderPlan& plan);

    /// Has the render go on from the state, end at the noise and keep what there is in between: a
    /// state that cannot be written is told once, and the render goes on. This outlives the render.
    void ask(RenderOptions& options);
    /// The time that went into what was taken up.
    double seconds_before() const { return begun_ ? begun_->seconds : 0; }
    /// Adds times and counts of what was taken up, and keeps the film. Returns false, and says why,
    /// if that could not be written.
    bool finish(RenderResult& result, bool quiet);

  private:
    void take_up(const std::filesystem::path& file);
    void save(const Film& film, bool complete, double seconds, double cpu_seconds,
              RayCounts counts) const;

    const FilmOptions options_;
    const std::filesystem::path file_;
    const SamplerSettings sampler_;
    RenderState about_;  ///< of what is kept; its film is empty
    std::optional<RenderState> begun_;
    bool told_ = false;
};

}  // namespace nacre::cli
