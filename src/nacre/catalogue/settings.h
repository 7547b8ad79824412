#pragma once
// What parameters are set to: settings as they come from text, scenes and programs, and the values
// that they become, checked against the descriptions of the parameters.
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "nacre/catalogue/parameter.h"
#include "nacre/math/vec.h"

namespace nacre {

class Spectrum;

/// A number, a word (of a choice, or a number as text), linear RGB, or a spectrum.
using SettingValue = std::variant<double, std::string, Vec3f, std::shared_ptr<const Spectrum>>;
struct Setting {
    std::string name;
    SettingValue value;

    friend bool operator==(const Setting&, const Setting&) = default;
};
using Settings = std::vector<Setting>;

/// Settings from text: "variant=duer alpha=0.2 ks=0.1,0.3,0.2"; three numbers are a linear RGB
/// colour. Throws InputError if something is not name=value.
Settings parse_settings(std::string_view text);
/// One of them, "alpha=0.2".
Setting parse_setting(std::string_view text);
/// The text that parse_settings reads as the same settings, every number with the digits that it
/// takes. A spectrum has no such text: "(spectrum)".
std::string settings_text(const Settings& settings);

/// One value for each of some parameters: what settings say, else the defaults.
class ParameterValues {
  public:
    struct Value {
        double number = 0.;                        ///< of a choice, its position
        std::shared_ptr<const Spectrum> spectrum;  ///< instead of the number, if given
        std::string given;                         ///< the name it was set under; empty: default
    };

    ParameterValues() = default;
    /// `owner` is whose parameters they are, which errors begin with; it and the parameters outlive
    /// the values. Throws InputError for unknown names and words, one given twice, a value of the
    /// wrong kind or out of range: "ward: alpha = 2 is out of range: must lie within (0, 1]".
    ParameterValues(std::string_view owner, std::span<const Parameter> parameters,
                    const Settings& settings = {});

    // By name. Names that are no parameter's, and kinds that are not asked for right, are mistakes
    // of the program: std::logic_error.

    /// Of a scalar, integer, wavelength or constant spectrum.
    double number(std::string_view name) const;
    /// Of an integer.
    int whole(std::string_view name) const;
    /// Of a choice, as the enum whose order is that of the choices.
    template <class Enum>
    Enum choice(std::string_view name) const {
        return static_cast<Enum>(position(name));
    }
    /// Of a choice, its name.
    std::string_view word(std::string_view name) const;
    /// Whether a setting says it, under whatever name; else it has its default.
    bool given(std::string_view name) const;

    // By position, in the order of the parameters.

    std::size_t size() const { return values_.size(); }
    const Value& operator[](std::size_t i) const { return values_[i]; }
    std::span<const Parameter> parameters() const { return parameters_; }

  private:
    void set(std::size_t i, const Setting& setting);
    double number_of(const Parameter& parameter, const SettingValue& value) const;
    std::size_t index(std::string_view name) const;
    int position(std::string_view name) const;

    std::string_view owner_;
    std::span<const Parameter> parameters_;
    std::vector<Value> values_;
};

}  // namespace nacre
