#include "nacre/scene/xml/values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <iterator>
#include <optional>

#include "nacre/math/frame.h"
#include "nacre/scene/xml/find_file.h"
#include "nacre/spectrum/color.h"
#include "nacre/text/lines.h"
#include "nacre/text/names.h"
#include "nacre/text/number.h"
#include "nacre/text/split_words.h"
#include "nacre/text/whole_file.h"

namespace nacre {
namespace {

/// The whole of `text` as a finite number, or nothing.
std::optional<double> finite_number(std::string_view text) {
    const auto value = parse_number(text);
    return value && std::isfinite(*value) ? value : std::nullopt;
}

double number(const XmlElement& element, std::string_view text) {
    if (const auto value = finite_number(text)) return *value;
    element.fail(fmt::format("'{}' is not a number", text));
}

/// The attribute as one number.
double number_attribute(const XmlElement& element, const std::string& attribute) {
    const std::string text = element.get(attribute);
    const auto tokens = split_words(text, " \t\r\n");
    return number(element, tokens.size() == 1 ? tokens[0] : std::string_view(text));
}

std::vector<double> numbers(const XmlElement& element, const std::string& attribute) {
    const std::string text = element.get(attribute);
    std::vector<double> values;
    for (const std::string_view token : split_words(text)) values.push_back(number(element, token));
    return values;
}

std::int64_t integer(const XmlElement& element) {
    const std::string text = element.get("value");
    const auto tokens = split_words(text, " \t\r\n");
    std::string_view token = tokens.size() == 1 ? tokens[0] : std::string_view(text);
    if (token.starts_with('+') && !token.starts_with("+-")) token.remove_prefix(1);
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), value);
    if (error == std::errc::result_out_of_range)
        element.fail(fmt::format("'{}' is too large for an integer", text));
    if (error != std::errc() || end != token.data() + token.size())
        element.fail(fmt::format("'{}' is not an integer", text));
    return value;
}

