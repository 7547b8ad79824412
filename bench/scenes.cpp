// The benchmark scenes on one thread: what part of the time is ray queries, and how many scattering
// events a second the complete simulation makes with its accelerations on and off. Needs
// ../shared/bench; says so where it is absent.
#include <benchmark/benchmark.h>

#include <filesystem>

#include "nacre/render/integrator.h"
#include "nacre/scene/load.h"

namespace nacre {
namespace {

const std::filesystem::path folder = std::filesystem::path(NACRE_SHARED_DIR) / "bench";

// Every n-th pixel in both directions: a picture in small, whose rays are spread as the whole
// picture's.
constexpr int stride = 8;

template <class Visit>
void for_each_camera_ray(const Scene& scene, const Visit& visit) {
    Sampler sampler(Sampler::Kind::independent, 0, 1);
    for (int y = 0; y < scene.film.height; y += stride)
        for (int x = 0; x < scene.film.width; x += stride) {
            sampler.start(std::uint64_t(y) * std::uint64_t(scene.film.width) + std::uint64_t(x), 0);
            const Vec2f jitter = sampler.next2d();
            visit(scene.camera->ray({(float(x) + jitter.x) / float(scene.film.width),
                                     (float(y) + jitter.y) / float(scene.film.height)},
                                    {0.5f, 0.5f}),
                  sampler);
        }
}

struct Query {
    Ray ray;
    bool shadow;
};

// The rays of path tracing with one light sample a vertex: camera, shadow and bounce rays, as
// PathTracer makes them.
std::vector<Query> record_rays(const Scene& scene) {
    std::vector<Query> queries;
    const Wavelengths wavelengths = Wavelengths::rgb_bands();
    for_each_camera_ray(scene, [&](Ray ray, Sampler& sampler) {
        for (int depth = 0; depth < scene.integrator.max_depth; ++depth) {
            queries.push_back({ray, false});
            const auto hit = scene.rays.intersect(ray);
            if (!hit) return;
            const SurfacePoint at = scene.rays.surface_point(ray, *hit);
            const auto& light =
                scene.lights[std::size_t(sampler.next1d() * float(scene.lights.size()))];
            const LightSample to = light->sample(at.p, sampler.next2d(), wavelengths);
            if (to.pdf > 0.f && dot(to.wi, at.shading.n) > 0.f)
                queries.push_back({{at.spawn(to.wi), to.wi, 0.f, to.distance * 0.9999f}, true});
            const Vec3f wo = at.shading.to_local(-ray.d);
            BsdfScratch scratch;
            const Bsdf& bsdf = scene.shapes[hit->shape].material->at(at, wavelengths, scratch);
            const auto sample = bsdf.sample(wo, sampler.next1d(), sampler.next2d());
            if (!sample) return;
            const Vec3f d = at.shading.to_world(sample->wi);
            ray = {at.spawn(d), d};
        }
    });
    return queries;
}

bool there(benchmark::State& state) {
    if (std::filesystem::exists(folder / "bunny_watertight.obj")) return true;
    state.SkipWithError(("no benchmark scenes in " + folder.string()).c_str());
    return false;
}

void trace(benchmark::State& state, const Scene& scene) {
    const auto integrator = make_integrator(scene);
    RayCounts counts;
    for (auto _ : state)
        for_each_camera_ray(scene, [&](const Ray& ray, Sampler& sampler) {
            benchmark::DoNotOptimize(
                integrator->radiance(ray, sampler, Wavelengths::rgb_bands(), counts));
        });
    state.counters["rays"] = benchmark::Counter(double(counts.rays), benchmark::Counter::kIsRate);
    state.counters["events"] =
        benchmark::Counter(double(counts.scatterings), benchmark::Counter::kIsRate);
}

void DiffuseRayQueriesAlone(benchmark::State& state) {
    if (!there(state)) return;
    const Scene scene = load_scene(folder / "diffuse_bunny.xml");
    const std::vector<Query> queries = record_rays(scene);
    for (auto _ : state)
        for (const Query& query : queries)
            if (query.shadow)
                benchmark::DoNotOptimize(scene.rays.occluded(query.ray));
            else
                benchmark::DoNotOptimize(scene.rays.intersect(query.ray));
    state.counters["rays"] =
        benchmark::Counter(double(queries.size()), benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(DiffuseRayQueriesAlone)->Unit(benchmark::kMillisecond);

void DiffusePathTracing(benchmark::State& state) {
    if (there(state)) trace(state, load_scene(folder / "diffuse_bunny.xml"));
}
BENCHMARK(DiffusePathTracing)->Unit(benchmark::kMillisecond);

// Arguments: distance grid, guided exits.
void MarbleSimulation(benchmark::State& state) {
    if (!there(state)) return;
    Scene scene = load_scene(folder / "marble_bunny.xml");
    scene.integrator.distance_grid = state.range(0);
    scene.integrator.guided_exits = state.range(1);
    trace(state, scene);
}
BENCHMARK(MarbleSimulation)
    ->ArgNames({"grid", "guide"})
    ->Args({0, 0})
    ->Args({1, 0})
    ->Args({1, 1})
    ->Unit(benchmark::kMillisecond)
    ->MinTime(2);

}  // namespace
}  // namespace nacre
