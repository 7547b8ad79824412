#include "nacre/scene/xml/scene_node.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <limits>
#include <numeric>

namespace nacre {
namespace {

/// Lower case without separators, so that `toWorld`, `to-world` and `to_world` are the same word.
std::string folded(std::string_view word) {
    std::string out;
    for (const char c : word)
        if (c != '_' && c != '-' && c != ' ')
            out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return out;
}

/// Least number of insertions, deletions, replacements and swaps of neighbours (optimal string
/// alignment: F. J. Damerau 1964, CACM 7(3)).
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
    std::iota(last.begin(), last.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], before[j - 2] + 1);
        }
        std::swap(before, last);
        std::swap(last, row);
    }
    return last[b.size()];
}

bool is_color(const SceneValue& v) { return std::holds_alternative<ColorValue>(v.value); }

}  // namespace

std::string with_article(std::string_view noun) {
    const bool vowel = !noun.empty() && std::string_view("aeiou").find(noun[0]) != noun.npos;
    // "rgb" is spoken letter by letter and so begins with a vowel.
    return fmt::format("{} {}", vowel || noun == "rgb" ? "an" : "a", noun);
}

std::string nearest_name(std::string_view word, const std::vector<std::string>& known) {
    const std::string wanted = folded(word);
    std::string best;
    std::size_t best_distance = std::numeric_limits<std::size_t>::max();
    for (const std::string& name : known) {
        const std::string candidate = folded(name);
        std::size_t distance = edit_distance(wanted, candidate);
        // A word cut short, such as `gauss` for `gaussian`, is plausible as well.
        if (wanted.size() >= 3 && candidate.starts_with(wanted))
            distance = std::min<std::size_t>(distance, 2);
        // A third of the letters may be wrong; beyond that the suggestion would puzzle.
        const std::size_t allowed =
            std::max<std::size_t>(std::max(wanted.size(), candidate.size()) / 3, 1);
        if (distance <= allowed && distance < candidate.size() && distance < best_distance) {
            best = name;
            best_distance = distance;
        }
    }
    return best;
}

std::string suggestion(std::string_view word, const std::vector<std::string>& known) {
    if (const std::string near = nearest_name(word, known); !near.empty())
        return fmt::format("; did you mean '{}'?", near);
    return known.empty() ? std::string() : fmt::format("; known are: {}", fmt::join(known, ", "));
}

std::string SourceLocation::str() const {
    return fmt::format("{}:{}:{}", file ? *file : std::string("scene"), line, column);
}

std::string SceneNode::describe() const {
    return type.empty() ? fmt::format("<{}>", tag) : fmt::format("<{} type=\"{}\">", tag, type);
}

const SceneValue* SceneNode::find(std::string_view name) const {
    known_.emplace(name);
    const auto at = std::find_if(values.begin(), values.end(),
                                 [&](const SceneValue& v) { return v.name == name; });
    return at == values.end() ? nullptr : &*at;
}

void SceneNode::fail(const std::string& message) const {
    throw InputError(location.str() + ": " + message);
}

void SceneNode::fail_at(std::string_view name, const std::string& message) const {
    for (const SceneValue& v : values)
        if (v.name == name) throw InputError(v.location.str() + ": " + message);
    for (const Child& c : children)
        if (!name.empty() && c.name == name) throw InputError(c.location.str() + ": " + message);
    fail(message);
}

void SceneNode::fail_type(const SceneValue& value, std::string_view expected) const {
    throw InputError(fmt::format("{}: '{}' of {} is {}, but {} was expected", value.location.str(),
                                 value.name, describe(), with_article(value.tag),
                                 with_article(expected)));
}

void SceneNode::fail_missing(std::string_view name, std::string_view expected) const {
    for (const Child& c : children)
        if (c.name == name)
            throw InputError(fmt::format("{}: '{}' of {} is {}, but {} was expected",
                                         c.location.str(), name, describe(), c.node->describe(),
                                         with_article(expected)));
    fail(fmt::format("{} needs {} '{}'", describe(), with_article(expected), name));
}

bool SceneNode::has(std::string_view name) const {
    return find(name) || std::any_of(children.begin(), children.end(),
                                     [&](const Child& c) { return c.name == name; });
}

double SceneNode::get_float(std::string_view name) const {
    const SceneValue* v = find(name);
    if (!v) fail_missing(name, "float");
    if (const auto* number = std::get_if<double>(&v->value)) return *number;
    if (const auto* number = std::get_if<std::int64_t>(&v->value))
        return static_cast<double>(*number);
    fail_type(*v, "float");
}

