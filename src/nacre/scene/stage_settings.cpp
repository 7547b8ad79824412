// What people write about the stage of a bare mesh.
#include <fmt/format.h>

#include <map>

#include "nacre/catalogue/describe.h"
#include "nacre/catalogue/settings.h"
#include "nacre/math/error.h"
#include "nacre/scene/stage.h"
#include "nacre/text/names.h"
#include "nacre/text/number.h"
#include "nacre/text/split_words.h"

namespace nacre {
namespace {

/// Three numbers: places, directions, colours.
Parameter three(std::string_view name, std::string_view meaning, std::string_view unit = "") {
    return {.name = name,
            .meaning = meaning,
            .kind = ParameterKind::spectrum,
            .unit = unit,
            .low = -infinite,
            .high = infinite};
}

Parameter number(std::string_view name, std::string_view meaning, std::string_view unit, double low,
                 double high, double otherwise) {
    return {.name = name,
            .meaning = meaning,
            .unit = unit,
            .low = low,
            .high = high,
            .above_low = low == 0. && name != "white" && name != "scale" && name != "beam_width",
            .otherwise = otherwise};
}

/// Settings checked against their parameters; places and colours stay three numbers.
class Words {
  public:
    Words(std::string_view owner, std::span<const Parameter> parameters, std::string_view text)
        : owner_(owner) {
        Settings numbers;
        for (const std::string_view word : split_words(text, " \t")) {
            const Setting setting = parse(word);
            const auto i = std::size_t(find_parameters(owner_, parameters, setting.name)[0]);
            const Parameter& p = parameters[i];
            if (p.kind != ParameterKind::spectrum) {
                numbers.push_back(setting);
                continue;
            }
            const Vec3f* value = std::get_if<Vec3f>(&setting.value);
            if (!value)
                throw InputError(fmt::format("{}: {} takes three numbers, such as {}=0,100,300",
                                             owner_, p.name, p.name));
            for (int c = 0; c < 3; ++c) check_range(owner_, p, (*value)[std::size_t(c)]);
            if (!vectors_.emplace(p.name, *value).second)
                throw InputError(fmt::format("{}: {} is given twice", owner_, p.name));
        }
        values_ = ParameterValues(owner_, parameters, numbers);
    }

    std::optional<Vec3f> vector(std::string_view name) const {
        const auto found = vectors_.find(name);
        return found == vectors_.end() ? std::nullopt : std::optional(found->second);
    }
    std::optional<Vec3d> place(std::string_view name) const {
        const auto found = vector(name);
        return found ? std::optional(Vec3d(*found)) : std::nullopt;
    }
    Vec3d needed(std::string_view name, std::string_view example) const {
        if (const auto found = place(name)) return *found;
        throw InputError(
            fmt::format("{}: {} is missing, such as {}={}", owner_, name, name, example));
    }
    bool given(std::string_view name) const { return values_.given(name); }
    double number(std::string_view name) const { return values_.number(name); }

  private:
    Setting parse(std::string_view word) const {
        try {
            return parse_setting(word);
        } catch (const InputError& e) {
            throw InputError(fmt::format("{}: {}", owner_, e.what()));
        }
    }

