#pragma once
// From what artists choose, a surface colour and a distance, to the coefficients of the medium.
//
//   H. W. Jensen, J. Buhler 2002, A Rapid Hierarchical Rendering Technique for Translucent
//   Materials, SIGGRAPH 2002: the total of the dipole grows with alpha' alone and is inverted for
//   it; from the diffuse mean free path l_d = 1 / sigma_tr then follows
//   sigma_t' = 1 / (l_d sqrt(3 (1 - alpha'))).
//
// A widely copied implementation writes sqrt(3 - alpha') for that root, a slip of precedence. Here
// any radial profile whose total depends on alpha' and eta alone serves; sigma_tr is the profile's
// own.
#include <string_view>

#include "nacre/bssrdf/profile.h"

namespace nacre {

/// Which distance is given.
enum class FreePath {
    transport,  ///< 1 / sigma_t'
    diffuse,    ///< 1 / sigma_tr
};

/// The isotropic medium (g = 0) whose `profile` has the total `albedo` in [0, 1), the share of the
/// light that entered which comes back, and the given mean free path (mm, > 0). The total is met to
/// 1e-10 or so. Throws InputError for numbers out of range, an unknown profile or option, a profile
/// that does not depend on the medium, and an albedo beyond what the profile reaches at alpha' = 1.
ProfileMedium invert_albedo(std::string_view profile, double albedo, double free_path,
                            FreePath kind, double eta, const Settings& options = {});

}  // namespace nacre
