#pragma once
// What `render` and `demo` share: render a scene with a progress bar, save it, say what happened.
#include <filesystem>

#include "apps/cli/film_keeper.h"
#include "apps/cli/finish_picture.h"
#include "apps/cli/verb.h"
#include "nacre/geometry/mesh_pose.h"
#include "nacre/techniques/techniques.h"

namespace nacre::cli {

struct SaveOptions {
    std::filesystem::path output;
    std::string scene_file;
    int threads = 0;
    double timeout_s = 0;
    float exposure = 0.f;
    bool strict = false, quiet = false, json = false;
    FilmOptions film;
    std::optional<MeshPose> pose = {};  ///< of a bare mesh in its file, for the summary
    std::string remark = {};            ///< a line of its own below that of the written picture
    FinishOptions finish = {};
};

/// Returns the exit code: `failure` if the film was to be kept and could not; `interrupted` after Ctrl-C, when what there is was saved as
/// NAME.partial.exr (NAME.partial-2.exr if that exists); `failure` after a timeout before the first
/// sample. Throws InputError for a picture that the memory does not hold. Throws RunError for
/// invalid samples if `strict`, and then writes nothing.
int render_and_save(const Scene& scene, const RenderPlan& plan, const SaveOptions& options,
                    const Invocation& invocation);

}  // namespace nacre::cli
