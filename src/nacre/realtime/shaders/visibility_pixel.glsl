// One pixel of one triangle. STEP 0 finds the nearest depth of each pixel, STEP 1 the triangle that
// has it: OpenGL 4.5 has no atomic operation on both. z/w falls with distance and is positive, so
// its bits are ordered as it is.
#include "triangle.glsl"
layout(binding = 0, r32ui) uniform uimage2D depth_image;
layout(binding = 1, r32ui) uniform uimage2D id_image;
layout(std430, binding = 2) buffer Tiles { uint tile_count, groups[3], unused[4]; uvec2 tiles[]; };
uniform uint triangles, capacity;

void draw(Edges t, uint triangle, ivec2 pixel, vec2 middle) {
    float depth;
    if (!covers(t, vec2(pixel) + 0.5 - middle, depth)) return;
    uint bits = floatBitsToUint(depth);
#if STEP == 0
    imageAtomicMax(depth_image, pixel, bits);
#else
    // The smallest number wins where several are equally near: complements, so that 0 is nothing.
    if (imageLoad(depth_image, pixel).x == bits) imageAtomicMax(id_image, pixel, ~triangle);
#endif
}
