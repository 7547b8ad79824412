#include "nacre/render/output.h"

namespace nacre {
namespace {

std::string describe(const InvalidSample& s) {
    return fmt::format("pixel ({}, {}), sample {}: ({}, {}, {})", s.x, s.y, s.sample, s.value.x,
                       s.value.y, s.value.z);
}

const char* unit(FilmQuantity quantity) {
    switch (quantity) {
        case FilmQuantity::luminance:
            return "luminance, cd/m^2";
        case FilmQuantity::illuminance:
            return "illuminance, lx";
        case FilmQuantity::radiance:
            break;
    }
    return "radiance";
}

void add_metadata(Image& image, const RenderResult& result, const Scene& scene,
                  const RenderOrigin& origin) {
    const auto put = [&](const char* key, std::string value) {
        if (!value.empty()) image.metadata[fmt::format("nacre.{}", key)] = std::move(value);
    };
    put("command", origin.command_line);
    put("version", origin.version);
    put("scene", origin.scene_file);
    put("mode", scene.mode == ColorMode::spectral ? "spectral" : "rgb");
    put("quantity", unit(result.film.settings().quantity));
    put("integrator", result.integrator);
    put("sampler", result.sampler.type);
    put("seed", fmt::to_string(result.sampler.seed));
    put("samples", fmt::to_string(result.sampler.samples));
    if (result.noise) put("noise", fmt::format("{:.6g}", *result.noise));
    put("complete", result.complete ? "yes" : "no");
    const FilmSettings& f = result.film.settings();
    if (f.crop_width != f.width || f.crop_height != f.height)
        put("crop", fmt::format("{},{},{},{} of {}x{}", f.crop_x, f.crop_y, f.crop_width,
                                f.crop_height, f.width, f.height));
    put("seconds", fmt::format("{:.3f}", result.seconds));
    put("cpu_seconds", fmt::format("{:.3f}", result.cpu_seconds));
    put("precompute_seconds", fmt::format("{:.3f}", result.precompute_seconds));
    put("rays", fmt::to_string(result.counts.rays));
    put("scatterings", fmt::to_string(result.counts.scatterings));
    put("invalid", fmt::to_string(result.film.invalid_count()));
    std::string invalid;
    for (const InvalidSample& s : result.film.invalid_samples())
        invalid += (invalid.empty() ? "" : "; ") + describe(s);
    put("invalid_samples", invalid);
}

}  // namespace

Image render_image(const RenderResult& result, const Scene& scene, const RenderOrigin& origin) {
    const Film& film = result.film;
    const bool color = film.settings().quantity == FilmQuantity::radiance;
    std::vector<std::string> names =
        color ? std::vector<std::string>{"R", "G", "B"} : std::vector<std::string>{"Y"};
    const std::size_t n = names.size();
    if (scene.integrator.moment)
        for (std::size_t c = 0; c < n; ++c) names.push_back("variance." + names[c]);
    Image image(film.width(), film.height(), names);
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x) {
            const Vec3f mean = film.mean(x, y);
            for (std::size_t c = 0; c < n; ++c) image.at(x, y, static_cast<int>(c)) = mean[c];
            if (!scene.integrator.moment) continue;
            const Vec3f variance = film.sample_variance(x, y);
            for (std::size_t c = 0; c < n; ++c)
                image.at(x, y, static_cast<int>(n + c)) = variance[c];
        }
    add_metadata(image, result, scene, origin);
    return image;
}

void save_render(const RenderResult& result, const Scene& scene, const std::filesystem::path& file,
                 const RenderOrigin& origin, float exposure) {
    write_image(render_image(result, scene, origin), file, exposure);
}

std::filesystem::path partial_path(const std::filesystem::path& file) {
    std::filesystem::path r = file;
    return r.replace_extension(".partial.exr");
}

std::string describe_invalid(const Film& film) {
    const std::uint64_t count = film.invalid_count();
    if (count == 0) return {};
    return fmt::format("{} invalid sample{} (not finite or negative), the first at {}", count,
                       count == 1 ? "" : "s", describe(film.invalid_samples().front()));
}

}  // namespace nacre
