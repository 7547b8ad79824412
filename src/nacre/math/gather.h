#pragma once
// Numbers of a table for each lane of a pack, for inner loops over many directions. Brings the headers
// of the processor's intrinsics.
#include "nacre/math/fast_wide.h"

namespace nacre {

/// Positions in a table, one a lane.
template <int N>
using IntLanes = typename Mask<float, N>::Native;

/// table[at] of each lane.
template <int N>
Lanes<float, N> gather(const float* table, IntLanes<N> at) {
    Lanes<float, N> r;
#if defined(__AVX512F__)
    if constexpr (N == 16) {
        const __m512 part = _mm512_i32gather_ps(__builtin_bit_cast(__m512i, at), table, 4);
        return Lanes<float, N>::from(__builtin_bit_cast(typename Lanes<float, N>::Native, part));
    }
#endif
    for (int i = 0; i < N; ++i) r.v[i] = table[at[i]];
    return r;
}

template <int N>
struct LanePair {
    Lanes<float, N> first, second;
};
/// table[at] and table[at + 1]: what lies side by side comes by one look.
template <int N>
LanePair<N> gather_pair(const float* table, IntLanes<N> at) {
#if defined(__AVX512F__)
    if constexpr (N == 16) {
        using Native = typename Lanes<float, N>::Native;
        const __m512i where = __builtin_bit_cast(__m512i, at);
        const __m512 low = _mm512_castpd_ps(
                         _mm512_i32gather_pd(_mm512_castsi512_si256(where), table, 4)),
                     high = _mm512_castpd_ps(
                         _mm512_i32gather_pd(_mm512_extracti64x4_epi64(where, 1), table, 4));
        const __m512i even =
            _mm512_setr_epi32(0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
        const __m512i odd = _mm512_add_epi32(even, _mm512_set1_epi32(1));
        const auto pack = [](__m512 v) {
            return Lanes<float, N>::from(__builtin_bit_cast(Native, v));
        };
        return {pack(_mm512_permutex2var_ps(low, even, high)),
                pack(_mm512_permutex2var_ps(low, odd, high))};
    }
#endif
    return {gather<N>(table, at), gather<N>(table + 1, at)};
}

template <int N>
IntLanes<N> to_ints(Lanes<float, N> x) {
    return __builtin_convertvector(x.v, IntLanes<N>);
}
template <int N>
Lanes<float, N> to_floats(IntLanes<N> i) {
    return Lanes<float, N>::from(__builtin_convertvector(i, typename Lanes<float, N>::Native));
}

/// Of numbers that an int holds.
template <int N>
Lanes<float, N> floor(Lanes<float, N> x) {
    const Lanes<float, N> whole = to_floats<N>(to_ints(x));
    return select(whole > x, whole - Lanes<float, N>(1.f), whole);
}

}  // namespace nacre
