// The smallest program that uses the library: transmittance of 0, 1, 2 and 3 mm of a medium with
// sigma_t = 1/mm.
#include <nacre/math/lanes_math.h>

#include <cmath>
#include <cstdio>

int main() {
    const nacre::Spectral transmittance = nacre::exp(nacre::Spectral(0, -1, -2, -3));
    std::printf("transmittance %.4f %.4f\n", transmittance[0], transmittance[1]);
    return std::abs(transmittance[1] - 0.367879f) < 1e-5f ? 0 : 1;
}
