#include "nacre/bssrdf/half_space.h"

#include <algorithm>
#include <limits>

#include "nacre/layers/adding_doubling.h"

namespace nacre {

double half_space_albedo(const ProfileMedium& m, int nodes) {
    const LayerStack half_space{{{.sigma_s = m.sigma_s,
                                  .sigma_a = m.sigma_a,
                                  .g = m.g,
                                  .thickness = std::numeric_limits<double>::infinity(),
                                  .eta = m.eta}},
                                1.,
                                m.eta};
    const double cosine[] = {1.};
    const LayerTotals t = adding_doubling(half_space, cosine, {}, {.nodes = nodes}).diffuse;
    return std::clamp((t.reflectance - t.specular) / (1. - t.specular), 0., 1.);
}

}  // namespace nacre
