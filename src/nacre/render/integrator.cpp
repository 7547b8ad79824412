#include "nacre/render/integrator.h"

#include <fmt/format.h>

#include "nacre/math/error.h"
#include "nacre/render/legacy.h"
#include "nacre/render/path_tracer.h"
#include "nacre/render/volume_path_tracer.h"
#include "nacre/text/names.h"

namespace nacre {

std::unique_ptr<Integrator> make_integrator(const Scene& scene, const Work& work) {
    return make_integrator(scene, scene.integrator.type, work);
}

std::unique_ptr<Integrator> make_integrator(const Scene& scene, std::string_view type,
                                            const Work& work) {
    if (type == "ray") return std::make_unique<PathTracer>(scene, true);
    if (type == "path") return std::make_unique<PathTracer>(scene, false);
    if (type == "volpath") return std::make_unique<VolumePathTracer>(scene, work);
    if (type == "legacy") return std::make_unique<LegacyShading>(scene);
    throw InputError(unknown_name("integrator", type, integrator_types()));
}

std::span<const std::string_view> integrator_types() {
    static constexpr std::string_view types[] = {"ray", "path", "volpath", "legacy"};
    return types;
}

}  // namespace nacre
