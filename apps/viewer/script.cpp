#include "apps/viewer/script.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "nacre/image/image.h"
#include "nacre/math/error.h"
#include "nacre/text/lines.h"
#include "nacre/text/names.h"
#include "nacre/text/number.h"
#include "nacre/text/split_words.h"
#include "nacre/text/whole_file.h"

namespace nacre::viewer {
namespace {

/// The words of a line behind its command, and what they mean.
class Words {
  public:
    Words(std::string_view usage, std::vector<std::string_view> words)
        : usage_(usage), words_(std::move(words)) {}

    std::size_t size() const { return words_.size(); }
    /// Throws unless there are so many.
    void expect(std::size_t least, std::size_t most) const {
        if (words_.size() < least || words_.size() > most)
            throw InputError(fmt::format("write '{}'", usage_));
    }
    std::string word(std::size_t i) const { return std::string(words_[i]); }
    double number(std::size_t i, double low, double high) const {
        const auto n = parse_number(words_[i]);
        if (!n || !(*n >= low && *n <= high))
            throw InputError(fmt::format("'{}' is not a number from {:g} to {:g}; write '{}'",
                                         words_[i], low, high, usage_));
        return *n;
    }
    int whole(std::size_t i, int low, int high) const {
        const auto n = parse_integer(words_[i]);
        if (!n || *n < low || *n > high)
            throw InputError(fmt::format("'{}' is not a whole number from {} to {}; write '{}'",
                                         words_[i], low, high, usage_));
        return int(*n);
    }
    Vec3f three(std::size_t i, double low, double high) const {
        const auto parts = split_words(words_[i], ",");
        const Words inner(usage_, parts);
        inner.expect(3, 3);
        return {float(inner.number(0, low, high)), float(inner.number(1, low, high)),
                float(inner.number(2, low, high))};
    }
    bool on(std::size_t i) const { return std::string_view(find(i, {"off", "on"})) == "on"; }
    /// One of these words.
    std::string_view find(std::size_t i, std::vector<std::string_view> known) const {
        const int k = find_name(words_[i], known);
        if (k < 0)
            throw InputError(
                fmt::format("'{}' is not one of {}", words_[i], fmt::join(known, ", ")));
        return known[std::size_t(k)];
    }

