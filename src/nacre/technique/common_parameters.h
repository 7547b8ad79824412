#pragma once
// Parameters that several techniques have, and what they come to.
#include <initializer_list>

#include "nacre/render/profile_tables.h"
#include "nacre/technique/path_technique.h"

namespace nacre {

/// "profile", the diffusion profile R(r): any, or one of those named.
Parameter profile_parameter(std::initializer_list<std::string_view> only = {});
/// "exit_fresnel". "normalised": the transmittance at the exit is divided by its mean over
/// directions, so that what the profile says leaves does leave. "paper": it is not (Jensen et al.
/// 2001), and the share of light that the mean reflectance makes up is lost.
Parameter exit_fresnel_parameter();
/// "single_scattering": on, off, or "auto", added to profiles that leave it out.
Parameter single_scattering_parameter();
enum class SingleScatteringChoice { automatic, on, off };

/// What leaves is multiplied by it: 1 ("paper", and techniques without that parameter) or 1 over
/// the boundary's mean transmittance.
float exit_scale(const ShapeInput& in);
/// R(r) of the shape's profile, behind its boundary.
std::shared_ptr<const ProfileTables> profile_tables(const ShapeInput& in);

}  // namespace nacre
