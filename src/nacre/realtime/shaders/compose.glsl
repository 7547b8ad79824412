// The frame: what comes from below through the boundary, what the boundary mirrors, other shapes,
// the background.
layout(local_size_x = 8, local_size_y = 8) in;
#include "surface.glsl"
layout(binding = 0, rgba32f) uniform writeonly image2D frame_image;
layout(binding = 0) uniform sampler2D position_picture;
layout(binding = 1) uniform sampler2D normal_picture;
layout(binding = 2) uniform sampler2D lit_picture;
layout(binding = 3) uniform sampler2D below_picture;
layout(binding = 4) uniform sampler2D transmittance_table;
layout(binding = 5) uniform sampler2D surroundings;
layout(binding = 6) uniform sampler2D background;
uniform mat4 from_clip;
uniform vec3 eye;
uniform int is_parallel;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(frame_image);
    if (any(greaterThanEqual(pixel, size))) return;
    vec4 position = texelFetch(position_picture, pixel, 0);
    vec4 color = vec4(0, 0, 0, 1);
    int own = int(position.w) - 1;
    if (own < 0) {
        vec3 d = eye;
        if (is_parallel == 0) {
            vec2 c = (vec2(pixel) + 0.5) / vec2(size) * 2 - 1;
            vec4 q = from_clip * vec4(c, 0.5, 1);
            d = normalize(q.xyz / q.w - eye);
        }
        color = vec4(textureLod(background, sky_place(d), 0).rgb, 0);
    } else {
        vec3 n = texelFetch(normal_picture, pixel, 0).xyz;
        vec3 to_eye = is_parallel != 0 ? -eye : normalize(eye - position.xyz);
        Material m = materials[own];
        int kind = int(m.color.w);
        if (kind == lamp) {
            color.rgb = m.color.rgb;
        } else if (kind == opaque) {
            color.rgb = texelFetch(lit_picture, pixel, 0).rgb;
        } else {
            float cosine = clamp(dot(n, to_eye), 0, 1);
            float passes = transmittance(transmittance_table, own, cosine);
            vec3 mirrored = textureLod(surroundings, sky_place(reflect(-to_eye, n)), 0).rgb;
            color.rgb = texelFetch(below_picture, pixel, 0).rgb * passes +
                        mirrored * (1 - passes);
        }
    }
    imageStore(frame_image, pixel, color);
}