  private:
    std::string_view usage_;
    std::vector<std::string_view> words_;
};

/// Which light, and how many words say so.
std::pair<std::size_t, std::size_t> light_of(const Words& w, std::size_t others,
                                             const ViewerScene& scene) {
    if (scene.lights.empty())
        throw InputError("the scene's tree has no light that could be changed");
    w.expect(others, others + 1);
    if (w.size() == others) return {scene.key_light, 0};
    return {std::size_t(w.whole(0, 1, int(scene.lights.size()))) - 1, 1};
}

using Obey = Step (*)(const Words&, const ViewerScene&, ViewerState&);

struct Command {
    std::string_view name, usage;
    Obey obey;
};

constexpr double many = 1e9;

const Command commands[] = {
    {"technique", "technique NAME",
     [](const Words& w, const ViewerScene&, ViewerState& s) {
         w.expect(1, 1);
         s.technique = checked({w.word(0)});
         return Step{};
     }},
    {"set", "set NAME VALUE",
     [](const Words& w, const ViewerScene&, ViewerState& s) {
         w.expect(2, 2);
         set_option(s.technique, w.word(0), w.word(1));
         return Step{};
     }},
    {"split", "split TECHNIQUE|off [DIVIDER]",
     [](const Words& w, const ViewerScene&, ViewerState& s) {
         w.expect(1, 2);
         if (w.size() == 2) s.divider = w.number(1, 0, 1);
         s.split = plain_name(w.word(0)) != "off";
         if (s.split) s.beside = checked({w.word(0)});
         return Step{};
     }},
    {"set_split", "set_split NAME VALUE",
     [](const Words& w, const ViewerScene&, ViewerState& s) {
         w.expect(2, 2);
         set_option(s.beside, w.word(0), w.word(1));
         return Step{};
     }},
    {"samples", "samples NUMBER",
     [](const Words& w, const ViewerScene&, ViewerState& s) {
         w.expect(1, 1);
         s.samples = w.whole(0, 1, 1 << 24);
         return Step{};
     }},
    {"orbit", "orbit RIGHT UP",
     [](const Words& w, const ViewerScene&, ViewerState& s) {
         w.expect(2, 2);
         s.camera.turn(w.number(0, -3600, 3600), w.number(1, -180, 180));
         return Step{};
     }},
    {"pan", "pan RIGHT UP",
     [](const Words& w, const ViewerScene&, ViewerState& s) {
         w.expect(2, 2);
         s.camera.pan(w.number(0, -100, 100), w.number(1, -100, 100));
         return Step{};
     }},
    {"zoom", "zoom FACTOR",
     [](const Words& w, const ViewerScene&, ViewerState& s) {
         w.expect(1, 1);
         s.camera.zoom(w.number(0, 0.001, 1000));
         return Step{};
     }},
    {"view", "view AZIMUTH ELEVATION|front|back|left|right|top|three-quarter",
     [](const Words& w, const ViewerScene&, ViewerState& s) {
         w.expect(1, 2);
         if (w.size() == 1)
             s.camera.look_from(parse_view(w.word(0)));
         else
             s.camera.look_from({w.number(0, -3600, 3600), w.number(1, -90, 90)});
         return Step{};
     }},
    {"light", "light [NUMBER] AZIMUTH ELEVATION",
     [](const Words& w, const ViewerScene& scene, ViewerState& s) {
         const auto [light, at] = light_of(w, 2, scene);
         if (!scene.lights[light].turns)
             throw InputError(
                 fmt::format("light {} ({}) comes from everywhere and cannot be turned", light + 1,
                             scene.lights[light].name));
         s.lights[light].azimuth = w.number(at, -3600, 3600);
         s.lights[light].elevation = w.number(at + 1, -90, 90);
         return Step{};
     }},
    {"brightness", "brightness [NUMBER] FACTOR",
     [](const Words& w, const ViewerScene& scene, ViewerState& s) {
         const auto [light, at] = light_of(w, 1, scene);
         s.lights[light].brightness = w.number(at, 0, many);
         return Step{};
     }},
    {"material", "material NAME|scene",
     [](const Words& w, const ViewerScene&, ViewerState& s) {
         w.expect(1, 8);
         std::string name = w.word(0);  // "skim milk"
         for (std::size_t i = 1; i < w.size(); ++i) name += " " + w.word(i);
         MaterialEdit m = s.material;
         m.kind = MaterialEdit::Kind::scene;
         if (plain_name(name) != "scene") {
             m.kind = MaterialEdit::Kind::measured;
             m.name = name;
         }
         check(m);
         s.material = m;
         return Step{};
     }},
    {"coefficients", "coefficients SIGMA_S SIGMA_A [ETA]",
     [](const Words& w, const ViewerScene&, ViewerState& s) {
         w.expect(2, 3);
         MaterialEdit m = s.material;
         m.kind = MaterialEdit::Kind::coefficients;
         m.sigma_s = w.three(0, 0, 1e6);
         m.sigma_a = w.three(1, 0, 1e6);
         if (w.size() == 3) m.eta = float(w.number(2, 1, 4));
         check(m);
         s.material = m;
         return Step{};
     }},
    {"artist", "artist COLOUR RADIUS [ETA]",
     [](const Words& w, const ViewerScene&, ViewerState& s) {
         w.expect(2, 3);
         MaterialEdit m = s.material;
         m.kind = MaterialEdit::Kind::artist;
         m.color = w.three(0, 0, 1);
         m.radius = w.three(1, 0, 1e6);
         if (w.size() == 3) m.eta = float(w.number(2, 1, 4));
         check(m);
         s.material = m;
         return Step{};
     }},
    {"deform", "deform none|twist|bend|breathe [AMOUNT [PHASE]]",
     [](const Words& w, const ViewerScene&, ViewerState& s) {
         w.expect(1, 3);
         const std::vector<std::string_view> kinds{"none", "twist", "bend", "breathe"};
         const auto kind = std::ranges::find(kinds, w.find(0, kinds)) - kinds.begin();
         Deformation d{.kind = Deformation::Kind(kind)};
         d.amount = w.size() > 1 ? float(w.number(1, -20, 20)) : 0.5f;
         // Breath is in between at a phase of 0, where the others are at their end.
         d.phase = w.size() > 2                           ? float(w.number(2, -1000, 1000))
                   : d.kind == Deformation::Kind::breathe ? 1.5707963f
                                                          : 0.f;
         s.deformation = kind == 0 ? Deformation{} : d;
         return Step{};
     }},
    {"animate", "animate on|off",
     [](const Words& w, const ViewerScene&, ViewerState& s) {
         w.expect(1, 1);
         s.animated = w.on(0);
         return Step{};
     }},
    {"exposure", "exposure STOPS",
     [](const Words& w, const ViewerScene&, ViewerState& s) {
         w.expect(1, 1);
         s.display.exposure = float(w.number(0, -100, 100));
         return Step{};
     }},
    {"false_color", "false_color off|cd|lx [LOW HIGH]",
     [](const Words& w, const ViewerScene&, ViewerState& s) {
         w.expect(1, 3);
         Display d = s.display;
         const std::string_view quantity = w.find(0, {"off", "cd", "lx"});
         d.quantity = quantity == "off"  ? Quantity::color
                      : quantity == "cd" ? Quantity::luminance
                                         : Quantity::illuminance;
         if (d.quantity != s.display.quantity && d.quantity != Quantity::color)
             std::tie(d.low, d.high) = usual_scale(d.quantity);
         if (w.size() == 2) w.expect(3, 3);
         if (w.size() == 3) {
             d.low = w.number(1, 1e-12, 1e12);
             d.high = w.number(2, 1e-12, 1e12);
             if (!(d.low < d.high))
                 throw InputError(
                     fmt::format("the scale ends at {:g}, which is not above its "
                                 "beginning at {:g}",
                                 d.high, d.low));
         }
         s.display = d;
         return Step{};
     }},
    {"average", "average on|off",
     [](const Words& w, const ViewerScene&, ViewerState& s) {
         w.expect(1, 1);
         s.quality.average = w.on(0);
         return Step{};
     }},
    {"light_points", "light_points NUMBER",
     [](const Words& w, const ViewerScene&, ViewerState& s) {
         w.expect(1, 1);
         s.quality.light_points = w.whole(0, 1, 64);
         return Step{};
     }},
    {"light_view", "light_view WIDTH",
     [](const Words& w, const ViewerScene&, ViewerState& s) {
         w.expect(1, 1);
         s.quality.light_view = checked_light_view(w.whole(0, 64, 4096));
         return Step{};
     }},
    {"frame", "frame NUMBER",
     [](const Words& w, const ViewerScene&, ViewerState&) {
         w.expect(1, 1);
         return Step{.kind = Step::Kind::frames, .frames = w.whole(0, 1, 1000000)};
     }},
    {"screenshot", "screenshot FILE",
     [](const Words& w, const ViewerScene&, ViewerState&) {
         w.expect(1, 1);
         check_image_output(w.word(0));
         return Step{.kind = Step::Kind::screenshot, .file = w.word(0)};
     }},
    {"save", "save FILE.xml",
     [](const Words& w, const ViewerScene&, ViewerState&) {
         w.expect(1, 1);
         if (std::filesystem::path(w.word(0)).extension() != ".xml")
             throw InputError(fmt::format("'{}' is not the name of a scene file, .xml", w.word(0)));
         check_output_file(w.word(0));
         return Step{.kind = Step::Kind::save, .file = w.word(0)};
     }},
};

}  // namespace

std::vector<std::string_view> command_names() {
    std::vector<std::string_view> names;
    for (const Command& c : commands) names.push_back(c.name);
    return names;
}

Step obey(std::string_view line, const ViewerScene& scene, ViewerState& state) {
    auto words = split_words(line, " \t\r");
    if (words.empty()) return {};
    const std::vector<std::string_view> names = command_names();
    const int i = find_name(words[0], names);
    if (i < 0) throw InputError(unknown_name("command", words[0], names));
    const Command& command = commands[std::size_t(i)];
    words.erase(words.begin());
    return command.obey(Words(command.usage, std::move(words)), scene, state);
}

std::vector<ScriptLine> read_script(const std::filesystem::path& file, const ViewerScene& scene) {
    const auto text = read_whole_file(file);
    if (!text) throw InputError(fmt::format("{}: cannot be read", file.string()));
    std::vector<ScriptLine> lines;
    ViewerState state = scene.state();
    LineSplitter splitter(*text);
    std::string_view line;
    while (splitter.next(line)) {
        line = without_comment(line);
        if (split_words(line, " \t\r").empty()) continue;
        try {
            obey(line, scene, state);
        } catch (const InputError& error) {
            throw InputError(
                fmt::format("{}:{}: {}", file.string(), splitter.line(), error.what()));
        }
        lines.push_back({splitter.line(), std::string(line)});
    }
    return lines;
}

}  // namespace nacre::viewer
