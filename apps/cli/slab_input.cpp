#include "apps/cli/slab_input.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>
#include <vector>

#include "nacre/math/error.h"
#include "nacre/text/names.h"

namespace nacre::cli {
namespace {

/// Words name=value by their names; `who` begins the messages.
class Words {
  public:
    Words(const std::string& text, std::string who, std::vector<std::string_view> known)
        : who_(std::move(who)) {
        std::istringstream words(text);
        for (std::string word; words >> word;) {
            const std::size_t equals = word.find('=');
            if (equals == 0 || equals == word.npos || equals + 1 == word.size())
                throw InputError(fmt::format("{}: '{}' is not of the form name=value", who_, word));
            const std::string name = word.substr(0, equals);
            const int i = find_name(name, known);
            if (i < 0)
                throw InputError(
                    fmt::format("{}: {}", who_, unknown_name("parameter", name, known)));
            const std::string_view meant = known[std::size_t(i)];
            if (!values_.emplace(meant, word.substr(equals + 1)).second)
                throw InputError(fmt::format("{}: {} is given twice", who_, meant));
        }
    }

    bool has(std::string_view name) const { return values_.contains(name); }
    std::optional<std::string> word(std::string_view name) const {
        const auto found = values_.find(name);
        return found == values_.end() ? std::nullopt : std::optional(found->second);
    }
    double number(std::string_view name, double otherwise) const {
        const std::optional<std::string> text = word(name);
        if (!text) return otherwise;
        double value = 0.;
        const char* end = text->data() + text->size();
        const auto [rest, error] = std::from_chars(text->data(), end, value);
        if (error != std::errc() || rest != end || std::isnan(value))
            throw InputError(fmt::format("{}: {} = '{}' is not a number", who_, name, *text));
        return value;
    }

  private:
    std::string who_;
    std::map<std::string_view, std::string> values_;
};

}  // namespace

Layer parse_layer(const std::string& text, std::size_t number) {
    const std::string who = fmt::format("layer {}", number);
    const Words words(text, who, {"sigma_s", "sigma_a", "g", "thickness", "eta", "albedo", "tau"});
    Layer layer;
    layer.g = words.number("g", 0.);
    layer.eta = words.number("eta", 1.);
    if (!words.has("albedo") && !words.has("tau")) {
        if (!words.has("thickness"))
            throw InputError(who + ": thickness is missing, in mm; thickness=inf is a half space");
        layer.sigma_s = words.number("sigma_s", 0.);
        layer.sigma_a = words.number("sigma_a", 0.);
        layer.thickness = words.number("thickness", 1.);
        return layer;
    }
    if (words.has("sigma_s") || words.has("sigma_a") || !words.has("albedo") || !words.has("tau"))
        throw InputError(who + ": give sigma_s and sigma_a, or albedo and tau");
    const double albedo = words.number("albedo", 0.), tau = words.number("tau", 0.);
    if (!(albedo >= 0. && albedo <= 1.))
        throw InputError(fmt::format("{}: albedo = {:g} must be between 0 and 1", who, albedo));
    if (!(tau > 0.)) throw InputError(fmt::format("{}: tau = {:g} must be positive", who, tau));
    // Only the product counts where nothing else has a length.
    layer.thickness = words.number("thickness", std::isinf(tau) ? tau : 1.);
    if (!(layer.thickness > 0.) || std::isinf(tau) != std::isinf(layer.thickness))
        throw InputError(fmt::format("{}: tau = {:g} does not go with thickness = {:g}", who, tau,
                                     layer.thickness));
    const double sigma_t = std::isinf(tau) ? 1. : tau / layer.thickness;
    layer.sigma_s = albedo * sigma_t;
    layer.sigma_a = (1. - albedo) * sigma_t;
    return layer;
}

SkinParameters parse_skin(const std::string& text) {
    const Words words(text, "--skin",
                      {"melanin", "blood", "oxygenation", "haemoglobin", "eumelanin", "optics"});
    SkinParameters skin;
    skin.epidermis.melanin = words.number("melanin", skin.epidermis.melanin);
    const double before = skin.papillary_dermis.blood;
    const double factor = words.number("blood", before) / before;
    for (SkinLayer* layer : {&skin.papillary_dermis, &skin.reticular_dermis, &skin.hypodermis})
        layer->blood *= factor;
    skin.oxygenation = words.number("oxygenation", skin.oxygenation);
    skin.haemoglobin = words.number("haemoglobin", skin.haemoglobin);
    const std::string optics = words.word("optics").value_or("jacques");
    constexpr std::string_view known[] = {"jacques", "donner_jensen"};
    const int i = find_name(optics, known);
    if (i < 0) throw InputError("--skin: " + unknown_name("optics", optics, known));
    if (i == 1) {
        skin.melanin_model = MelaninModel::donner_jensen;
        skin.scattering_model = SkinScattering::donner_jensen;
        skin.eumelanin = words.number("eumelanin", skin.eumelanin);
    } else if (words.has("eumelanin")) {
        throw InputError("--skin: eumelanin needs optics=donner_jensen; jacques has one melanin");
    }
    check(skin);
    return skin;
}

}  // namespace nacre::cli
