// What a screen shows of a picture: the curve of PNG files, or false colours on a logarithmic scale
// of luminance or illuminance.
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2D picture;
layout(binding = 1) uniform sampler2D scale_colors; // one row, of sRGB
layout(binding = 2, rgba8) uniform writeonly image2D shown;
uniform float gain;
uniform int quantity;         // 0: colour, 1: cd/m^2, 2: lx
uniform float photometric;    // cd/m^2 of a luminance of 1
uniform float low, high;      // of the scale: logarithms to base 10
uniform float pixel_width;    // at distance 1
uniform int divider;          // the column of the line between two sides; -1: none

float srgb(float x) {
    x = clamp(x, 0, 1);
    return x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1 / 2.4) - 0.055;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(shown);
    if (any(greaterThanEqual(pixel, size))) return;
    vec3 c = texelFetch(picture, pixel, 0).rgb;
    vec3 color;
    if (quantity == 0) {
        color = vec3(srgb(c.r * gain), srgb(c.g * gain), srgb(c.b * gain));
    } else {
        float value = dot(c, vec3(0.2126907, 0.7151466, 0.0721626)) * photometric;
        if (quantity == 2) {
            // The pixel's solid angle, of a camera that looks at the picture's middle.
            vec2 at = (vec2(pixel) + 0.5 - 0.5 * vec2(size)) * pixel_width;
            value *= pixel_width * pixel_width * pow(1 + dot(at, at), -1.5);
        }
        float place = value > 0 ? (log(value) / log(10.0) - low) / (high - low) : 0;
        color = textureLod(scale_colors, vec2(clamp(place, 0, 1), 0.5), 0).rgb;
    }
    if (pixel.x == divider) color = vec3(1);
    imageStore(shown, pixel, vec4(color, 1));
}