    std::string_view owner_;
    ParameterValues values_;
    std::map<std::string_view, Vec3f> vectors_;
};

struct Description {
    std::string_view owner, meaning;
    std::vector<Parameter> parameters;
};

const Description& camera_description() {
    static const Description d{"--camera",
                               "a viewer at a place",
                               {three("origin", "where it stands", "mm"),
                                three("target", "where it looks (the object's middle)", "mm"),
                                three("up", "what is up in the picture (0,1,0)"),
                                number("fov", "what it sees, across the shorter side of the film",
                                       "degrees", 0, 175, 26)}};
    return d;
}

const Description& environment_description() {
    static const Description d{
        "--env",
        "FILE and settings: surroundings by a picture in latitude and longitude",
        {number("rotate", "about up, from the front to the right", "degrees", -infinite, infinite,
                0),
         number("scale", "of its radiance", "", 0, infinite, 1)}};
    return d;
}

const std::vector<Description>& light_descriptions() {
    const auto at_least_0 = [](std::string_view name, std::string_view meaning) {
        Parameter p = three(name, meaning);
        p.low = 0;
        return p;
    };
    const Parameter position = three("position", "where it stands", "mm"),
                    target = three("target", "where it looks (the object's middle)", "mm"),
                    color = at_least_0("color", "of its light, times `white` (1,1,1)"),
                    white = number("white",
                                   "radiance that it alone gives to a white surface at the "
                                   "object's middle, turned towards it",
                                   "", 0, infinite, 1);
    const auto emission = [&](std::string_view name) {
        return at_least_0(name, "what it emits, instead of `white` and `color`");
    };
    // In the order of StageLight::Type.
    static const std::vector<Description> all{
        {"point", "the same intensity everywhere", {position, color, white, emission("intensity")}},
        {"spot",
         "a cone",
         {position, target, color, white, emission("intensity"),
          number("cutoff_angle", "where nothing is left, from its middle", "degrees", 0, 180, 20),
          number("beam_width", "up to where it is full (3/4 of cutoff_angle)", "degrees", 0, 180,
                 15)}},
        {"directional",
         "parallel light",
         {three("direction", "where it goes"), color, white, emission("irradiance")}},
        {"sphere",
         "a shining ball",
         {position, number("radius", "of the ball", "mm", 0, infinite, 20), color, white,
          emission("radiance")}},
        {"area",
         "a shining square that faces its target",
         {position, target, number("size", "its side", "mm", 0, infinite, 40), color, white,
          emission("radiance")}}};
    return all;
}

std::vector<std::string_view> light_names() {
    std::vector<std::string_view> names;
    for (const Description& d : light_descriptions()) names.push_back(d.owner);
    return names;
}

/// Numbers between commas.
std::optional<std::vector<double>> numbers_in(std::string_view text, std::size_t count) {
    std::vector<double> numbers;
    for (const std::string_view word : split_words(text, ", "))
        if (const auto number = parse_number(word); number && std::isfinite(*number))
            numbers.push_back(*number);
        else
            return {};
    return numbers.size() == count ? std::optional(numbers) : std::nullopt;
}

void describe(const Description& d, std::string& text) {
    text += fmt::format("  {}: {}\n", d.owner, d.meaning);
    for (const Parameter& p : d.parameters) {
        const bool is_three = p.kind == ParameterKind::spectrum;
        text += fmt::format(
            "    {:<13} {}{}{}\n", p.name, p.meaning,
            p.unit.empty() ? "" : fmt::format(", {}", p.unit),
            is_three ? "" : fmt::format(" ({}, within {})", default_text(p), range_text(p)));
    }
}

}  // namespace

StageView parse_view(std::string_view text) {
    static constexpr std::pair<std::string_view, StageView> named[] = {
        {"front", {0, 0}},  {"back", {180, 0}}, {"left", {-90, 0}},
        {"right", {90, 0}}, {"top", {0, 90}},   {"three-quarter", {28, 14}}};
    std::vector<std::string_view> names;
    for (const auto& [name, view] : named) names.push_back(name);
    if (const int i = find_name(text, names); i >= 0) return named[i].second;
    if (const auto angles = numbers_in(text, 2)) {
        if (std::abs((*angles)[1]) > 90)
            throw InputError(
                fmt::format("--view: an elevation of {:g} degrees is out of range: "
                            "must lie within [-90, 90]",
                            (*angles)[1]));
        return {(*angles)[0], (*angles)[1]};
    }
    if (text.find(',') != text.npos)
        throw InputError(
            fmt::format("--view: '{}' is no view; write AZIMUTH,ELEVATION in degrees, "
                        "such as 30,15",
                        text));
    throw InputError("--view: " + unknown_name("view", text, names));
}

StageCamera parse_stage_camera(std::string_view text) {
    const Description& d = camera_description();
    const Words words(d.owner, d.parameters, text);
    StageCamera camera;
    camera.origin = words.needed("origin", "0,60,400");
    camera.target = words.place("target");
    camera.up = words.place("up").value_or(camera.up);
    camera.fov = words.number("fov");
    return camera;
}

StageLight parse_stage_light(std::string_view text) {
    const std::vector<std::string_view> words = split_words(text, " \t");
    const std::string_view type = words.empty() ? "" : words[0];
    const int i = find_name(type, light_names());
    if (i < 0) throw InputError("--light: " + unknown_name("light", type, light_names()));
    const Description& d = light_descriptions()[std::size_t(i)];
    const std::string owner = fmt::format("--light {}", d.owner);
    const Words given(owner, d.parameters, text.substr(text.find(type) + type.size()));

    StageLight light;
    light.type = StageLight::Type(i);
    if (light.type == StageLight::Type::directional) {
        light.direction = given.needed("direction", "-1,-1,-1");
        if (!(length(light.direction) > 0))
            throw InputError(owner + ": direction must not be 0,0,0");
    } else {
        light.position = given.needed("position", "-200,300,300");
    }
    light.target = given.place("target");
    for (const std::string_view name : {"intensity", "irradiance", "radiance"})
        if (const auto emission = given.vector(name)) {
            light.emission = emission;
            if (given.given("white") || given.vector("color"))
                throw InputError(
                    fmt::format("{}: give either {}, or white and color", owner, name));
        }
    light.color = given.vector("color").value_or(light.color);
    light.white = given.number("white");
    if (light.type == StageLight::Type::sphere) light.radius = given.number("radius");
    if (light.type == StageLight::Type::area) light.size = given.number("size");
    if (light.type == StageLight::Type::spot) {
        light.cutoff_angle = given.number("cutoff_angle");
        light.beam_width =
            given.given("beam_width") ? given.number("beam_width") : 0.75 * light.cutoff_angle;
        if (light.beam_width > light.cutoff_angle)
            throw InputError(fmt::format("{}: beam_width = {:g} is more than cutoff_angle = {:g}",
                                         owner, light.beam_width, light.cutoff_angle));
    }
    return light;
}

StageEnvironment parse_stage_environment(std::string_view text) {
    const Description& d = environment_description();
    // A file's name may have blanks; settings come last.
    std::size_t end = text.size();
    while (end > 0 && !std::filesystem::exists(text.substr(0, end))) {
        const std::size_t blank = text.find_last_of(' ', end - 1);
        const std::string_view word = text.substr(blank == text.npos ? 0 : blank + 1, end);
        if (blank == text.npos || word.find('=') == word.npos) break;
        end = blank;
    }
    StageEnvironment environment;
    environment.file = std::filesystem::path(text.substr(0, end));
    const Words words(d.owner, d.parameters, text.substr(end));
    environment.rotate = words.number("rotate");
    environment.scale = words.number("scale");
    return environment;
}

std::optional<Vec3f> parse_background(std::string_view text) {
    if (text == "env") return {};
    if (text == "none") return Vec3f{};
    const auto rgb = numbers_in(text, 3);
    if (!rgb || std::ranges::min(*rgb) < 0)
        throw InputError(
            fmt::format("--background: '{}' is no colour; write R,G,B (linear, not "
                        "negative), env or none",
                        text));
    return Vec3f{float((*rgb)[0]), float((*rgb)[1]), float((*rgb)[2])};
}

std::string stage_help() {
    std::string text;
    describe(camera_description(), text);
    describe(environment_description(), text);
    for (Description d : light_descriptions()) {
        const std::string owner = fmt::format("--light {}", d.owner);
        d.owner = owner;
        describe(d, text);
    }
    return text;
}

}  // namespace nacre
