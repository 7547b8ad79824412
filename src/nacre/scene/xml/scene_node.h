#pragma once
// One object of a scene file (<bsdf type="diffuse">...), read but not yet built: its parameters
// with their place in the file. Whoever builds the object asks for the parameters it knows; what
// nobody asked for is an error, so a misspelt parameter never passes silently.
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "nacre/geometry/transform.h"
#include "nacre/math/error.h"

namespace nacre {

/// Where something stands in a file; `column` counts from 1.
struct SourceLocation {
    std::shared_ptr<const std::string> file;
    int line = 0, column = 0;
    /// "file:line:column"
    std::string str() const;
};

/// A colour or spectrum as written, before its role (reflectance, light, coefficient) is known.
struct ColorValue {
    enum class Kind { rgb, constant, tabulated, blackbody } kind = Kind::rgb;
    Vec3f rgb{};                    ///< rgb
    float value = 0.f;              ///< constant: the value; blackbody: the scale
    float kelvin = 0.f;             ///< blackbody
    std::vector<float> nm, values;  ///< tabulated
    SourceLocation location{};      ///< for messages; empty if made in memory
};

/// A parameter of an object.
struct SceneValue {
    std::string name;
    std::string tag;  ///< float, integer, boolean, string, point, vector, transform, rgb, spectrum,
                      ///< blackbody
    std::variant<double, std::int64_t, bool, std::string, Vec3d, Transform, ColorValue> value;
    SourceLocation location;
};

class SceneNode;
using SceneNodePtr = std::shared_ptr<const SceneNode>;

class SceneNode {
  public:
    std::string tag;   ///< scene, bsdf, shape, emitter, sensor, film, rfilter, sampler, integrator,
                       ///< medium, phase, volume, texture, subsurface
    std::string type;  ///< the attribute `type`
    std::string id;    ///< the attribute `id`, may be empty
    SourceLocation location;
    std::vector<SceneValue> values;
    /// Nested objects with the name under which they were given (may be empty); a <ref> is the
    /// object itself.
    struct Child {
        std::string name;
        SceneNodePtr node;
        SourceLocation location;  ///< of the child or of the <ref>
    };
    std::vector<Child> children;

    // Each getter marks the parameter as known. The first form requires it, the second has a
    // default; a value of another type is an error that names both types (integers are accepted
    // where floats are asked for, and where integers are asked for only integers).
    bool has(std::string_view name) const;
    double get_float(std::string_view name) const;
    double get_float(std::string_view name, double otherwise) const;
    std::int64_t get_int(std::string_view name, std::int64_t otherwise) const;
    bool get_bool(std::string_view name, bool otherwise) const;
    std::string get_string(std::string_view name) const;
    std::string get_string(std::string_view name, std::string_view otherwise) const;
    Vec3d get_vector(std::string_view name, const Vec3d& otherwise) const;  ///< point or vector
    Transform get_transform(std::string_view name) const;                   ///< identity if absent
    /// rgb, spectrum, blackbody, or a float (a constant); null if absent.
    const ColorValue* get_color(std::string_view name) const;
    /// One of the words in `choices`, or the first of them if absent; another word is an error with
    /// a suggestion.
    std::string get_choice(std::string_view name, const std::vector<std::string>& choices) const;
    /// A float within [low, high], else an error that states the range.
    double get_float_in(std::string_view name, double otherwise, double low, double high) const;

    /// The child of that name (and tag, if not empty), marked as known; null if absent.
    const Child* child(std::string_view name, std::string_view tag = {}) const;
    /// All children with a tag, marked as known.
    std::vector<const Child*> children_of(std::string_view tag) const;

    /// Throws an InputError "file:line:column: message".
    [[noreturn]] void fail(const std::string& message) const;
    /// The same at the place of a parameter.
    [[noreturn]] void fail_at(std::string_view name, const std::string& message) const;
    /// Throws if a parameter or child was never asked for, naming it and the nearest known name.
    void check_all_used() const;
    /// How messages name the object: `<bsdf type="diffuse">`.
    std::string describe() const;

  private:
    const SceneValue* find(std::string_view name) const;
    [[noreturn]] void fail_type(const SceneValue& value, std::string_view expected) const;
    [[noreturn]] void fail_missing(std::string_view name, std::string_view expected) const;

    mutable std::set<std::string, std::less<>> known_;  ///< names asked for, for suggestions
    mutable std::set<const Child*> used_children_;
    mutable std::map<std::string, ColorValue, std::less<>> constants_;  ///< floats as colours
};

}  // namespace nacre
