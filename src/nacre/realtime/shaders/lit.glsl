// What a light gives to each pixel: the irradiance that passes the boundary of `part`, and the
// radiance of opaque shapes. Opaque shapes stand in the shadows of all translucent ones in turn;
// alpha holds what the views so far leave of the light.
layout(local_size_x = 8, local_size_y = 8) in;
#include "surface.glsl"
#include "emission.glsl"
layout(binding = 0, rgba32f) uniform image2D lit_image;
layout(binding = 0) uniform sampler2D position_picture;
layout(binding = 1) uniform sampler2D normal_picture;
layout(binding = 2) uniform usampler2D light_depth;
layout(binding = 3) uniform sampler2D transmittance_table;
layout(binding = 4) uniform sampler2D falloff;
uniform mat4 light_clip;
uniform int part, first_part, last_part;
uniform float pixel_width, depth_range;

// The distance along the light's axis of a z/w.
float distance_of(float z) {
    return light_parallel != 0 ? (1 - z) * depth_range : depth_range / max(z, 1e-30);
}
// Share of the light that comes to p: by four texels, as near as they are.
float visible(vec3 p, vec3 n, float cosine) {
    vec4 c = light_clip * vec4(p, 1);
    float w = light_parallel != 0 ? 1 : c.w;
    float texel = pixel_width * w;
    // Up from the surface by a texel, more where the light grazes it.
    float slope = min(sqrt(max(0, 1 - cosine * cosine)) / max(cosine, 0.1), 6);
    c = light_clip * vec4(p + n * texel * (0.7 + 0.5 * slope), 1);
    if (c.w <= 0) return 1;
    vec2 u = c.xy / c.w * 0.5 + 0.5;
    if (any(lessThan(u, vec2(0))) || any(greaterThan(u, vec2(1)))) return 1;
    float own = distance_of(c.z / c.w) - 0.3 * texel;
    vec2 at = u * vec2(textureSize(light_depth, 0)) - 0.5;
    ivec2 base = ivec2(floor(at));
    vec2 f = at - vec2(base);
    float sum = 0;
    for (int i = 0; i < 4; ++i) {
        ivec2 o = ivec2(i & 1, i >> 1);
        ivec2 x = clamp(base + o, ivec2(0), textureSize(light_depth, 0) - 1);
        uint bits = texelFetch(light_depth, x, 0).x;
        float weight = (o.x == 1 ? f.x : 1 - f.x) * (o.y == 1 ? f.y : 1 - f.y);
        if (bits == 0 || distance_of(uintBitsToFloat(bits)) >= own) sum += weight;
    }
    return sum;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(lit_image)))) return;
    vec4 position = texelFetch(position_picture, pixel, 0);
    int own = int(position.w) - 1;
    if (own < 0) return;
    int kind = int(materials[own].color.w);
    if (kind == lamp || (kind == translucent && own != part)) return;
    vec3 n = texelFetch(normal_picture, pixel, 0).xyz, to_light;
    float e = irradiance_at(position.xyz, to_light);
    if (has_falloff != 0) e *= textureLod(falloff, sky_place(-to_light), 0).x;
    float cosine = dot(n, to_light);
    vec4 before = imageLoad(lit_image, pixel);
    float seen = cosine > 0 && e > 0 ? visible(position.xyz, n, cosine) : 0;
    if (kind == translucent) {
        if (seen > 0)
            before.rgb += light_color * (e * seen * cosine *
                                         transmittance(transmittance_table, part, cosine));
    } else {
        float rest = (first_part != 0 ? 1 : before.a) * seen;
        before.a = rest;
        if (last_part != 0 && rest > 0)
            before.rgb += light_color * materials[own].color.rgb * (e * rest * cosine / pi);
    }
    imageStore(lit_image, pixel, before);
}
