// Mitsuba 3, through its Python module: the same on every system, and it times the render alone.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "nacre/math/error.h"
#include "nacre/peers/job.h"
#include "nacre/peers/process.h"
#include "nacre/peers/xml.h"
#include "nacre/text/whole_file.h"

namespace nacre {
namespace {

constexpr std::string_view job =
    R"PYTHON("""Renders with Mitsuba 3 what mitsuba.json beside this file describes."""
import json
import os
import time

import drjit
import mitsuba

FOLDER = os.path.dirname(os.path.abspath(__file__))
with open(os.path.join(FOLDER, "mitsuba.json"), encoding="utf-8") as file:
    job = json.load(file)
mitsuba.set_variant(job["variant"])
if job["threads"]:
    drjit.set_thread_count(job["threads"])
scene = mitsuba.load_file(job["scene"], **job["defines"])
start = time.monotonic()
picture = mitsuba.render(scene, spp=job["samples"], seed=job["seed"])
seconds = time.monotonic() - start
picture = mitsuba.Bitmap(picture).convert(mitsuba.Bitmap.PixelFormat.RGB, mitsuba.Struct.Type.Float32, False)
picture.write(os.path.join(FOLDER, job["output"]))
print(f"nacre: version {mitsuba.__version__} {job['variant']}")
print(f"nacre: samples {job['samples']} seed {job['seed']}")
print(f"nacre: seconds {seconds:.3f}", flush=True)
)PYTHON";

}  // namespace

std::optional<std::filesystem::path> find_mitsuba(const std::string& search_path) {
    // The program of that name stands beside the Python that has the module.
    std::vector<std::filesystem::path> candidates;
    for (const std::filesystem::path& program : find_programs("mitsuba", search_path))
        for (const auto& python : find_programs("python3", program.parent_path().string()))
            candidates.push_back(python);
    for (const auto& python : find_programs("python3", search_path)) candidates.push_back(python);
    for (const auto& python : candidates)
        if (run_process({python.string(), "-c", "import mitsuba"}, "/dev/null").status == 0)
            return python;
    return std::nullopt;
}

PeerResult run_mitsuba(const PeerRequest& asked) {
    const auto python = find_mitsuba(asked.search_path);
    if (!python) throw_absent("Mitsuba 3", peers().find("mitsuba").how_to_install);
    check_comparable(asked.scene, "Mitsuba 3");
    PeerRequest request = asked;
    request.folder = std::filesystem::absolute(asked.folder);
    make_output_folder(request.folder);
    Substitutions substitutions;
    const MitsubaScene scene = mitsuba_scene(request, substitutions);
    const std::filesystem::path written = request.folder / "mitsuba.xml",
                                script = request.folder / "mitsuba_job.py";
    if (!scene.same_as_file) write_whole_file(written, scene.xml);
    // The variants without just-in-time compilation: they need nothing but themselves.
    const char* variant =
        request.scene.mode == ColorMode::spectral ? "scalar_spectral" : "scalar_rgb";
    nlohmann::json description = {
        {"variant", variant},
        {"scene", scene.same_as_file ? std::filesystem::absolute(request.scene_file).string()
                                     : written.string()},
        {"defines", nlohmann::json::object()},
        {"samples", request.samples},
        {"seed", request.seed & 0xffffffffu},
        {"threads", request.threads},
        {"output", picture_file(request, "mitsuba").filename().string()}};
    if (scene.same_as_file)
        for (const auto& [name, value] : request.defines) description["defines"][name] = value;
    write_whole_file(request.folder / "mitsuba.json", description.dump(1));
    write_whole_file(script, job);
    return run_peer_job(request, "mitsuba", {python->string(), script.string()},
                        std::move(substitutions.sentences));
}

}  // namespace nacre
