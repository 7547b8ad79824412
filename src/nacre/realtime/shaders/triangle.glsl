// A triangle in the pixels of a view: edge functions in homogeneous coordinates (Olano and Greer
// 1997, Triangle Scan Conversion using 2D Homogeneous Coordinates), so that nothing need be clipped.
// An edge that two triangles share has the same function in both but for its sign, to the last bit:
// no pixel falls between them.
layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = 1) readonly buffer Indices { uvec4 indices[]; };
uniform mat4 clip;

struct Edges {
    vec3 e0, e1, e2;  // of the edges opposite to the corners: dot(e, (x, y, 1)) / det is 1/w times
                      // the corner's barycentric coordinate
    vec3 z;           // clip z of the corners
    float det;        // of the corners' (x, y, w); 0: nothing is seen
    vec2 low, high;   // pixels, relative to the middle; all there are if the triangle passes behind
};

// Antisymmetric in a and b also where the compiler fuses multiplications.
vec3 exact_cross(vec3 a, vec3 b) {
    precise vec3 first = a.yzx * b.zxy, second = a.zxy * b.yzx;
    precise vec3 r = first - second;
    return r;
}
float exact_dot(vec3 e, vec2 p) {
    precise float x = e.x * p.x, y = e.y * p.y;
    precise float s = x + y;
    precise float r = s + e.z;
    return r;
}

vec4 exact_clip(uint corner) {
    vec3 p = positions[corner].xyz;
    precise vec4 x = clip[0] * p.x, y = clip[1] * p.y, z = clip[2] * p.z;
    precise vec4 xy = x + y, zw = z + clip[3];
    precise vec4 r = xy + zw;
    return r;
}

// All that decides on a pixel is computed alike, to the last bit, in every program that asks: depths
// are compared for being equal.
Edges edges_of(uint triangle, vec2 size) {
    uvec4 index = indices[triangle];
    vec4 c0 = exact_clip(index.x), c1 = exact_clip(index.y), c2 = exact_clip(index.z);
    vec3 scale = vec3(0.5 * size, 1);
    vec3 v0 = c0.xyw * scale, v1 = c1.xyw * scale, v2 = c2.xyw * scale;
    Edges t;
    t.e0 = exact_cross(v1, v2);
    t.e1 = exact_cross(v2, v0);
    t.e2 = exact_cross(v0, v1);
    precise vec3 products = v0 * t.e0;
    precise float det = (products.x + products.y) + products.z;
    t.det = det;
    t.z = vec3(c0.z, c1.z, c2.z);
    float nearest = min(min(c0.w, c1.w), c2.w), farthest = max(max(c0.w, c1.w), c2.w);
    t.low = -0.5 * size;
    t.high = 0.5 * size;
    if (nearest > 0) {
        vec2 p0 = v0.xy / v0.z, p1 = v1.xy / v1.z, p2 = v2.xy / v2.z;
        t.low = max(t.low, min(min(p0, p1), p2));
        t.high = min(t.high, max(max(p0, p1), p2));
    } else if (farthest <= 0) {
        t.det = 0;
    }
    return t;
}

// Whether the triangle covers the point (relative to the middle), and its z/w there.
bool covers(Edges t, vec2 p, out float depth) {
    vec3 e = vec3(exact_dot(t.e0, p), exact_dot(t.e1, p), exact_dot(t.e2, p)) * sign(t.det);
    float det = abs(t.det);
    precise vec3 products = e * t.z;
    precise float sum = (products.x + products.y) + products.z;
    precise float z = sum / det;
    depth = z;
    // The sum is 1/w: negative behind the eye.
    return min(min(e.x, e.y), e.z) >= 0 && e.x + e.y + e.z > 0 && depth > 0 && depth <= 1;
}

// Barycentric coordinates of the point that is seen at p.
vec3 barycentric(Edges t, vec2 p) {
    vec3 e = vec3(exact_dot(t.e0, p), exact_dot(t.e1, p), exact_dot(t.e2, p));
    return e / (e.x + e.y + e.z);
}
