#include "apps/cli/slab_mcml.h"

#include <fmt/format.h>

#include <set>

#include "apps/cli/output_file.h"
#include "apps/cli/plot.h"
#include "apps/cli/progress_bar.h"
#include "apps/cli/verb.h"
#include "nacre/layers/mcml_io.h"
#include "nacre/math/error.h"
#include "nacre/text/whole_file.h"

namespace nacre::cli {
namespace {

namespace fs = std::filesystem;

/// One file a run.
std::vector<fs::path> outputs_of(const std::vector<McmlRun>& runs, const McmlJob& job) {
    const std::string extension = job.output.extension().string();
    if (extension == ".mco" || extension == ".csv") {
        if (runs.size() > 1)
            throw InputError(fmt::format("{} holds {} runs: give -o a folder for their files",
                                         job.input.string(), runs.size()));
        check_output_file(job.output);
        refuse_input_as_output(job.output, {job.input});
        return {job.output};
    }
    const fs::path folder = job.output.empty() ? job.input.parent_path() : job.output;
    if (!folder.empty() && !fs::is_directory(folder))
        throw InputError(
            fmt::format("'{}' is no folder, nor a file .mco or .csv", folder.string()));
    std::vector<fs::path> files;
    std::set<fs::path> seen;
    for (const McmlRun& r : runs) {
        files.push_back(folder / fs::path(r.output).filename());
        if (!files.back().has_filename() || files.back() == job.input ||
            fs::is_directory(files.back()))
            throw InputError(
                fmt::format("{}: a run cannot write to '{}'", job.input.string(), r.output));
        check_output_file(files.back());
        refuse_input_as_output(files.back(), {job.input});
        if (!seen.insert(files.back()).second)
            throw InputError(
                fmt::format("{}: two runs write to '{}'", job.input.string(), r.output));
    }
    return files;
}

}  // namespace

int run_mcml(const McmlJob& job) {
    if (job.input.extension() != ".mci")
        throw InputError(
            fmt::format("'{}' is no .mci file; give layers by --layer", job.input.string()));
    std::vector<McmlRun> runs = read_mci(job.input);
    const std::vector<fs::path> files = outputs_of(runs, job);
    for (std::size_t i = 0; i < runs.size(); ++i) {
        McmlRun& run = runs[i];
        if (job.photons) run.photons = *job.photons;
        PhotonProgress progress(job.quiet, "--photons");
        const SlabMonteCarloResult r =
            slab_monte_carlo(run.stack, run.options(job.seed), progress.work());
        write_whole_file(files[i],
                         files[i].extension() == ".csv" ? slab_csv(run.bins, r) : mco_text(run, r));
        const LayerTotals &t = r.totals, &e = r.error;
        fmt::print(
            "{}: R {:.6f} +- {:.1g} (specular {:.6f}), T {:.6f} +- {:.1g}, A {:.6f} +- {:.1g}\n",
            files[i].string(), t.reflectance, e.reflectance, t.specular, t.transmittance,
            e.transmittance, t.absorptance, e.absorptance);
    }
    return success;
}

}  // namespace nacre::cli
