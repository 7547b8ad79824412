#pragma once
// The interfaces of a stack: indices of refraction, and light that passes without being scattered.
#include <vector>

#include "nacre/layers/layer.h"

namespace nacre {

/// Indices from the medium above over the layers' to the medium below. An infinitely thick clear
/// last layer is the medium below, since nothing comes back from it.
std::vector<double> media_indices(const LayerStack& stack);

struct UnscatteredLight {
    double specular = 0.;     ///< reflected by the first surface
    double reflectance = 0.;  ///< by all interfaces, `specular` included
    double transmittance = 0.;
};

/// A beam at `cosine` outside, in (0, 1], with all reflections between the interfaces.
UnscatteredLight unscattered_light(const LayerStack& stack, double cosine);

}  // namespace nacre
