#pragma once
// Owen-scrambled Sobol' points: random numbers that fill the unit cube more evenly than chance, so
// that the error of a smooth integral falls nearly as N^-1.5 instead of N^-0.5.
//
// Burley 2020, Practical Hash-based Owen Scrambling, JCGT 9(4): four Sobol' dimensions at a time; a
// further group of four repeats them with the order of the points shuffled and scrambled anew,
// which makes it independent of the others. Any aligned block of 2^m indices is a (0,m,2)-net in
// the first two dimensions of each group.
#include <array>
#include <cstdint>

#include "nacre/math/random.h"

namespace nacre {

namespace sobol_detail {

constexpr std::uint32_t reverse_bits(std::uint32_t v) {
    v = (v << 16) | (v >> 16);
    v = ((v & 0x00ff00ffu) << 8) | ((v & 0xff00ff00u) >> 8);
    v = ((v & 0x0f0f0f0fu) << 4) | ((v & 0xf0f0f0f0u) >> 4);
    v = ((v & 0x33333333u) << 2) | ((v & 0xccccccccu) >> 2);
    return ((v & 0x55555555u) << 1) | ((v & 0xaaaaaaaau) >> 1);
}

/// Direction numbers of one dimension from a primitive polynomial over GF(2) of degree s with inner
/// coefficients a, and its initial odd integers m (Joe and Kuo 2008, new-joe-kuo-6).
constexpr std::array<std::uint32_t, 32> directions(int s, std::uint32_t a,
                                                   std::array<std::uint32_t, 3> m) {
    std::array<std::uint32_t, 32> v{};
    for (int i = 0; i < 32; ++i) {
        if (i < s) {
            v[i] = m[i] << (31 - i);
            continue;
        }
        v[i] = v[i - s] ^ (v[i - s] >> s);
        for (int k = 1; k < s; ++k)
            if ((a >> (s - 1 - k)) & 1u) v[i] ^= v[i - k];
    }
    return v;
}

inline constexpr std::array<std::uint32_t, 32> second = directions(1, 0, {1, 0, 0});
inline constexpr std::array<std::uint32_t, 32> third = directions(2, 1, {1, 3, 0});
inline constexpr std::array<std::uint32_t, 32> fourth = directions(3, 1, {1, 3, 1});

/// Component `dimension` (0..3) of Sobol' point `index`, as 32 bits after the binary point.
constexpr std::uint32_t sobol_bits(std::uint32_t index, std::uint32_t dimension) {
    if (dimension == 0) return reverse_bits(index);  // van der Corput
    const auto& v = dimension == 1 ? second : dimension == 2 ? third : fourth;
    std::uint32_t x = 0;
    for (int i = 0; i < 32; ++i) x ^= ((index >> i) & 1u) ? v[i] : 0u;
    return x;
}

/// Owen's nested uniform scrambling: each bit is flipped or not by a hash of the bits above it.
/// Works on reversed bits, where every step below lets a bit depend on lower ones only (Laine and
/// Karras 2011); constants of Vegdahl 2021, which remove a bias of the original ones.
constexpr std::uint32_t nested_uniform_scramble(std::uint32_t x, std::uint32_t seed) {
    x = reverse_bits(x);
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return reverse_bits(x);
}

}  // namespace sobol_detail

/// Number `index` of the scrambled sequence `seed` in `dimension`, uniform in [0, 1). Points of
/// different seeds are independent. Use index 0..N-1 with N a power of two for the best spread.
constexpr float sobol_owen(std::uint32_t index, std::uint32_t dimension, std::uint32_t seed) {
    const std::uint32_t group = dimension / 4, component = dimension % 4;
    const std::uint64_t key = stream_key(seed, group);
    const std::uint32_t shuffled =
        sobol_detail::nested_uniform_scramble(index, static_cast<std::uint32_t>(key));
    const std::uint32_t scramble = static_cast<std::uint32_t>(mix_bits(key + component + 1));
    return to_unit_float(sobol_detail::nested_uniform_scramble(
        sobol_detail::sobol_bits(shuffled, component), scramble));
}

}  // namespace nacre
