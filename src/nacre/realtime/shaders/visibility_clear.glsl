// Nothing is seen yet.
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, r32ui) uniform writeonly uimage2D depth_image;
layout(binding = 1, r32ui) uniform writeonly uimage2D id_image;
layout(std430, binding = 2) buffer Tiles { uint tile_count, groups[3], unused[4]; uvec2 tiles[]; };

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    imageStore(depth_image, pixel, uvec4(0));
    imageStore(id_image, pixel, uvec4(0));
    if (pixel == ivec2(0)) {
        tile_count = 0;
        groups[0] = 0;
        groups[1] = 1;
        groups[2] = 1;
    }
}
