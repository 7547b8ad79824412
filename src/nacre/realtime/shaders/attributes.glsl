// Position and normal of what the camera sees, from the triangle of each pixel.
layout(local_size_x = 8, local_size_y = 8) in;
#include "triangle.glsl"
layout(std430, binding = 2) readonly buffer Normals { vec4 normals[]; };
layout(binding = 0, r32ui) uniform readonly uimage2D id_image;
layout(binding = 1, rgba32f) uniform writeonly image2D position_image;
layout(binding = 2, rgba32f) uniform writeonly image2D normal_image;
layout(binding = 3, rgba32f) uniform writeonly image2D lit_image;
layout(binding = 4, rgba32f) uniform writeonly image2D below_image;
uniform vec3 eye;
uniform int is_parallel, translucent_parts;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(id_image);
    if (any(greaterThanEqual(pixel, size))) return;
    uint id = imageLoad(id_image, pixel).x;
    vec4 position = vec4(0), normal = vec4(0);
    if (id != 0) {
        uint triangle = ~id;
        uvec4 index = indices[triangle];
        Edges t = edges_of(triangle, vec2(size));
        vec3 b = barycentric(t, vec2(pixel) + 0.5 - 0.5 * vec2(size));
        vec3 p0 = positions[index.x].xyz, p1 = positions[index.y].xyz, p2 = positions[index.z].xyz;
        position = vec4(b.x * p0 + b.y * p1 + b.z * p2, float(index.w + 1));
        vec3 n = normalize(b.x * normals[index.x].xyz + b.y * normals[index.y].xyz +
                           b.z * normals[index.z].xyz);
        vec3 to_eye = is_parallel != 0 ? -eye : eye - position.xyz;
        // Sheets of other shapes have two sides; a translucent one has a right side, and where
        // interpolated normals lean over its edge they are bent back to it.
        if (int(index.w) >= translucent_parts) {
            if (dot(n, to_eye) < 0) n = -n;
        } else if (dot(n, to_eye) < 0) {
            to_eye = normalize(to_eye);
            vec3 across = n - to_eye * dot(n, to_eye);
            n = normalize(across + to_eye * 1e-3);
        }
        normal = vec4(n, 0);
    }
    imageStore(position_image, pixel, position);
    imageStore(normal_image, pixel, normal);
    imageStore(lit_image, pixel, vec4(0));
    imageStore(below_image, pixel, vec4(0));
}
