// Frames in real time, pass by pass, on the device at hand (its name is in the context; software is
// never a GPU's speed): two meshes, two sizes, one point light.
//
//   ./dev bench --benchmark_filter=frame
//
// `ms` of a pass are medians over the frames; "plain" is what a shadowed Lambert frame takes with
// visibility by the raster unit: both views, the surface and the light, without any technique.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "nacre/geometry/figure.h"
#include "nacre/realtime/frame_renderer.h"
#include "nacre/scene/load.h"
#include "nacre/techniques/techniques.h"

namespace {

using namespace nacre;

struct Bench {
    HeadlessContext context;
    std::unique_ptr<HeadlessContext::Use> use = std::make_unique<HeadlessContext::Use>(context);
    Gpu gpu;
    std::map<std::string, std::unique_ptr<Scene>> scenes;

    const Scene& scene(const std::string& name) {
        auto& s = scenes[name];
        if (!s) {
            MeshSceneOptions options{.material = "marble"};
            options.stage.lights = {parse_stage_light("point position=-200,300,300")};
            options.stage.floor = false;
            const std::filesystem::path bunny = NACRE_SHARED_DIR "/bench/bunny_watertight.obj";
            s = std::make_unique<Scene>(
                name == "bunny"
                    ? load_mesh_scene(bunny, options)
                    // Some 200,000 triangles, as the paper's second head.
                    : make_mesh_scene(std::make_shared<Mesh>(make_figure(2.2f)), options));
        }
        return *s;
    }
};

Bench& bench() {
    static Bench b;
    return b;
}

/// A technique that adds nothing.
class Nothing final : public RealtimeTechnique {};
const TechniqueDescription plain{
    .name = "plain",
    .title = "a shadowed Lambert frame",
    .authors = "",
    .paper = "",
    .how = "adds nothing",
    .realtime = [](const RealtimeInput&) -> std::unique_ptr<RealtimeTechnique> {
        return std::make_unique<Nothing>();
    }};

void frames(benchmark::State& state, const std::string& mesh, int size,
            const std::string& technique) {
    Bench& b = bench();
    const Scene& scene = b.scene(mesh);
    std::vector<ShapeTechnique> shapes(scene.shapes.size());
    if (technique == "plain")
        for (std::size_t i = 0; i < shapes.size(); ++i) {
            if (scene.shapes[i].interior) shapes[i].technique = &plain;
        }
    else
        shapes = plan_of(scene, {technique}).shapes;
    FrameRenderer renderer(b.gpu, scene, shapes);
    if (technique == "plain") renderer.set_visibility(VisibilityMethod::raster);
    FilmSettings film = scene.film;
    film.width = film.height = size;
    film.crop_width = 0;
    const View view = camera_view(*scene.camera, film, {0.f, 0.f}, renderer.scene().bounds());
    renderer.render(view);
    b.gpu.finish();
    std::map<std::string, std::vector<double>> passes;
    for (auto _ : state) {
        renderer.render(view);
        b.gpu.finish();
    }
    for (int i = 0; i < 9; ++i) {
        b.gpu.begin_timing();
        renderer.render(view);
        for (const PassTime& p : b.gpu.end_timing()) passes[p.name].push_back(p.ms);
    }
    double sum = 0;
    for (auto& [name, ms] : passes) {
        std::ranges::nth_element(ms, ms.begin() + 4);
        state.counters["ms " + name] = ms[4];
        sum += ms[4];
    }
    state.counters["ms all passes"] = sum;
    state.counters["MB"] = double(renderer.bytes()) * 1e-6;
    state.counters["triangles"] = double(renderer.scene().triangles());
}

}  // namespace

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    benchmark::AddCustomContext("device", bench().gpu.device().text());
    std::vector<std::string> meshes{"bust"};
    if (std::filesystem::exists(NACRE_SHARED_DIR "/bench/bunny_watertight.obj"))
        meshes.insert(meshes.begin(), "bunny");
    for (const std::string& mesh : meshes)
        for (const int size : {512, 1024}) {
            std::vector<std::string> list{"plain"};
            for (const TechniqueDescription* t : techniques())
                if (t->realtime) list.emplace_back(t->name);
            for (const std::string& technique : list)
                benchmark::RegisterBenchmark(
                    ("frame/" + mesh + "/" + std::to_string(size) + "/" + technique).c_str(),
                    [=](benchmark::State& s) { frames(s, mesh, size, technique); })
                    ->Unit(benchmark::kMillisecond)
                    ->UseRealTime()
                    ->MinTime(0.3);
        }
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
}
