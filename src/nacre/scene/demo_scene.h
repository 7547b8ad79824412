#pragma once
// The built-in scene: something to show from a fresh build, without any file.
#include "nacre/scene/scene.h"

namespace nacre {

/// The built-in bust (geometry/figure.h) in a waxy translucent medium behind a smooth boundary of
/// index 1.35: lit by a soft key light from the left in front, whose shadow models the face, and by
/// two warm lights from behind, which shine through ears and collar. Lengths are millimetres. The
/// mesh is as fine as the film's pixels. Framed for portrait films (3:4); on films much wider than
/// high the lights behind come into view. Integrator volpath; 15 million samples in all, but 16 to
/// 256 a pixel. Throws InputError unless both sides are within [1, 65536].
Scene make_demo_scene(int width, int height);

}  // namespace nacre
