#include "nacre/render/auxiliary.h"

#include <tbb/parallel_for.h>

#include "nacre/math/error.h"
#include "nacre/render/auxiliary_path.h"
#include "nacre/render/filter.h"

namespace nacre {
namespace {

/// Beyond these, edges and lenses are smooth enough to be features of a filter.
constexpr int most_samples = 16;

void sample_pixel(const Scene& scene, const FrameSettings& frame, const Filter& filter,
                  Sampler& sampler, int x, int y, AuxiliaryImages& images) {
    const FilmSettings& film = images.albedo.settings();
    const int full_x = x + film.crop_x, full_y = y + film.crop_y;
    const FilterWindow window = filter_window(film, full_x, full_y);
    for (int i = 0; i < images.samples; ++i) {
        const auto s = static_cast<std::uint32_t>(i);
        // The same first numbers as of the picture's sample (RenderJob): the same place and lens.
        sampler.start(std::uint64_t(full_y) * film.width + full_x, s);
        const FilterSample position = filter.sample(sampler.next2d(), window);
        const Vec2f lens = sampler.next2d();
        const Ray ray = frame.camera->ray({(full_x + 0.5f + position.offset.x) / film.width,
                                           (full_y + 0.5f + position.offset.y) / film.height},
                                          lens);
        const FirstSight seen = AuxiliaryPath(scene, sampler).trace(ray);
        images.albedo.add(x, y, s, seen.albedo, position.weight);
        images.normal.add(x, y, s, seen.normal, position.weight, true);
        if (seen.depth)
            images.depth.add(x, y, s, {*seen.depth, *seen.depth, *seen.depth}, position.weight);
    }
}

}  // namespace

AuxiliaryImages render_auxiliary(const Scene& scene, const FrameSettings& frame, const Work& work) {
    if (!frame.camera) throw InputError("the scene has no camera; add a <sensor>");
    AuxiliaryImages images{Film(frame.film), Film(frame.film), Film(frame.film),
                           std::clamp(frame.sampler.samples, 1, most_samples)};
    const Filter filter(frame.film.filter);
    const Sampler prototype(Sampler::kind_from_name(frame.sampler.type), frame.sampler.seed,
                            frame.sampler.samples);
    const int width = images.albedo.width(), height = images.albedo.height();
    WorkPhase phase(work, "auxiliary images", std::uint64_t(height));
    tbb::parallel_for(0, height, [&](int y) {
        Sampler sampler = prototype;
        for (int x = 0; x < width; ++x) sample_pixel(scene, frame, filter, sampler, x, y, images);
        phase.advance();
    });
    return images;
}

void add_auxiliary_channels(Image& picture, const AuxiliaryImages& auxiliary) {
    struct Layer {
        const Film& film;
        std::vector<std::string> names;
    };
    const Layer layers[] = {{auxiliary.albedo, {"albedo.R", "albedo.G", "albedo.B"}},
                            {auxiliary.normal, {"normal.X", "normal.Y", "normal.Z"}},
                            {auxiliary.depth, {"depth.Z"}}};
    std::vector<std::string> names = picture.channels;
    for (const char* prefix : {"", "variance."})
        for (const Layer& layer : layers)
            for (const std::string& name : layer.names) names.push_back(prefix + name);
    Image all(picture.width, picture.height, names);
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            int to = 0;
            while (to < picture.channel_count()) {
                all.at(x, y, to) = picture.at(x, y, to);
                ++to;
            }
            for (const bool variance : {false, true})
                for (const Layer& layer : layers) {
                    const Vec3f v =
                        variance ? layer.film.sample_variance(x, y) : layer.film.mean(x, y);
                    for (std::size_t c = 0; c < layer.names.size(); ++c)
                        all.at(x, y, to++) = v[static_cast<int>(c)];
                }
        }
    all.metadata = std::move(picture.metadata);
    all.metadata["nacre.auxiliary_samples"] = fmt::to_string(auxiliary.samples);
    picture = std::move(all);
}

}  // namespace nacre
