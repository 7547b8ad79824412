// One workgroup a tile of 64 x 64 pixels of a large triangle.
layout(local_size_x = 64) in;
#include "visibility_pixel.glsl"

void main() {
    ivec2 size = imageSize(depth_image);
    vec2 middle = 0.5 * vec2(size);
    uint count = min(tile_count, capacity);
    for (uint i = gl_WorkGroupID.x; i < count; i += gl_NumWorkGroups.x) {
        uvec2 entry = tiles[i];
        if (entry.x == ~0u) continue;
        Edges t = edges_of(entry.x, vec2(size));
        ivec2 corner = 64 * ivec2(entry.y & 0xffffu, entry.y >> 16);
        ivec2 low = max(corner, ivec2(floor(t.low + middle)));
        ivec2 high = min(min(corner + 63, size - 1), ivec2(ceil(t.high + middle)));
        int x = corner.x + int(gl_LocalInvocationID.x);
        if (x < low.x || x > high.x) continue;
        for (int y = low.y; y <= high.y; ++y) draw(t, entry.x, ivec2(x, y), middle);
    }
}
