#include "nacre/techniques/render_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "nacre/math/error.h"
#include "nacre/scene/content_key.h"
#include "nacre/text/number.h"
#include "nacre/text/split_words.h"

namespace nacre {
namespace {

constexpr std::string_view identity_prefix = "is.";

const char* name_of(FilmQuantity quantity) {
    switch (quantity) {
        case FilmQuantity::luminance:
            return "luminance";
        case FilmQuantity::illuminance:
            return "illuminance";
        case FilmQuantity::radiance:
            break;
    }
    return "radiance";
}

/// All of it but the window.
std::string text_of(const FilmSettings& s) {
    const FilterSettings& f = s.filter;
    std::string text = fmt::format("{}x{} pixels of {}, {} filter", s.width, s.height,
                                   name_of(s.quantity), f.type);
    // What is as usual goes without saying.
    const FilterSettings usual;
    if (f.radius != usual.radius) text += fmt::format(" of radius {}", f.radius);
    if (f.stddev != usual.stddev) text += fmt::format(" of deviation {}", f.stddev);
    if (f.b != usual.b || f.c != usual.c) text += fmt::format(" with b {} and c {}", f.b, f.c);
    return text + (s.sample_border ? " beyond the border" : "");
}

std::string text_of(const ShapeTechnique& shape) {
    std::string text = fmt::format("{} profile={}", shape.technique->name, shape.profile);
    for (std::size_t i = 0; i < shape.options.size(); ++i)
        text += fmt::format(" {}={}", shape.options.parameters()[i].name, shape.options[i].number);
    return text;
}

std::string text_of(const std::vector<RenderPart>& parts) {
    std::string text;
    for (const RenderPart& p : parts)
        text += fmt::format("{}{} {} {} {} {} {}", text.empty() ? "" : "; ", p.seed, p.samples, p.x,
                            p.y, p.width, p.height);
    return text;
}

std::vector<RenderPart> parts_of(const std::string& text) {
    std::vector<RenderPart> parts;
    const auto wrong = [&] { return InputError(fmt::format("it holds parts = '{}'", text)); };
    for (const std::string_view part : split_words(text, ";")) {
        const std::vector<std::string_view> words = split_words(part);
        RenderPart p;
        int* const places[] = {&p.samples, &p.x, &p.y, &p.width, &p.height};
        if (words.size() != 1 + std::size(places)) throw wrong();
        const char* end = words[0].data() + words[0].size();
        if (std::from_chars(words[0].data(), end, p.seed).ptr != end) throw wrong();
        for (std::size_t i = 0; i < std::size(places); ++i) {
            const auto n = parse_integer(words[i + 1]);
            if (!n || *n < 0 || *n > 2'000'000'000) throw wrong();
            *places[i] = int(*n);
        }
        parts.push_back(p);
    }
    if (parts.empty()) throw wrong();
    return parts;
}

bool overlap(const RenderPart& a, const RenderPart& b) {
    return a.seed == b.seed && a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height &&
           b.y < a.y + a.height;
}

}  // namespace

RenderIdentity identity_of(const Scene& scene, const RenderPlan& plan, const FrameSettings& frame) {
    RenderIdentity is = content_keys_by_part(scene);
    // Names all of them, so that a new one does not compile until somebody has thought of it here.
    const auto& [type, max_depth, rr_depth, hide_emitters, moment, distance_grid, guided_exits,
                 legacy] = scene.integrator;
    is["integrator type"] = plan.integrator.empty() ? type : plan.integrator;
    is["max_depth"] = fmt::to_string(max_depth);
    is["rr_depth"] = fmt::to_string(rr_depth);
    is["hide_emitters"] = hide_emitters ? "true" : "false";
    is["distance_grid"] = distance_grid ? "true" : "false";
    is["guided_exits"] = guided_exits ? "true" : "false";
    (void)moment;  // it writes more of what is known
    (void)legacy;  // content of "integrator"
    is["mode"] = scene.mode == ColorMode::spectral ? "spectral" : "rgb";
    is["film"] = text_of(Film(frame.film).settings());
    is["sampler"] = frame.sampler.type;
    if (frame.sampler.type == "stratified")
        is["samples of the stratified sampler"] = fmt::to_string(frame.sampler.samples);
    for (std::uint32_t i = 0; i < plan.shapes.size(); ++i)
        if (plan.has_technique(i))
            is[fmt::format("technique of shape {}", i + 1)] = text_of(plan.shapes[i]);
    return is;
}

std::string differences(const RenderIdentity& there, const RenderIdentity& here) {
    std::vector<std::string> words;
    const auto is_key = [](const std::string& value) {
        return value.size() == 16 && value.find_first_not_of("0123456789abcdef") == value.npos;
    };
    const auto add = [&](const std::string& name, const std::string& a, const std::string& b) {
        if (a == b) return;
        const bool key = is_key(a.empty() ? b : a) && (b.empty() || is_key(b));
        words.push_back(key ? name
                            : fmt::format("{} ({} there, {} here)", name, a.empty() ? "none" : a,
                                          b.empty() ? "none" : b));
    };
    const auto value = [](const RenderIdentity& is, const std::string& name) {
        const auto found = is.find(name);
        return found == is.end() ? std::string() : found->second;
    };
    for (const auto& [name, a] : there) add(name, a, value(here, name));
    for (const auto& [name, b] : here)
        if (!there.contains(name)) add(name, "", b);
    return fmt::format("{}", fmt::join(words, "; "));
}

RenderPart part_of(const Film& film, std::uint64_t seed) {
    const FilmSettings& s = film.settings();
    std::uint32_t most = 0;
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x) most = std::max(most, film.drawn(x, y));
    return {seed, int(most), s.crop_x, s.crop_y, s.crop_width, s.crop_height};
}

void RenderState::save(const Film& film, const RenderState& about,
                       const std::filesystem::path& file) {
    std::map<std::string, std::string> notes{
        {"parts", text_of(about.parts)},
        {"integrator", about.integrator},
        {"samples", fmt::to_string(about.samples)},
        {"complete", about.complete ? "yes" : "no"},
        {"seconds", fmt::format("{:.3f}", about.seconds)},
        {"cpu_seconds", fmt::format("{:.3f}", about.cpu_seconds)},
        {"rays", fmt::to_string(about.counts.rays)},
        {"scatterings", fmt::to_string(about.counts.scatterings)}};
    for (const auto& [name, value] : about.identity)
        notes[std::string(identity_prefix) + name] = value;
    FilmState::save(film, notes, file);
}

RenderState RenderState::load(const std::filesystem::path& file) {
    try {
        FilmState kept = FilmState::load(file);
        const auto note = [&](const char* name) {
            const auto found = kept.notes.find(name);
            if (found == kept.notes.end())
                throw InputError(fmt::format("it holds no nacre.{}", name));
            return found->second;
        };
        const auto number = [&](const char* name, double most) {
            const auto n = parse_number(note(name));
            if (!n || !(*n >= 0 && *n <= most))
                throw InputError(fmt::format("it holds {} = '{}'", name, note(name)));
            return *n;
        };
        RenderState state{std::move(kept.film)};
        if (kept.notes.contains("key") && !kept.notes.contains("parts"))
            throw InputError(
                "it is a reference of nacre compare, which goes on with it by itself; of which "
                "seeds it is made it does not say");
        state.parts = parts_of(note("parts"));
        state.integrator = note("integrator");
        state.samples = int(number("samples", 2e9));
        state.complete = note("complete") == "yes";
        state.seconds = number("seconds", 1e15);
        state.cpu_seconds = number("cpu_seconds", 1e15);
        state.counts.rays = std::uint64_t(number("rays", 1e19));
        state.counts.scatterings = std::uint64_t(number("scatterings", 1e19));
        for (const auto& [name, value] : kept.notes)
            if (name.starts_with(identity_prefix))
                state.identity[name.substr(identity_prefix.size())] = value;
        return state;
    } catch (const InputError& error) {
        throw InputError(
            fmt::format("{}: is not the state of a render: {}", file.string(), error.what()));
    }
}

RenderState merge(std::vector<RenderState> states, const std::vector<std::string>& names) {
    FilmSettings window = states.at(0).film.settings();
    for (std::size_t i = 0; i < states.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            const std::string different = differences(states[k].identity, states[i].identity);
            if (!different.empty())
                throw InputError(fmt::format("{} and {} show different pictures; what differs: {}",
                                             names[k], names[i], different));
            for (const RenderPart& a : states[k].parts)
                for (const RenderPart& b : states[i].parts)
                    if (overlap(a, b))
                        throw InputError(fmt::format(
                            "{} and {} both have samples of seed {} in the same pixels, which "
                            "would count twice; render one of them with another --seed",
                            names[k], names[i], a.seed));
        }
        const FilmSettings& s = states[i].film.settings();
        const int right = std::max(window.crop_x + window.crop_width, s.crop_x + s.crop_width),
                  bottom = std::max(window.crop_y + window.crop_height, s.crop_y + s.crop_height);
        window.crop_x = std::min(window.crop_x, s.crop_x);
        window.crop_y = std::min(window.crop_y, s.crop_y);
        window.crop_width = right - window.crop_x;
        window.crop_height = bottom - window.crop_y;
    }
    RenderState all{Film(window), states[0].identity, {}, states[0].integrator};
    all.complete = true;
    for (const RenderState& s : states) {
        all.film.merge(s.film);
        all.parts.insert(all.parts.end(), s.parts.begin(), s.parts.end());
        all.complete = all.complete && s.complete;
        all.seconds += s.seconds;
        all.cpu_seconds += s.cpu_seconds;
        all.counts += s.counts;
    }
    all.samples = part_of(all.film, 0).samples;
    for (int y = 0; y < all.film.height(); ++y)
        for (int x = 0; x < all.film.width(); ++x)
            all.complete = all.complete && int(all.film.drawn(x, y)) == all.samples;
    return all;
}

}  // namespace nacre
