// Visibility by the raster unit: corners from the scene's buffers.
layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = 1) readonly buffer Indices { uvec4 indices[]; };
uniform mat4 clip;

void main() {
    uvec4 index = indices[gl_VertexID / 3];
    gl_Position = clip * vec4(positions[index[gl_VertexID % 3]].xyz, 1);
}
