#pragma once
// What slab_walk.cpp computes on: packs of photons, their layers, Fresnel for packs.
#include "nacre/layers/slab_walk.h"
#include "nacre/math/fast_wide.h"

namespace nacre::slab {

// One register: g++ 12 takes packs of more than one apart, lane by lane, where masks are involved.
#if defined(__AVX512F__)
inline constexpr int width = 16;
#else
inline constexpr int width = 8;
#endif
using Pack = Lanes<float, width>;
using Where = Mask<float, width>;
inline constexpr std::uint32_t all_lanes = ~0u >> (32 - width);

/// Sums of packs in double.
class WideSum {
  public:
    void add(Pack p) { sum_ += __builtin_convertvector(p.v, Doubles); }
    double total() const {
        double t = 0.;
        for (int i = 0; i < width; ++i) t += sum_[i];
        return t;
    }

  private:
    typedef double Doubles __attribute__((vector_size(8 * width)));
    Doubles sum_{};
};

inline Pack positive_sqrt(Pack x) { return fast_sqrt(max(x, Pack(0.f))); }
inline Pack copysign(Pack magnitude, Pack sign) {
    return select(sign < Pack(0.f), -magnitude, magnitude);
}

/// WalkLayer of the layer that each lane is in.
struct LayerPacks {
    Pack tau, absorb, g, eta_up, eta_down, length, clear, top_bin, depth_bins;

    void set(int lane, const WalkLayer& l) {
        tau.set(lane, l.tau);
        absorb.set(lane, l.absorb);
        g.set(lane, l.g);
        eta_up.set(lane, l.eta_up);
        eta_down.set(lane, l.eta_down);
        length.set(lane, l.length);
        clear.set(lane, l.clear);
        top_bin.set(lane, l.top_bin);
        depth_bins.set(lane, l.depth_bins);
    }
};

/// Fresnel's reflectance for the near side's cosine c, and the cosine behind the interface. The
/// form (eta^2 - 1) + c^2 is exact at eta = 1, where grazing light must pass; g = 0, total
/// reflection, gives exactly 1.
struct Crossing {
    Pack reflectance, cosine;
};

[[gnu::always_inline]] inline Crossing cross(Pack c, Pack eta) {
    const Pack one(1.f), e2 = eta * eta;
    const Pack g = positive_sqrt((eta - one) * (eta + one) + c * c);
    const Pack b = c + g, q = e2 * c + g, bq = b * q;
    const Pack s = (c - g) * q, p = (e2 * c - g) * b;
    const Pack r = Pack(0.5f) * (s * s + p * p) / max(bq * bq, Pack(1e-30f));
    return {r, g / eta};
}

}  // namespace nacre::slab
