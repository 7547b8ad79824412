// Bends of an object, about the vertical axis (y) through the middle of its box. Normals follow
// the inverse transpose of the map's derivative.
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer RestPositions { vec4 rest_positions[]; };
layout(std430, binding = 1) readonly buffer RestNormals { vec4 rest_normals[]; };
layout(std430, binding = 2) writeonly buffer Positions { vec4 positions[]; };
layout(std430, binding = 3) writeonly buffer Normals { vec4 normals[]; };
uniform uint vertices, translucent_vertices;
uniform int kind;
uniform float amount, phase;
uniform vec3 box_low, box_size;

vec3 moved(vec3 p) {
    vec3 middle = box_low + 0.5 * box_size, d = p - middle;
    float height = (p.y - box_low.y) / box_size.y;  // 0 at the foot, 1 at the top
    if (kind == 1) {  // twist
        float a = amount * (height - 0.5) * cos(phase), c = cos(a), s = sin(a);
        return middle + vec3(c * d.x + s * d.z, d.y, -s * d.x + c * d.z);
    }
    if (kind == 2) {  // bend: the axis becomes a circle through the foot
        float a = amount * cos(phase);
        if (abs(a) < 1e-4) return p;
        float radius = box_size.y / a, angle = a * height;
        return vec3(middle.x + radius - (radius - d.x) * cos(angle),
                    box_low.y + (radius - d.x) * sin(angle), p.z);
    }
    if (kind == 3) {  // breathe: wider and narrower, most in the middle
        float swell = amount * sin(phase) * sin(3.14159265 * clamp(height, 0, 1));
        return middle + d * vec3(1 + swell, 1, 1 + swell);
    }
    return p;
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= vertices) return;
    vec3 p = rest_positions[i].xyz, n = rest_normals[i].xyz;
    if (i >= translucent_vertices || kind == 0) {
        positions[i] = vec4(p, 1);
        normals[i] = vec4(n, 0);
        return;
    }
    // Two tangents, carried along by differences.
    float h = 1e-3 * max(max(box_size.x, box_size.y), box_size.z);
    vec3 t = normalize(abs(n.x) > 0.5 ? vec3(n.y, -n.x, 0) : vec3(0, n.z, -n.y)), b = cross(n, t);
    vec3 dt = moved(p + h * t) - moved(p - h * t), db = moved(p + h * b) - moved(p - h * b);
    positions[i] = vec4(moved(p), 1);
    normals[i] = vec4(normalize(cross(dt, db)), 0);
}
