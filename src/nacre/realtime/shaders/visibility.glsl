// One thread a triangle: small ones are drawn at once, large ones are noted in tiles.
layout(local_size_x = 64) in;
#include "visibility_pixel.glsl"

const int small = 256;  // pixels of its box that a thread draws by itself

void main() {
    uint triangle = gl_GlobalInvocationID.x;
    if (triangle >= triangles) return;
    ivec2 size = imageSize(depth_image);
    vec2 middle = 0.5 * vec2(size);
    Edges t = edges_of(triangle, vec2(size));
    if (t.det == 0) return;
    ivec2 low = ivec2(ceil(t.low + middle - 0.5)), high = ivec2(floor(t.high + middle - 0.5));
    low = max(low, ivec2(0));
    high = min(high, size - 1);
    ivec2 box = high - low + 1;
    if (box.x <= 0 || box.y <= 0) return;
    if (box.x * box.y > small) {
        ivec2 first = low / 64, last = high / 64;
        uint count = uint((last.x - first.x + 1) * (last.y - first.y + 1));
#if STEP == 0
        uint at = atomicAdd(tile_count, count);
        if (at + count <= capacity) {
            atomicMax(groups[0], min(at + count, 32768u));
            for (int y = first.y; y <= last.y; ++y)
                for (int x = first.x; x <= last.x; ++x) tiles[at++] = uvec2(triangle, x | y << 16);
            return;
        }
        // No room: entries of others may follow, so these are marked as none.
        for (uint i = at; i < min(at + count, capacity); ++i) tiles[i] = uvec2(~0u);
#else
        // Drawn from its tiles, unless there was no room for all of them.
        if (tile_count <= capacity) return;
#endif
    }
    for (int y = low.y; y <= high.y; ++y)
        for (int x = low.x; x <= high.x; ++x) draw(t, triangle, ivec2(x, y), middle);
}
