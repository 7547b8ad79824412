// One of two blurs of the camera's irradiance (separable.cpp), along `direction`. FINISH: the
// second, whose result is what leaves.
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, rgba32f) uniform image2D result;
layout(binding = 0) uniform sampler2D position_picture;
layout(binding = 1) uniform sampler2D irradiance;
layout(binding = 2) uniform sampler2D kernel;  // rgb: weights, a: offset, a length
uniform mat4 camera_clip;
uniform float pixel_width, following;
uniform vec3 scale;
uniform vec2 direction;
uniform int part;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(result);
    if (any(greaterThanEqual(pixel, size))) return;
    vec4 position = texelFetch(position_picture, pixel, 0);
    if (int(position.w) - 1 != part) return;
    float width = pixel_width * (camera_clip * vec4(position.xyz, 1)).w;
    vec3 own = texelFetch(irradiance, pixel, 0).rgb, sum = vec3(0);
    int taps = textureSize(kernel, 0).x;
    for (int i = 0; i < taps; ++i) {
        vec4 tap = texelFetch(kernel, ivec2(i, 0), 0);
        float steps = round(tap.w / width);
        ivec2 at = pixel + ivec2(direction * steps);
        vec3 light = own;
        if (all(greaterThanEqual(at, ivec2(0))) && all(lessThan(at, size))) {
            vec4 seen = texelFetch(position_picture, at, 0);
            if (int(seen.w) - 1 == part) {
                // The farther off in depth, the more the pixel's own light stands for it.
                vec3 d = seen.xyz - position.xyz;
                float deep = sqrt(max(dot(d, d) - steps * steps * width * width, 0));
                light = mix(texelFetch(irradiance, at, 0).rgb, own, clamp(following * deep, 0, 1));
            }
        }
        sum += tap.rgb * light;
    }
#ifdef FINISH
    vec4 before = imageLoad(result, pixel);
    imageStore(result, pixel, before + vec4(scale * sum, 0));
#else
    imageStore(result, pixel, vec4(sum, 0));
#endif
}
