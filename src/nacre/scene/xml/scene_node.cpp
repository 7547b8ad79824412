#include "nacre/scene/xml/scene_node.h"

#include <fmt/format.h>

#include <algorithm>

#include "nacre/text/names.h"

namespace nacre {
namespace {

bool is_color(const SceneValue& v) { return std::holds_alternative<ColorValue>(v.value); }

}  // namespace

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
