// What is seen at a pixel.
struct Material {
    vec4 color;   // albedo of opaque shapes, radiance of lamps; w: kind
    vec4 inside;  // x: index inside over outside
};
layout(std430, binding = 4) readonly buffer Materials { Material materials[]; };
const int opaque = 0, translucent = 1, lamp = 2;

float fresnel(float cosine, float eta) {
    float sine2 = (1 - cosine * cosine) / (eta * eta);
    if (sine2 >= 1) return 1;
    float inner = sqrt(1 - sine2);
    float s = (cosine - eta * inner) / (cosine + eta * inner);
    float p = (eta * cosine - inner) / (eta * cosine + inner);
    return 0.5 * (s * s + p * p);
}
// Share of the light from outside that a part's boundary lets pass: row `part` of a table over
// equally spaced cosines.
float transmittance(sampler2D table, int part, float cosine) {
    vec2 size = vec2(textureSize(table, 0));
    return texture(table, vec2((cosine * (size.x - 1) + 0.5) / size.x, (part + 0.5) / size.y)).x;
}
const float pi = 3.14159265;
vec2 sky_place(vec3 d) {
    return vec2(fract(atan(d.x, d.z) / (2 * pi)), acos(clamp(d.y, -1, 1)) / pi);
}
