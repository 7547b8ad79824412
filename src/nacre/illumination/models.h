#pragma once
// The illumination models 1-23 by number or name: their descriptions, and their values with
// parameters given at run time. Who knows the model at compile time uses its struct (all_models.h).
#include <array>
#include <string>

#include "nacre/illumination/lighting.h"

namespace nacre::illumination {

/// All descriptions, in the order of their numbers.
std::span<const Description* const> descriptions();

/// The model called `name`, which may be its number ("13") or its name, compared without regard to
/// case, blanks, dashes and underscores. Throws InputError with the nearest name.
const Description& find_model(std::string_view name);

/// "within [0, 1]", "greater than 0", "one of ..."
std::string range_text(const Parameter& parameter);
/// Throws InputError, naming model, parameter, value and range, if `value` is outside (or NaN).
void check_value(const Description& model, const Parameter& parameter, double value);
/// The position of `word` in the parameter's choices; throws InputError likewise.
int find_choice(const Description& model, const Parameter& parameter, std::string_view word);

/// Values in the order of the description: spectra as P, numbers as D, choices as int.
template <class D, class P = D>
struct Values {
    static constexpr std::size_t largest = 8;
    std::array<D, largest> numbers{};
    std::array<P, largest> spectra{};

    /// The defaults of `model`.
    static Values defaults(const Description& model) {
        Values v;
        for (std::size_t i = 0; i < model.parameters.size(); ++i)
            v.set(model, i, model.parameters[i].otherwise);
        return v;
    }
    void set(const Description& model, std::size_t i, double value) {
        if (model.parameters[i].kind == Parameter::Kind::spectrum)
            spectra[i] = P(value);
        else
            numbers[i] = D(value);
    }
    D number(std::size_t i) const { return numbers[i]; }
    P spectrum(std::size_t i) const { return spectra[i]; }
    int choice(std::size_t i) const { return static_cast<int>(numbers[i]); }
};

/// Intensity I of models 1-20. D, P: float and Spectral, float and float, double and double.
template <class D, class P>
Product<D, P> intensity(const Description& model, const Values<D, P>& values,
                        const Lighting<D, P>& at);

/// Share k_t of light that models 21-23 let pass straight on.
template <class D, class P>
Product<D, P> transmittance(const Description& model, const Values<D, P>& values,
                            const Vec3<D>& wo);

}  // namespace nacre::illumination
