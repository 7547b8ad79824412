// Integrator, film and sampler: what a scene file says about how to render.
#include <fmt/format.h>

#include <limits>

#include "nacre/scene/legacy_settings.h"
#include "nacre/scene/scene_builder.h"
#include "nacre/text/names.h"

namespace nacre {
namespace {

/// An integer parameter within [low, high].
int get_count(const SceneNode& node, std::string_view name, int otherwise, int low, int high) {
    const std::int64_t value = node.get_int(name, otherwise);
    if (value < low || value > high)
        node.fail_at(name, fmt::format("'{}' of {} must lie within [{}, {}]; got {}", name,
                                       node.describe(), low, high, value));
    return static_cast<int>(value);
}

constexpr int unlimited = std::numeric_limits<int>::max();

FilterSettings read_filter(const SceneNode& node) {
    const std::vector<std::string> known = {"box", "tent", "gaussian", "mitchell"};
    FilterSettings filter;
    filter.type = node.type;
    const auto positive = [&](std::string_view name, double otherwise) {
        const double value = node.get_float(name, otherwise);
        if (value < 0.0 || (value == 0.0 && node.has(name)))
            node.fail_at(name, fmt::format("'{}' of {} must be positive; got {}", name,
                                           node.describe(), value));
        return static_cast<float>(value);
    };
    if (node.type == "box" || node.type == "tent") {
        filter.radius = positive("radius", 0.0);
    } else if (node.type == "gaussian") {
        filter.stddev = positive("stddev", 0.5);
    } else if (node.type == "mitchell") {
        filter.b = static_cast<float>(node.get_float("A", 1.0 / 3.0));
        filter.c = static_cast<float>(node.get_float("B", 1.0 / 3.0));
    } else {
        node.fail(unknown_name("rfilter type", node.type, known));
    }
    node.check_all_used();
    return filter;
}

}  // namespace

IntegratorSettings read_integrator(const SceneNode& node) {
    const std::vector<std::string> known = {"path", "volpath", "volpathmis",
                                            "ray",  "legacy",  "moment"};
    IntegratorSettings settings;
    if (node.type == "moment") {
        const auto nested = node.children_of("integrator");
        if (nested.size() != 1)
            node.fail(fmt::format("{} wraps exactly one <integrator>; got {}", node.describe(),
                                  nested.size()));
        if (nested[0]->node->type == "moment")
            nested[0]->node->fail("<integrator type=\"moment\"> cannot wrap another of its type");
        settings = read_integrator(*nested[0]->node);
        settings.moment = true;
        node.check_all_used();
        return settings;
    }
    settings.type = node.type == "volpathmis" ? "volpath" : node.type;
    if (settings.type != "path" && settings.type != "volpath" && settings.type != "ray" &&
        settings.type != "legacy")
        node.fail(unknown_name("integrator type", node.type, known));
    settings.hide_emitters = node.get_bool("hide_emitters", false);
    settings.max_depth = get_count(node, "max_depth", -1, -1, unlimited);
    settings.rr_depth = get_count(node, "rr_depth", 5, 1, unlimited);
    if (settings.type == "volpath") {
        settings.distance_grid = node.get_bool("distance_grid", true);
        settings.guided_exits = node.get_bool("guided_exits", true);
    }
    if (settings.type == "legacy") settings.legacy = read_legacy(node);
    node.check_all_used();
    return settings;
}

FilmSettings read_film(const SceneNode& node, BuildContext& context) {
    if (node.type != "hdrfilm") node.fail(unknown_name("film type", node.type, {"hdrfilm"}));
    FilmSettings film;
    constexpr int largest = 65536;  // a side; more would not fit the addresses of a pixel
    film.width = get_count(node, "width", 768, 1, largest);
    film.height = get_count(node, "height", 576, 1, largest);
    film.crop_x = get_count(node, "crop_offset_x", 0, 0, film.width - 1);
    film.crop_y = get_count(node, "crop_offset_y", 0, 0, film.height - 1);
    const int rest_x = film.width - film.crop_x, rest_y = film.height - film.crop_y;
    film.crop_width = get_count(node, "crop_width", rest_x, 1, rest_x);
    film.crop_height = get_count(node, "crop_height", rest_y, 1, rest_y);

    const std::string quantity =
        node.get_choice("quantity", {"radiance", "luminance", "illuminance"});
    if (quantity == "luminance") film.quantity = FilmQuantity::luminance;
    if (quantity == "illuminance") film.quantity = FilmQuantity::illuminance;

    // Mitsuba's description of the output file. Nacre chooses the format by the name of the file
    // and always stores 32-bit floats, which hold all that these ask for.
    const std::string pixels = node.get_choice(
        "pixel_format", {"rgb", "rgba", "luminance", "luminance_alpha", "xyz", "xyza"});
    if (pixels != "rgb")
        context.warnings.push_back(
            fmt::format("{}: pixel_format '{}' is written as rgb", node.location.str(), pixels));
    node.get_choice("component_format", {"float16", "float32"});
    node.get_choice("file_format", {"openexr", "exr", "rgbe", "pfm"});
    film.sample_border = node.get_bool("sample_border", false);
    node.get_bool("compensate", false);

    const auto filters = node.children_of("rfilter");
    if (filters.size() > 1) filters[1]->node->fail("a film has only one <rfilter>");
    if (!filters.empty()) film.filter = read_filter(*filters[0]->node);
    node.check_all_used();
    return film;
}

SamplerSettings read_sampler(const SceneNode& node) {
    const std::vector<std::string> known = {"independent", "stratified", "sobol"};
    if (std::find(known.begin(), known.end(), node.type) == known.end())
        node.fail(unknown_name("sampler type", node.type, known));
    SamplerSettings sampler;
    sampler.type = node.type;
    sampler.samples = get_count(node, "sample_count", 4, 1, unlimited);
    const std::int64_t seed = node.get_int("seed", 0);
    if (seed < 0) node.fail_at("seed", fmt::format("'seed' cannot be negative; got {}", seed));
    sampler.seed = static_cast<std::uint64_t>(seed);
    node.check_all_used();
    return sampler;
}

}  // namespace nacre
