#include "nacre/technique/integrator_technique.h"

#include "nacre/render/volume_path_tracer.h"

namespace nacre {

RenderResult IntegratorTechnique::render(const FrameSettings& frame, const RenderOptions& options) {
    RenderResult result = nacre::render(scene_, *integrator_, frame, options);
    result.integrator = name_;
    result.statistics = statistics();
    return result;
}

void IntegratorTechnique::changed(const Changes& what, const Work& work) {
    if (what.within({.view = true})) return;
    integrator_ = make_(scene_, work);
}

const TechniqueDescription& simulation_technique() {
    static const TechniqueDescription description{
        .name = "volpath",
        .title = "complete simulation",
        .authors = "J. T. Kajiya, B. P. Von Herzen",
        .year = 1984,
        .paper = "Ray Tracing Volume Densities, SIGGRAPH 84",
        .how = "paths through the medium, without approximation: the reference",
        .precomputes = "distance grid and exit guide",
        .keeps = {.view = true},
        .simulates = true,
        .prepare = [](const TechniqueInput& input, const Work& work) -> TechniquePtr {
            return std::make_unique<IntegratorTechnique>(
                input.scene, "volpath",
                [](const Scene& scene, const Work& w) {
                    return std::make_unique<VolumePathTracer>(scene, w);
                },
                work);
        }};
    return description;
}

}  // namespace nacre
