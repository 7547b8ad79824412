// Sums a light's picture around each point (translucent_shadow_map.cpp).
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, rgba32f) uniform image2D below_image;
layout(binding = 0) uniform sampler2D position_picture;
layout(binding = 1) uniform sampler2D light_position;
layout(binding = 2) uniform sampler2D light_entered;
layout(binding = 3) uniform sampler2D pattern;
layout(binding = 5) uniform sampler2D profile_table;
#include "profile.glsl"
uniform mat4 light_clip;
uniform vec3 across, down, light_color;  // the light picture's axes in space
uniform int part, rings, levels, blocks;
uniform float pixel_width, square, depth_scale, depth_range;
uniform vec4 dipole[3];  // z_r, z_v, sigma_tr, albedo / 4 pi

vec3 p;             // the point
vec2 place, texel;  // its place in the picture; the width of a unit of length there
float texel_area;   // of a texel of level 0 at the point

#ifdef PAPER
float source_term(float d, float z, float sigma, float least) {
    float s = max(d, least);
    return z * (sigma * s + 1) * exp(-sigma * s) / (s * s * s);
}
vec3 kernel(vec3 from, vec3 normal) {
    vec3 r;
    for (int b = 0; b < 3; ++b) {
        vec4 k = dipole[b];
        r[b] = k.w * (source_term(distance(p, from - k.x * normal), k.x, k.z, 0.25 * k.x) +
                      source_term(distance(p, from + k.y * normal), k.y, k.z, 0.25 * k.x));
    }
    return r;
}
#else
vec3 kernel(vec3 from, vec3 normal) { return profile(distance(p, from)); }
#endif

// What comes from an area around the place at `offset` (lengths in the picture's plane).
vec3 tap(vec2 offset, float area) {
    float level = max(0, 0.5 * log2(area / texel_area));
    vec2 u = place + offset * texel;
    vec4 entered = textureLod(light_entered, u, level);
    if (entered.w <= 0) return vec3(0);
    vec4 position = textureLod(light_position, u, level);
    vec3 from = position.xyz / position.w;
    return kernel(from, normalize(entered.xyz)) * (entered.w * area / texel_area);
}

float column_of(float depth) {
    float x = clamp(log2(1 + max(depth, 0) / depth_scale) / depth_range, 0, 1);
    float width = float(textureSize(pattern, 0).x);
    return (x * (width - 1) + 0.5) / width;
}
vec4 row(int i, float column) {
    return textureLod(pattern, vec2(column, (i + 0.5) / float(1 + 2 * rings)), 0);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(below_image)))) return;
    vec4 position = texelFetch(position_picture, pixel, 0);
    if (int(position.w) - 1 != part) return;
    p = position.xyz;
    vec4 c = light_clip * vec4(p, 1);
    place = c.xy / c.w * 0.5 + 0.5;
    float width = pixel_width * c.w;
    texel_area = width * width;
    texel = 1 / (width * vec2(textureSize(light_entered, 0)));

    // How deep below where the light enters: by the mean position around the place, in areas of
    // several sizes, since on steep surfaces a mean is far from what is near. The smallest counts:
    // too large a one would give what is near a weight made for far taps.
    vec3 axis = normalize(cross(across, down));
    float depth = 1e30;
    float level = max(0, 0.5 * log2(49 * square * square / texel_area));
    for (int i = 0; i < 4; ++i) {
        vec4 around = textureLod(light_position, place, level * float(i) / 3);
        if (around.w > 0.01) depth = min(depth, abs(dot(p - around.xyz / around.w, axis)));
    }
    if (depth > 1e29) depth = 0;
    float column = column_of(depth);

    vec3 near = vec3(0);
    for (int j = -3; j <= 3; ++j)
        for (int i = -3; i <= 3; ++i) near += tap(square * vec2(i, j), square * square);
    near *= row(0, column).rgb;
    if (levels > 0) {
        float width = 7 * square;  // of the square that is summed
        for (int k = 0; k < levels; ++k) {
            float block = 2 * width / float(blocks);
            int low = blocks / 4, high = blocks - low - 1;
            for (int j = 0; j < blocks; ++j)
                for (int i = 0; i < blocks; ++i)
                    if (i < low || i > high || j < low || j > high)
                        near += tap((vec2(i, j) - 0.5 * float(blocks - 1)) * block, block * block);
            width *= 2;
        }
        vec4 before = imageLoad(below_image, pixel);
        imageStore(below_image, pixel, before + vec4(light_color * near, 0));
        return;
    }
    vec3 sum = near;
    for (int k = 0; k < rings; ++k) {
        vec4 ring = row(1 + 2 * k, column);
        vec3 taps = vec3(0);
        for (int i = 0; i < 7; ++i) {
            // Each ring turned against the one before.
            float angle = (float(i) + 0.5 * float(k & 1)) * (2 * 3.14159265 / 7);
            taps += tap(ring.x * vec2(cos(angle), sin(angle)), ring.y);
        }
        sum += taps * row(2 + 2 * k, column).rgb;
    }
    vec4 before = imageLoad(below_image, pixel);
    imageStore(below_image, pixel, before + vec4(light_color * sum, 0));
}
