#pragma once
// Indices of refraction as parameters of materials.
#include "nacre/optics/dispersion.h"
#include "nacre/scene/build.h"

namespace nacre {

/// The index named by parameter `name` of `node`, `otherwise` (a material's name) if absent:
///   a number; a name, whose index does not depend on wavelength, as in Mitsuba ("bk7");
///   "dispersive bk7": the measured dispersion of a material;
///   "cauchy a b [c]", "sellmeier b1 b2 b3 c1 c2 c3": formulas of dispersion.h;
///   a tabulated <spectrum>.
DielectricIndex get_index(const SceneNode& node, std::string_view name, std::string_view otherwise);

/// The index inside a boundary over that outside of it.
class RelativeIndex {
  public:
    /// Reads int_ior and ext_ior.
    RelativeIndex(const SceneNode& node, std::string_view inside, std::string_view outside = "air");

    bool is_dispersive() const { return dispersive_; }
    /// In each lane; in RGB bands all are alike.
    Spectral eval(const Wavelengths& w) const {
        return dispersive_ && w.mode == ColorMode::spectral ? inside_.eval(w) / outside_.eval(w)
                                                            : Spectral(nominal_);
    }
    /// At the sodium D lines.
    float nominal() const { return nominal_; }

  private:
    DielectricIndex inside_, outside_;
    float nominal_;
    bool dispersive_;
};

/// The same as one number; throws if it depends on wavelength.
float get_relative_index(const SceneNode& node, std::string_view inside);

}  // namespace nacre
