#pragma once
// The illumination models 1-23 by number or name: their descriptions, and their values with
// parameters given at run time. Who knows the model at compile time uses its struct (all_models.h).
#include <array>

#include "nacre/catalogue/catalogue.h"
#include "nacre/illumination/lighting.h"

namespace nacre::illumination {

/// All of them, in the order of their numbers; they are found by number ("13") and by name.
const Catalogue<Description>& models();

/// Values in the order of the description: spectra as P, numbers as D, choices as int.
template <class D, class P = D>
struct Values {
    static constexpr std::size_t largest = 8;  ///< more parameters than any model has
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
        if (model.parameters[i].kind == ParameterKind::spectrum)
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
