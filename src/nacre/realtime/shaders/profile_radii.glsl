// Radii with the density of R (profile_radii.h), and the noise that they are drawn from. Whoever
// includes it declares `uniform sampler2D profile_table, radii_table`.
#include "profile.glsl"
uniform float radii_range;
uniform vec3 totals;

vec4 radii_row(float x, float row) {
    float width = float(textureSize(radii_table, 0).x);
    return textureLod(radii_table, vec2((clamp(x, 0, 1) * (width - 1) + 0.5) / width, row), 0);
}
// -ln of the share of each band's light that leaves beyond r.
vec3 log_beyond(float r) {
    return r > 0 ? radii_row((log2(r) - profile_low) / profile_range, 0.25).rgb : vec3(0);
}
// The radius beyond which the share e^-x of a band's light leaves.
float radius_beyond(float x, int band) { return radii_row(sqrt(x / radii_range), 0.75)[band]; }

// Two numbers in [0, 1) of a pixel (Jarzynski and Olano 2020, Hash Functions for GPU Rendering:
// pcg3d), shifted from frame to frame so that frames of one pixel are spread evenly.
vec2 pixel_noise(ivec2 pixel, vec2 frame_shift) {
    uvec3 v = uvec3(pixel, 7) * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> 16u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    return fract(vec2(v.xy >> 8u) / 16777216.0 + frame_shift);
}
