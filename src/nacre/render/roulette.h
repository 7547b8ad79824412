#pragma once
// Russian roulette (J. Arvo, D. Kirk 1990, Particle Transport and Image Synthesis, SIGGRAPH 90):
// ends paths that carry little and raises the rest, so that the mean stays.
//
// What a path carries is a weight: its largest lane, relative to its start, without the factor
// 1 / eta^2 that radiance has inside a refracting object and loses when it leaves.
#include <algorithm>

#include "nacre/math/lanes.h"

namespace nacre {

/// Whether a path goes on, which it does with probability `chance`, by the uniform number `u`; its
/// throughput is divided by the probability if so.
inline bool survives(float chance, float u, Spectral& throughput) {
    if (!(u < chance)) return false;
    throughput *= Spectral(1.f / chance);
    return true;
}

/// The chance of a path among surfaces: at most 95 %, so that paths in white surroundings end.
inline float surface_chance(float weight) { return std::min(0.95f, weight); }

/// The chance of a path at a collision: a white medium keeps every path. It will find its way out,
/// and weights that grow at each of hundreds of collisions would be noise.
inline float collision_chance(float weight) { return std::min(1.f, weight); }

/// The chance of a path that has just made many collisions in one walk: until it is `deep`, only
/// one that carries very little is put to the roulette.
inline float walk_chance(float weight, bool deep) {
    return std::min(1.f, deep ? weight : 16.f * weight);
}

/// The chance of a reflection that was split off its path (first_boundary.h), once what it shows by
/// itself has been seen: the rest of it is worth its share of the work, and a little more.
inline float reflection_chance(float weight) { return std::min(1.f, 4.f * weight); }

}  // namespace nacre
