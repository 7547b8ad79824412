// A light's picture of one shape: where its light meets it and how much passes the boundary.
layout(local_size_x = 8, local_size_y = 8) in;
#include "triangle.glsl"
layout(std430, binding = 2) readonly buffer Normals { vec4 normals[]; };
#include "surface.glsl"
#include "emission.glsl"
layout(binding = 0, r32ui) uniform readonly uimage2D id_image;
layout(binding = 1, rgba32f) uniform writeonly image2D position_image;
layout(binding = 2, rgba32f) uniform writeonly image2D entered_image;
layout(binding = 0) uniform sampler2D transmittance_table;
layout(binding = 1) uniform sampler2D falloff;
uniform int part;
uniform float pixel_width;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(id_image);
    if (any(greaterThanEqual(pixel, size))) return;
    uint id = imageLoad(id_image, pixel).x;
    vec4 position = vec4(0), entered = vec4(0);
    if (id != 0 && int(indices[~id].w) == part) {
        uvec4 index = indices[~id];
        Edges t = edges_of(~id, vec2(size));
        vec2 at = vec2(pixel) + 0.5 - 0.5 * vec2(size);
        vec3 b = barycentric(t, at);
        vec3 p0 = positions[index.x].xyz, p1 = positions[index.y].xyz, p2 = positions[index.z].xyz;
        position = vec4(b.x * p0 + b.y * p1 + b.z * p2, 1);
        vec3 n = normalize(b.x * normals[index.x].xyz + b.y * normals[index.y].xyz +
                           b.z * normals[index.z].xyz);
        vec3 to_light;
        float e = irradiance_at(position.xyz, to_light);
        if (has_falloff != 0) e *= textureLod(falloff, sky_place(-to_light), 0).x;
        // A texel's beam has this cross-section where it meets the surface: of the surface's area
        // and its cosine only the product counts.
        float area = pixel_width * pixel_width;
        if (light_parallel == 0) {
            vec3 d = position.xyz - light_position;
            vec2 x = at * pixel_width;
            area *= dot(d, d) / pow(1 + dot(x, x), 1.5);
        }
        // Where interpolated normals lean away from the light nothing enters.
        float cosine = dot(n, to_light);
        float passes = cosine > 0 ? transmittance(transmittance_table, part, cosine) : 0;
        entered = vec4(n, e * area * passes);
    }
    imageStore(position_image, pixel, position);
    imageStore(entered_image, pixel, entered);
}
