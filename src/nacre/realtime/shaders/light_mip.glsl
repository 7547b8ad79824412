// The next smaller level of a light's picture: plain means of four texels.
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, rgba32f) uniform readonly image2D position_from;
layout(binding = 1, rgba32f) uniform readonly image2D entered_from;
layout(binding = 2, rgba32f) uniform writeonly image2D position_to;
layout(binding = 3, rgba32f) uniform writeonly image2D entered_to;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(position_to)))) return;
    vec4 position = vec4(0), entered = vec4(0);
    for (int i = 0; i < 4; ++i) {
        ivec2 from = 2 * pixel + ivec2(i & 1, i >> 1);
        position += 0.25 * imageLoad(position_from, from);
        entered += 0.25 * imageLoad(entered_from, from);
    }
    imageStore(position_to, pixel, position);
    imageStore(entered_to, pixel, entered);
}