double SceneNode::get_float(std::string_view name, double otherwise) const {
    return find(name) ? get_float(name) : otherwise;
}

double SceneNode::get_float_in(std::string_view name, double otherwise, double low,
                               double high) const {
    const double value = get_float(name, otherwise);
    if (!(value >= low && value <= high))
        fail_at(name, fmt::format("'{}' of {} must lie within [{}, {}]; got {}", name, describe(),
                                  low, high, value));
    return value;
}

std::int64_t SceneNode::get_int(std::string_view name, std::int64_t otherwise) const {
    const SceneValue* v = find(name);
    if (!v) return otherwise;
    if (const auto* number = std::get_if<std::int64_t>(&v->value)) return *number;
    fail_type(*v, "integer");
}

bool SceneNode::get_bool(std::string_view name, bool otherwise) const {
    const SceneValue* v = find(name);
    if (!v) return otherwise;
    if (const auto* flag = std::get_if<bool>(&v->value)) return *flag;
    fail_type(*v, "boolean");
}

std::string SceneNode::get_string(std::string_view name) const {
    const SceneValue* v = find(name);
    if (!v) fail_missing(name, "string");
    if (const auto* text = std::get_if<std::string>(&v->value)) return *text;
    fail_type(*v, "string");
}

std::string SceneNode::get_string(std::string_view name, std::string_view otherwise) const {
    return find(name) ? get_string(name) : std::string(otherwise);
}

Vec3d SceneNode::get_vector(std::string_view name, const Vec3d& otherwise) const {
    const SceneValue* v = find(name);
    if (!v) return otherwise;
    if (const auto* vector = std::get_if<Vec3d>(&v->value)) return *vector;
    fail_type(*v, "vector");
}

Transform SceneNode::get_transform(std::string_view name) const {
    const SceneValue* v = find(name);
    if (!v) return {};
    if (const auto* transform = std::get_if<Transform>(&v->value)) return *transform;
    fail_type(*v, "transform");
}

const ColorValue* SceneNode::get_color(std::string_view name) const {
    const SceneValue* v = find(name);
    if (!v) return nullptr;
    if (is_color(*v)) return &std::get<ColorValue>(v->value);
    if (!std::holds_alternative<double>(v->value) &&
        !std::holds_alternative<std::int64_t>(v->value))
        fail_type(*v, "colour");
    ColorValue constant;
    constant.kind = ColorValue::Kind::constant;
    constant.value = static_cast<float>(get_float(name));
    constant.location = v->location;
    return &constants_.try_emplace(std::string(name), constant).first->second;
}

std::string SceneNode::get_choice(std::string_view name,
                                  const std::vector<std::string>& choices) const {
    if (!find(name)) return choices.front();
    const std::string word = get_string(name);
    if (std::find(choices.begin(), choices.end(), word) == choices.end())
        fail_at(name, fmt::format("'{}' of {} cannot be '{}'{}", name, describe(), word,
                                  suggestion(word, choices)));
    return word;
}

const SceneNode::Child* SceneNode::child(std::string_view name, std::string_view wanted) const {
    if (!name.empty()) known_.emplace(name);
    for (const Child& c : children) {
        if (c.name != name || (!wanted.empty() && c.node->tag != wanted)) continue;
        used_children_.insert(&c);
        return &c;
    }
    return nullptr;
}

std::vector<const SceneNode::Child*> SceneNode::children_of(std::string_view wanted) const {
    std::vector<const Child*> found;
    for (const Child& c : children) {
        if (c.node->tag != wanted) continue;
        used_children_.insert(&c);
        found.push_back(&c);
    }
    return found;
}

void SceneNode::check_all_used() const {
    const std::vector<std::string> known(known_.begin(), known_.end());
    for (const SceneValue& v : values)
        if (!known_.contains(v.name))
            throw InputError(fmt::format("{}: {} has no parameter '{}'{}", v.location.str(),
                                         describe(), v.name, suggestion(v.name, known)));
    for (const Child& c : children) {
        if (used_children_.contains(&c)) continue;
        if (c.name.empty() || known_.contains(c.name))
            throw InputError(fmt::format("{}: {} cannot hold {}{}", c.location.str(), describe(),
                                         c.node->describe(),
                                         c.name.empty() ? "" : " as '" + c.name + "'"));
        throw InputError(fmt::format("{}: {} has no parameter '{}'{}", c.location.str(), describe(),
                                     c.name, suggestion(c.name, known)));
    }
}

}  // namespace nacre