bool boolean(const XmlElement& element) {
    std::string word = element.get("value");
    std::transform(word.begin(), word.end(), word.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (word != "true" && word != "false")
        element.fail(fmt::format("'{}' is neither 'true' nor 'false'", element.get("value")));
    return word == "true";
}

/// Three numbers from `value` (one for all, or three) or from `x`, `y`, `z`.
Vec3d triple(const XmlElement& element, double otherwise) {
    const bool parts = element.has("x") || element.has("y") || element.has("z");
    if (element.has("value")) {
        if (parts)
            element.fail(fmt::format("<{}> takes 'value' or x, y, z, not both", element.tag));
        const std::vector<double> v = numbers(element, "value");
        if (v.size() == 1) return {v[0], v[0], v[0]};
        if (v.size() == 3) return {v[0], v[1], v[2]};
        element.fail(fmt::format("<{}> takes one or three numbers; got {}", element.tag, v.size()));
    }
    if (!parts) element.fail(fmt::format("<{}> needs 'value' or x, y, z", element.tag));
    const auto part = [&](const char* name) {
        return element.has(name) ? number_attribute(element, name) : otherwise;
    };
    return {part("x"), part("y"), part("z")};
}

Vec3d named_triple(const XmlElement& element, const std::string& attribute) {
    const std::vector<double> v = numbers(element, attribute);
    if (v.size() != 3)
        element.fail(fmt::format("'{}' of <{}> takes three numbers; got {}", attribute, element.tag,
                                 v.size()));
    return {v[0], v[1], v[2]};
}

Transform look_at(const XmlElement& element) {
    element.check_attributes({"origin", "target"}, {"up"});
    const Vec3d origin = named_triple(element, "origin"), target = named_triple(element, "target");
    Vec3d up{};
    if (element.has("up")) up = named_triple(element, "up");
    if (origin == target) element.fail("origin and target of <lookat> are the same point");
    // As in Mitsuba, no `up` (or a zero one) leaves the choice to the renderer.
    if (up == Vec3d{}) up = Frame<double>::around(normalize(target - origin)).s;
    return Transform::look_at(origin, target, up);
}

Transform matrix(const XmlElement& element) {
    element.check_attributes({"value"});
    const std::vector<double> v = numbers(element, "value");
    if (v.size() != 16 && v.size() != 9)
        element.fail(fmt::format("<matrix> takes 16 or 9 numbers; got {}", v.size()));
    Transform::Matrix m{};
    m[15] = 1.0;
    const std::size_t side = v.size() == 16 ? 4 : 3;
    for (std::size_t i = 0; i < v.size(); ++i) m[i / side * 4 + i % side] = v[i];
    return Transform(m);
}

Transform transform_step(const XmlElement& element) {
    static const std::vector<std::string> known = {"translate", "scale", "rotate", "lookat",
                                                   "matrix"};
    if (element.tag == "translate" || element.tag == "scale") {
        element.check_attributes({}, {"value", "x", "y", "z"});
        if (element.tag == "translate") return Transform::translate(triple(element, 0.0));
        return Transform::scale(triple(element, 1.0));
    }
    if (element.tag == "rotate") {
        element.check_attributes({"angle"}, {"value", "x", "y", "z"});
        const Vec3d axis = triple(element, 0.0);
        if (axis == Vec3d{}) element.fail("the axis of <rotate> must not be zero");
        return Transform::rotate(axis, number_attribute(element, "angle"));
    }
    if (element.tag == "lookat") return look_at(element);
    if (element.tag == "matrix") return matrix(element);
    element.fail(fmt::format("<{}> cannot stand in <transform>{}", element.tag,
                             suggestion(element.tag, known)));
}

/// Steps apply in the order in which they are written: each multiplies from the left.
Transform transform(const XmlElement& element, const ValueContext& context) {
    Transform result;
    for (const pugi::xml_node& child : element.node.children()) {
        if (child.type() != pugi::node_element) element.fail("text cannot stand in <transform>");
        const XmlElement step(context.source, child, context.parameters);
        try {
            result = transform_step(step) * result;
        } catch (const InputError& e) {
            // Transform knows what is wrong but not where.
            const std::string message = e.what();
            if (message.starts_with(step.location.str())) throw;
            step.fail(message);
        }
    }
    return result;
}

std::optional<Vec3f> parse_hex(std::string_view text) {
    unsigned code = 0;
    if (text.size() != 7 || text[0] != '#') return std::nullopt;
    const auto [end, error] = std::from_chars(text.data() + 1, text.data() + 7, code, 16);
    if (error != std::errc() || end != text.data() + 7) return std::nullopt;
    const auto channel = [&](int shift) {
        return srgb_decode(static_cast<float>((code >> shift) & 255u) / 255.f);
    };
    return Vec3f{channel(16), channel(8), channel(0)};
}

ColorValue rgb(const XmlElement& element) {
    ColorValue color;
    const std::string text = element.get("value");
    if (text.starts_with('#')) {
        const auto parsed = parse_hex(text);
        if (!parsed) element.fail(fmt::format("'{}' is not a colour of the form #rrggbb", text));
        color.rgb = *parsed;
        return color;
    }
    const std::vector<double> v = numbers(element, "value");
    if (v.size() != 1 && v.size() != 3)
        element.fail(fmt::format("<rgb> takes one or three numbers; got {}", v.size()));
    for (std::size_t i = 0; i < 3; ++i) color.rgb[i] = static_cast<float>(v[v.size() == 3 ? i : 0]);
    return color;
}

/// Wavelengths must increase and values be finite; `fail` reports.
void check_table(const ColorValue& color, const std::function<void(const std::string&)>& fail) {
    if (color.nm.size() < 2) fail("a spectrum needs at least two wavelengths");
    for (std::size_t i = 1; i < color.nm.size(); ++i)
        if (!(color.nm[i] > color.nm[i - 1]))
            fail(fmt::format("wavelengths must increase; {} nm follows {} nm", color.nm[i],
                             color.nm[i - 1]));
    for (const float v : color.values)
        if (v < 0.f) fail(fmt::format("a spectrum cannot be negative; got {}", v));
}

ColorValue tabulated(const XmlElement& element) {
    ColorValue color;
    color.kind = ColorValue::Kind::tabulated;
    // "400: 0.5" and "400:0.5" are the same pair.
    std::string text;
    for (const char c : element.get("value")) {
        if (c == ':')
            while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())))
                text.pop_back();
        if (text.ends_with(':') && std::isspace(static_cast<unsigned char>(c))) continue;
        text += c;
    }
    for (const std::string_view token : split_words(text)) {
        const std::size_t colon = token.find(':');
        if (colon == token.npos)
            element.fail(fmt::format("'{}' is not a pair 'wavelength:value'", token));
        color.nm.push_back(static_cast<float>(number(element, token.substr(0, colon))));
        color.values.push_back(static_cast<float>(number(element, token.substr(colon + 1))));
    }
    check_table(color, [&](const std::string& message) { element.fail(message); });
    return color;
}

