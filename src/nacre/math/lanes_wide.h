#pragma once
// Packs as wide as the processor's registers, with elementary functions inlined: for bulk
// evaluation over directions. Brings the headers of the SIMD library, so only the few files that
// evaluate in bulk include it.
#pragma GCC diagnostic push
// g++ 12 takes the deliberately undefined registers of its own AVX-512 headers for mistakes.
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#include <xsimd/xsimd.hpp>
#pragma GCC diagnostic pop

#include "nacre/math/lanes.h"

namespace nacre {

namespace wide_detail {

#if defined(__AVX512F__) && !defined(__OPTIMIZE__)
// xsimd 8 does not compile for AVX-512 without optimisation: g++'s intrinsics are macros then, with
// casts that a pack does not take.
using Batch = xsimd::batch<float, xsimd::avx2>;
#else
using Batch = xsimd::batch<float>;
#endif

}  // namespace wide_detail

/// 16 floats with AVX-512, 8 with AVX2.
using Wide = Lanes<float, int(wide_detail::Batch::size)>;

namespace wide_detail {

inline Batch batch(Wide x) { return Batch(reinterpret_cast<Batch::register_type>(x.v)); }
inline Wide wide(Batch b) { return Wide::from(reinterpret_cast<Wide::Native>(b.data)); }

}  // namespace wide_detail

inline Wide sqrt(Wide x) { return wide_detail::wide(xsimd::sqrt(wide_detail::batch(x))); }
inline Wide exp(Wide x) { return wide_detail::wide(xsimd::exp(wide_detail::batch(x))); }
inline Wide log(Wide x) { return wide_detail::wide(xsimd::log(wide_detail::batch(x))); }
inline Wide log1p(Wide x) { return wide_detail::wide(xsimd::log1p(wide_detail::batch(x))); }
inline Wide expm1(Wide x) { return wide_detail::wide(xsimd::expm1(wide_detail::batch(x))); }
inline Wide sin(Wide x) { return wide_detail::wide(xsimd::sin(wide_detail::batch(x))); }
inline Wide cos(Wide x) { return wide_detail::wide(xsimd::cos(wide_detail::batch(x))); }
inline Wide tan(Wide x) { return wide_detail::wide(xsimd::tan(wide_detail::batch(x))); }
inline Wide acos(Wide x) { return wide_detail::wide(xsimd::acos(wide_detail::batch(x))); }
inline Wide erf(Wide x) { return wide_detail::wide(xsimd::erf(wide_detail::batch(x))); }
inline Wide erfc(Wide x) { return wide_detail::wide(xsimd::erfc(wide_detail::batch(x))); }
inline Wide atan2(Wide y, Wide x) {
    return wide_detail::wide(xsimd::atan2(wide_detail::batch(y), wide_detail::batch(x)));
}
// xsimd 8 has neither of the next two for every processor.

/// 1 / sqrt(x) for x > 0, off by 4e-4 at most (7e-5 with AVX-512), at a fraction of its price.
inline Wide fast_rsqrt(Wide x) {
#if defined(__AVX512F__) && defined(__OPTIMIZE__)
    return wide_detail::wide(_mm512_rsqrt14_ps(wide_detail::batch(x)));
#else
    return wide_detail::wide(_mm256_rsqrt_ps(wide_detail::batch(x)));
#endif
}
/// Bit i is set where a > b in lane i.
inline std::uint32_t greater_bits(Wide a, Wide b) {
#if defined(__AVX512F__) && defined(__OPTIMIZE__)
    return _mm512_cmp_ps_mask(wide_detail::batch(a), wide_detail::batch(b), _CMP_GT_OQ);
#else
    return std::uint32_t(_mm256_movemask_ps(
        _mm256_cmp_ps(wide_detail::batch(a), wide_detail::batch(b), _CMP_GT_OQ)));
#endif
}
/// x^y for x > 0 (0 for x <= 0), with the error of y log x.
inline Wide pow(Wide x, Wide y) {
    const Wide r = exp(y * log(select(x > Wide(0.f), x, Wide(1.f))));
    return select(x > Wide(0.f), r, Wide(0.f));
}

}  // namespace nacre
