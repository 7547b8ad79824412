// Normalised diffusion in screen space (screen_diffusion.cpp).
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, rgba32f) uniform image2D below_image;
layout(binding = 0) uniform sampler2D position_picture;
layout(binding = 1) uniform sampler2D lit_picture;
layout(binding = 5) uniform sampler2D profile_table;
layout(binding = 6) uniform sampler2D radii_table;
#include "profile_radii.glsl"
uniform mat4 camera_clip;
uniform float pixel_width, exit_scale;
uniform int part, samples, widest;
uniform vec2 frame_shift;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(below_image);
    if (any(greaterThanEqual(pixel, size))) return;
    vec4 position = texelFetch(position_picture, pixel, 0);
    if (int(position.w) - 1 != part) return;
    vec3 own = texelFetch(lit_picture, pixel, 0).rgb;
    float width = pixel_width * (camera_clip * vec4(position.xyz, 1)).w;
    vec3 sum = vec3(0), weights = vec3(0);
    // A disk of less than a pixel shows nothing but the pixel.
    if (radius_beyond(radii_range, widest) > width) {
        vec2 noise = pixel_noise(pixel, frame_shift);
        for (int j = 0; j < samples; ++j) {
            float r = radius_beyond(-log(1 - (float(j) + noise.x) / float(samples)), widest);
            float angle = 6.2831853 * fract(float(j) * 0.61803399 + noise.y);
            ivec2 at = ivec2(floor(vec2(pixel) + 0.5 + r / width * vec2(cos(angle), sin(angle))));
            if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, size))) continue;
            vec4 seen = texelFetch(position_picture, at, 0);
            if (int(seen.w) - 1 != part) continue;
            // The distance along the screen is the drawn one and not the pixel's, so that disks of
            // few pixels keep their form.
            vec3 d = seen.xyz - position.xyz;
            float w = (camera_clip * vec4(seen.xyz, 1)).w;
            vec2 across = (vec2(at) - vec2(pixel)) * pixel_width * w;
            float deep2 = max(dot(d, d) - dot(across, across), 0);
            vec3 weight = profile(sqrt(r * r + deep2)) / (profile(r)[widest] / totals[widest]);
            sum += weight * texelFetch(lit_picture, at, 0).rgb;
            weights += weight;
        }
    }
    vec3 mean = mix(own, sum / max(weights, 1e-30), greaterThan(weights, vec3(1e-30)));
    vec4 before = imageLoad(below_image, pixel);
    imageStore(below_image, pixel, before + vec4(exit_scale * totals * mean, 0));
}
