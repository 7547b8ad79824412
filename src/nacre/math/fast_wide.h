#pragma once
// Cheap functions of packs for inner loops that walk many photons at once: the polynomials of
// fast.h, random numbers, and masks as bits. Brings the headers of the processor's intrinsics, so
// only the few files with such loops include it.
#include <bit>
#include <cstdint>
#if defined(__AVX2__)
#pragma GCC diagnostic push
// g++ 12 takes the deliberately undefined registers of its own AVX-512 headers for mistakes.
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#include <immintrin.h>
#pragma GCC diagnostic pop
#endif

#include "nacre/math/lanes.h"
#include "nacre/math/random.h"

namespace nacre {

/// A pack's lanes as bits.
template <int N>
struct BitLanes {
    typedef std::uint32_t Native __attribute__((vector_size(4 * N)));
};

/// One bit a lane, lane 0 lowest.
template <int N>
std::uint32_t bits(Mask<float, N> m) {
    static_assert(N % 8 == 0 && N <= 32);
    std::uint32_t r = 0;
#if defined(__AVX512F__)
    if constexpr (N % 16 == 0) {
        for (int i = 0; i < N / 16; ++i) {
            __m512i part;
            __builtin_memcpy(&part, reinterpret_cast<const char*>(&m.v) + 64 * i, sizeof part);
            r |= std::uint32_t(_mm512_test_epi32_mask(part, part)) << (16 * i);
        }
        return r;
    }
#endif
#if defined(__AVX2__)
    for (int i = 0; i < N / 8; ++i) {
        __m256 part;
        __builtin_memcpy(&part, reinterpret_cast<const char*>(&m.v) + 32 * i, sizeof part);
        r |= std::uint32_t(_mm256_movemask_ps(part)) << (8 * i);
    }
#else
    for (int i = 0; i < N; ++i) r |= std::uint32_t(m[i]) << i;
#endif
    return r;
}

/// The lanes whose bits are set.
template <int N>
Mask<float, N> lanes_of(std::uint32_t set) {
    typename BitLanes<N>::Native bit{};
    for (int i = 0; i < N; ++i) bit[i] = 1u << i;
    return {(bit & set) != 0};
}

/// Calls f(i) for each set bit.
template <class F>
void for_each_bit(std::uint32_t set, F&& f) {
    for (; set != 0; set &= set - 1) f(std::countr_zero(set));
}

/// Square root in one instruction a register, which g++ 12 does not find by itself for 16 floats.
template <int N>
Lanes<float, N> fast_sqrt(Lanes<float, N> x) {
#if defined(__AVX512F__)
    if constexpr (N % 16 == 0) {
        for (int i = 0; i < N / 16; ++i) {
            char* at = reinterpret_cast<char*>(&x.v) + 64 * i;
            __m512 part;
            __builtin_memcpy(&part, at, sizeof part);
            part = _mm512_sqrt_ps(part);
            __builtin_memcpy(at, &part, sizeof part);
        }
        return x;
    }
#endif
    return sqrt(x);
}

/// Natural logarithm of positive normal numbers; `fast_log` of each lane.
template <int N>
Lanes<float, N> fast_log(Lanes<float, N> x) {
    using Pack = Lanes<float, N>;
    constexpr std::uint32_t sqrt_half = 0x3f3504f3u;
    const auto shifted = __builtin_bit_cast(typename BitLanes<N>::Native, x.v) - sqrt_half;
    const auto exponent = __builtin_bit_cast(typename Mask<float, N>::Native, shifted) >> 23;
    const Pack t =
        Pack::from(__builtin_bit_cast(typename Pack::Native, (shifted & 0x007fffffu) + sqrt_half)) -
        Pack(1.f);
    Pack p(0.0872235522f);
    for (const float c : {-0.143668428f, 0.149522662f, -0.165623933f, 0.199568331f, -0.250020742f,
                          0.333341867f, -0.499999881f, 1.f})
        p = p * t + Pack(c);
    return t * p + Pack::from(__builtin_convertvector(exponent, typename Pack::Native)) *
                       Pack(0.693147181f);
}

template <int N>
struct UnitCircle {
    Lanes<float, N> cos, sin;
};

/// (cos, sin) of 2 pi u for u in [0, 1]; `fast_unit_circle` of each lane.
template <int N>
UnitCircle<N> fast_unit_circle(Lanes<float, N> u) {
    using Pack = Lanes<float, N>;
    using Ints = typename Mask<float, N>::Native;
    const Pack round(0x1.8p23f);  // adding it leaves no bits for a fraction
    const Pack quarter = (Pack(4.f) * u + round) - round;
    const Pack r = u - Pack(0.25f) * quarter, r2 = r * r;
    const Pack s =
        r * (((Pack(-75.3935623f) * r2 + Pack(81.5923538f)) * r2 + Pack(-41.3416634f)) * r2 +
             Pack(6.28318548f));
    const Pack c = (((Pack(59.2028008f) * r2 + Pack(-85.4422989f)) * r2 + Pack(64.9393082f)) * r2 +
                    Pack(-19.7392082f)) *
                       r2 +
                   Pack(1.f);
    const auto turns = __builtin_convertvector(quarter.v, Ints);
    const Mask<float, N> swap{(turns & 1) != 0}, left{((turns + 1) & 2) != 0},
        below{(turns & 2) != 0};
    const Pack x = select(swap, s, c), y = select(swap, c, s);
    return {select(left, -x, x), select(below, -y, y)};
}

/// N streams of random numbers: xoshiro128+ (D. Blackman, S. Vigna 2021, Scrambled linear
/// pseudorandom number generators, ACM TOMS 47(4)), whose states are hashed from the key and the
/// lane. Only the upper bits are used: the lowest are the weak ones of this generator.
template <int N>
class RandomLanes {
  public:
    explicit RandomLanes(std::uint64_t key) {
        for (int i = 0; i < N; ++i) {
            Random r(stream_key(key, std::uint64_t(i)));
            const std::uint64_t low = r.next_bits(), high = r.next_bits();
            a_[i] = std::uint32_t(low), b_[i] = std::uint32_t(low >> 32);
            c_[i] = std::uint32_t(high), d_[i] = std::uint32_t(high >> 32);
        }
    }

    /// Uniform in (0, 1), never either; multiples of 2^-24, and finer close to 0.
    Lanes<float, N> next() {
        using Pack = Lanes<float, N>;
        const auto shifted = __builtin_bit_cast(typename Mask<float, N>::Native, next_bits() >> 1);
        const Pack x = Pack::from(__builtin_convertvector(shifted, typename Pack::Native));
        return min(x * Pack(0x1p-31f) + Pack(0x1p-32f), Pack(1.f - 0x1p-24f));
    }

  private:
    using Bits = typename BitLanes<N>::Native;

    Bits next_bits() {
        const auto result = a_ + d_, t = b_ << 9;
        c_ ^= a_, d_ ^= b_, b_ ^= c_, a_ ^= d_;
        c_ ^= t;
        d_ = (d_ << 11) | (d_ >> 21);
        return result;
    }

    Bits a_, b_, c_, d_;
};

}  // namespace nacre
