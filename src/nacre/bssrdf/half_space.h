#pragma once
// How much light a half space returns, by adding and doubling and not by a diffusion profile, none
// of which is right for all albedos.
#include "nacre/bssrdf/medium.h"

namespace nacre {

/// Within [0, 1]: what a half space returns of the even light that entered it, to about 1e-4
/// unless `nodes` says how many the quadrature has (AddingDoublingOptions). Henyey and Greenstein's
/// phase function.
double half_space_albedo(const ProfileMedium& medium, int nodes = 0);

}  // namespace nacre
