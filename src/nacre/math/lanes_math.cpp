#include "nacre/math/lanes_math.h"

#include <xsimd/xsimd.hpp>

namespace nacre {

namespace {

// Four floats are one SSE register on every x86-64 processor.
using Batch = xsimd::batch<float, xsimd::sse2>;

Batch to_batch(Spectral x) { return Batch(reinterpret_cast<__m128>(x.v)); }
Spectral from_batch(Batch b) { return Spectral::from(reinterpret_cast<Spectral::Native>(b.data)); }

}  // namespace

Spectral exp(Spectral x) { return from_batch(xsimd::exp(to_batch(x))); }
Spectral log(Spectral x) { return from_batch(xsimd::log(to_batch(x))); }
Spectral pow(Spectral x, Spectral y) { return from_batch(xsimd::pow(to_batch(x), to_batch(y))); }
Spectral sin(Spectral x) { return from_batch(xsimd::sin(to_batch(x))); }
Spectral cos(Spectral x) { return from_batch(xsimd::cos(to_batch(x))); }

}  // namespace nacre
