// Visibility by the raster unit: what the compute rasteriser leaves, bits of z/w and the complement
// of the triangle's number.
layout(location = 0) out uint depth_bits;
layout(location = 1) out uint id;

void main() {
    depth_bits = floatBitsToUint(gl_FragCoord.z);
    id = ~uint(gl_PrimitiveID);
}
