#pragma once
// Rendered pictures as files, with what is needed to make them again.
#include <filesystem>
#include <string>

#include "nacre/image/image.h"
#include "nacre/render/render.h"

namespace nacre {

/// What the library does not know about how a picture came about; empty fields are left out.
struct RenderOrigin {
    std::string command_line, version, scene_file;
};

/// Channels R, G, B (for luminance and illuminance: Y), then, if scene.integrator.moment, the
/// variance of one sample as variance.R, ...; metadata under "nacre.*":
///
///   command, version, scene, mode (rgb, spectral), quantity (radiance, cd/m^2, lx), integrator,
///   sampler, seed, samples (a pixel, as asked for), noise (where it was asked for; noise.h), complete (yes, no), crop, seconds,
///   cpu_seconds, precompute_seconds, rays, scatterings, invalid (a count), invalid_samples ("x,y
///   sample: r g b", separated by semicolons)
Image render_image(const RenderResult& result, const Scene& scene, const RenderOrigin& origin);

/// Writes `render_image` by extension (write_image).
void save_render(const RenderResult& result, const Scene& scene, const std::filesystem::path& file,
                 const RenderOrigin& origin, float exposure = 0.f);

/// Where an interrupted render is saved: NAME.partial.exr beside NAME.*.
std::filesystem::path partial_path(const std::filesystem::path& file);

/// "3 invalid samples (not finite or negative), the first at pixel (4, 7), sample 2: (nan, 0, 1)";
/// empty if there are none.
std::string describe_invalid(const Film& film);

}  // namespace nacre
