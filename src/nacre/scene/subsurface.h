#pragma once
// How light below the surface of a shape is to be approximated: <subsurface> of a scene file, or
// `nacre render --technique`. docs/subsurface.md tells what the techniques do.
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "nacre/scene/scene.h"

namespace nacre {

/// The technique and its options. Which names there are is known to those who build techniques and
/// profiles (subsurface/technique.h, bssrdf/profile.h): here they are words.
struct SubsurfaceSettings {
    std::string technique = "two_pass";
    std::string profile = "dipole";  ///< R(r); the type of the element
    /// "normalised": the transmittance at the exit is divided by its mean over directions, so that
    /// what the profile says leaves does leave. "paper": it is not (Jensen et al. 2001), and the
    /// share of light that the mean reflectance makes up is lost.
    std::string exit = "normalised";
    /// "auto": the single-scattering term is added to profiles that leave it out.
    std::string single_scattering = "auto";
    double spacing = 1.;  ///< of surface points, in transport mean free paths of the densest band
    double error = 0.2;   ///< largest solid angle of a group of points that counts as one, sr
    int irradiance_samples = 8;          ///< paths at each surface point
    std::string points = "elimination";  ///< how they are spread: elimination, repulsion, random
    /// Which of the object's lengths walks keep: "transport" or "diffuse" mean free path.
    std::string free_path = "transport";
    std::string where{};  ///< place in the file, for messages; may be empty

    /// "file:line:column: " or nothing.
    std::string prefix() const { return where.empty() ? "" : where + ": "; }
};

/// An option by its name: its value in words or a number within [low, high].
struct SubsurfaceOption {
    std::string_view name, meaning, words;  ///< `words`, separated by blanks, empty for numbers
    double low = 0., high = 0.;
    bool whole = false;
};
/// All options but technique and profile.
std::span<const SubsurfaceOption> subsurface_options();
/// Sets an option from text; throws InputError for unknown names and values outside the range.
void set_option(SubsurfaceSettings& settings, std::string_view name, std::string_view value);

/// Whether a technique can take the shape for a translucent object: its boundary refracts, smooth
/// or rough, or is not there, and it has a homogeneous medium inside.
bool is_translucent(const ShapeBinding& shape);
/// Index inside over outside of a translucent shape; 1 if nothing refracts.
float boundary_eta(const ShapeBinding& shape);

/// Has all translucent shapes of the scene rendered by the technique that `change` makes of their
/// settings: those of the scene file, or the defaults. Throws InputError if there are none.
void use_technique(Scene& scene, const std::function<void(SubsurfaceSettings&)>& change);

}  // namespace nacre
