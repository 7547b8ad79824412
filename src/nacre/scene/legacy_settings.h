#pragma once
// What <integrator type="legacy"> is told: which illumination models to shade with (room
// `illumination`), their parameters as spectra, and how lights become the I_L of those models.
#include <array>
#include <memory>
#include <vector>

#include "nacre/illumination/light_convention.h"
#include "nacre/illumination/models.h"
#include "nacre/scene/xml/scene_node.h"
#include "nacre/spectrum/spectrum.h"

namespace nacre {

/// An illumination model with its parameters, in the order of its description.
struct LegacyModel {
    using Values = illumination::Values<float, Spectral>;

    const illumination::Description* model = nullptr;
    std::array<float, Values::largest> numbers{};  ///< numbers and choices
    std::array<SpectrumPtr, Values::largest> spectra{};

    Values values(const Wavelengths& w) const;
};

struct LegacySettings {
    /// Model of each illumination::Part, in its order; without a description where none was named.
    std::array<LegacyModel, 4> models;

    illumination::LightConvention convention = illumination::LightConvention::physical;
    /// I_L of models without |L| in their formula: false, the light's radiant intensity wherever it
    /// stands; true, the irradiance that it brings to the point.
    bool inverse_square = false;
    SpectrumPtr ambient;              ///< I
    bool estimate_unblocked = false;  ///< find f of model 2 by rays
    bool surface_color = true;  ///< the surface's material colours ambient and diffuse reflection
    bool shadows = false;
    bool refraction = false;  ///< model 23: Snell's law instead of straight on
    SpectrumPtr absorption;   ///< inside refracting objects, 1 / scene unit
    float length_unit = 1.f;  ///< of |L| and |V|, in scene units

    const LegacyModel* find(illumination::Part part) const {
        const LegacyModel& m = models[static_cast<std::size_t>(part)];
        return m.model ? &m : nullptr;
    }
    bool is_spectral() const;
};

/// Reads `model` ("13", "phong", or several joined by +, at most one of each part), the parameters
/// of those models by their names, and the rest. Throws InputError with the place in the file.
std::shared_ptr<const LegacySettings> read_legacy(const SceneNode& node);

}  // namespace nacre
