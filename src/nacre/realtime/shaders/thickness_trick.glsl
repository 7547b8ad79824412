// Light from behind by the thickness in a light's picture, or with FRONT plain diffuse reflection
// (thickness_trick.cpp).
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, rgba32f) uniform image2D below_image;
layout(binding = 0) uniform sampler2D position_picture;
layout(binding = 1) uniform sampler2D normal_picture;
layout(binding = 2) uniform sampler2D lit_picture;
layout(binding = 3) uniform sampler2D light_position;
layout(binding = 4) uniform sampler2D light_entered;
uniform mat4 light_clip;
uniform vec3 eye, light_eye;  // of parallel views the direction of their rays
uniform vec3 scale, attenuation;
uniform float pixel_width, distortion, power, strength, ambient;
uniform int part, is_parallel, light_parallel;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(below_image)))) return;
    vec4 position = texelFetch(position_picture, pixel, 0);
    if (int(position.w) - 1 != part) return;
    vec3 p = position.xyz;
    vec4 before = imageLoad(below_image, pixel);
#ifdef FRONT
    vec3 sum = texelFetch(lit_picture, pixel, 0).rgb;
#else
    vec3 n = texelFetch(normal_picture, pixel, 0).xyz;
    vec3 view = is_parallel != 0 ? -eye : normalize(eye - p);
    vec3 light = light_parallel != 0 ? -light_eye : normalize(light_eye - p);
    vec4 c = light_clip * vec4(p, 1);
    vec2 u = c.xy / c.w * 0.5 + 0.5;
    vec4 from = textureLod(light_position, u, 0);
    if (from.w <= 0) return;
    float texel = pixel_width * c.w;
    vec3 entered = vec3(textureLod(light_entered, u, 0).w / (from.w * texel * texel));
    float thickness = max(0, dot(from.xyz / from.w - p, light));
    float towards = pow(clamp(dot(view, -normalize(light + n * distortion)), 0, 1), power);
    vec3 sum = entered * exp(-attenuation * thickness) * (strength * towards + ambient);
#endif
    imageStore(below_image, pixel, before + vec4(scale * sum, 0));
}