ColorValue spectrum(const XmlElement& element, const ValueContext& context) {
    element.check_attributes({"name"}, {"value", "filename"});
    if (element.has("value") == element.has("filename"))
        element.fail("<spectrum> takes either 'value' or 'filename'");
    if (element.has("filename"))
        return read_spectrum_file(
            find_file(element.get("filename"), context.search_path, element.location.str()));
    if (element.get("value").find(':') != std::string::npos) return tabulated(element);
    ColorValue color;
    color.kind = ColorValue::Kind::constant;
    color.value = static_cast<float>(number_attribute(element, "value"));
    return color;
}

ColorValue blackbody(const XmlElement& element) {
    element.check_attributes({"name", "temperature"}, {"scale"});
    ColorValue color;
    color.kind = ColorValue::Kind::blackbody;
    std::string kelvin = element.get("temperature");
    if (kelvin.ends_with('K') || kelvin.ends_with('k')) kelvin.pop_back();
    color.kelvin = static_cast<float>(number(element, kelvin));
    color.value = element.has("scale") ? static_cast<float>(number_attribute(element, "scale")) : 1;
    if (!(color.kelvin > 0.f)) element.fail("the temperature of <blackbody> must be positive");
    if (!(color.value >= 0.f)) element.fail("the scale of <blackbody> cannot be negative");
    return color;
}

}  // namespace

const std::vector<std::string>& value_tags() {
    static const std::vector<std::string> tags = {"float",     "integer",  "boolean", "string",
                                                  "point",     "vector",   "rgb",     "spectrum",
                                                  "blackbody", "transform"};
    return tags;
}

bool is_value_tag(const std::string& tag) {
    return std::find(value_tags().begin(), value_tags().end(), tag) != value_tags().end();
}

SceneValue read_value(const XmlElement& element, const ValueContext& context) {
    const std::string& tag = element.tag;
    SceneValue out{element.get("name"), tag, 0.0, element.location};
    if (tag == "point" || tag == "vector") {
        element.check_attributes({"name"}, {"value", "x", "y", "z"});
        out.value = triple(element, 0.0);
    } else if (tag == "transform") {
        element.check_attributes({"name"});
        out.value = transform(element, context);
        return out;
    } else if (tag == "spectrum") {
        out.value = spectrum(element, context);
    } else if (tag == "blackbody") {
        out.value = blackbody(element);
    } else {
        element.check_attributes({"name", "value"});
        if (tag == "float") out.value = number_attribute(element, "value");
        if (tag == "integer") out.value = integer(element);
        if (tag == "boolean") out.value = boolean(element);
        if (tag == "string") out.value = element.get("value");
        if (tag == "rgb") out.value = rgb(element);
    }
    if (element.node.first_child()) element.fail(fmt::format("<{}> cannot hold anything", tag));
    if (auto* color = std::get_if<ColorValue>(&out.value)) color->location = element.location;
    return out;
}

ColorValue read_spectrum_file(const std::filesystem::path& file) {
    const auto text = read_whole_file(file);
    if (!text) throw InputError(fmt::format("{}: cannot be opened", file.string()));
    if (is_utf16(*text))
        throw InputError(fmt::format(
            "{}: is text in UTF-16, which is not read; save it as UTF-8 or ASCII", file.string()));
    ColorValue color;
    color.kind = ColorValue::Kind::tabulated;
    LineSplitter lines(*text);
    const auto fail = [&](const std::string& message) {
        throw InputError(fmt::format("{}:{}: {}", file.string(), lines.line(), message));
    };
    for (std::string_view line; lines.next(line);) {
        const auto tokens = split_words(without_comment(line), ", \t\r\n\v\f");
        if (tokens.empty()) continue;
        const auto nm = finite_number(tokens[0]);
        const auto value = tokens.size() == 2 ? finite_number(tokens[1]) : std::nullopt;
        if (!nm || !value) fail("expected a wavelength in nm and a value");
        color.nm.push_back(static_cast<float>(*nm));
        color.values.push_back(static_cast<float>(*value));
    }
    check_table(color, fail);
    return color;
}

}  // namespace nacre
