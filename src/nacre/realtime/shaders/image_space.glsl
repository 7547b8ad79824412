// Sums R over what a picture shows around each point (image_space.cpp): the camera's, or with LIGHT
// a light's, where the camera does not look. FAST: the camera's, without its areas.
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, rgba32f) uniform image2D below_image;
layout(binding = 0) uniform sampler2D position_picture;
layout(binding = 1) uniform sampler2D normal_picture;
layout(binding = 2) uniform sampler2D lit_picture;
layout(binding = 3) uniform sampler2D light_position;
layout(binding = 4) uniform sampler2D light_entered;
layout(binding = 5) uniform sampler2D profile_table;
layout(binding = 6) uniform sampler2D radii_table;
#include "profile_radii.glsl"

struct Picture {
    mat4 clip;
    vec3 eye;      // of parallel ones the direction of their rays
    int parallel;
    float pixel;   // its width at distance 1
};
uniform Picture camera, light;
uniform int part, samples;
uniform float deepest;
uniform vec2 frame_shift;
uniform vec3 scale;  // of the sum

#ifdef LIGHT
#define source light
#else
#define source camera
#endif

vec3 o;  // the point

vec3 ray_to(Picture p, vec3 x) { return p.parallel != 0 ? p.eye : normalize(x - p.eye); }
// Where a ray through x meets the plane through q.
bool meet(Picture p, vec3 x, vec3 ray, vec3 q, vec3 normal, out vec3 y) {
    float c = dot(ray, normal);
    vec3 from = p.parallel != 0 ? x : p.eye;
    float t = dot(q - from, normal) / c;
    y = from + t * ray;
    return abs(c) > 1e-4 && (p.parallel != 0 || t > 0);
}
bool find_pixel(Picture p, vec3 x, ivec2 size, out ivec2 at, out float w) {
    vec4 c = p.clip * vec4(x, 1);
    w = c.w;
    at = ivec2(floor((c.xy / c.w * 0.5 + 0.5) * vec2(size)));
    return w > 0 && all(greaterThanEqual(at, ivec2(0))) && all(lessThan(at, size));
}
// Squared distance from the eye: how a solid angle spreads.
float spread(Picture p, vec3 x) { return p.parallel != 0 ? 1 : dot(x - p.eye, x - p.eye); }

// What of a place is taken from the camera's picture, by the cosine at which it is seen: places
// seen at grazing angles cover few pixels and are left to the lights' pictures.
float camera_share(float cosine) { return smoothstep(0.05, 0.2, cosine); }

// A plane through the point on which places are drawn, as by R at a depth z below it.
struct Plane {
    vec3 normal;
    float z;
    vec3 log_start;  // log_beyond(z)
    vec3 factor;     // from R to the number of samples an area, by bands
};
Plane planes[2];

// The samples of band b of a plane: those whose number is b modulo how many bands are drawn.
int count_of(int n, int band, int bands) { return (n + bands - 1 - band) / bands; }

// `bands` are drawn in the order of the indices in `order`.
Plane make_plane(vec3 normal, float z, int n, out int order[3], out int bands) {
    Plane p = Plane(normal, z, log_beyond(z), vec3(0));
    bands = 0;
    for (int b = 0; b < 3; ++b)
        if (totals[b] > 0 && p.log_start[b] < 7) order[bands++] = b;
    for (int i = 0; i < bands; ++i) {
        int b = order[i];
        p.factor[b] = float(count_of(n, i, bands)) / (totals[b] * exp(-p.log_start[b]));
    }
    return p;
}
// Samples per solid angle of the picture (parallel: per area across the rays) at a ray through x.
float density(Plane m, vec3 x, vec3 ray) {
    vec3 y;
    if (!meet(source, x, ray, o, m.normal, y)) return 0;
    vec3 d = y - o;
    return dot(m.factor, profile(sqrt(dot(d, d) + m.z * m.z))) * spread(source, y) /
           abs(dot(ray, m.normal));
}

#ifdef LIGHT
// The cosine at which the camera's picture shows x, whose normal is n; 0: it does not. What lies just
// behind a silhouette or a thin wall falls onto pixels that show places near by: it faces away.
float cosine_in_camera(vec3 x, vec3 n, float texel) {
    ivec2 at;
    float w, cosine = -dot(ray_to(camera, x), n);
    if (cosine <= 0 || !find_pixel(camera, x, textureSize(position_picture, 0), at, w)) return 0;
    vec4 seen = texelFetch(position_picture, at, 0);
    if (int(seen.w) - 1 != part) return 0;
    vec3 d = x - seen.xyz;
    float pixel = camera.pixel * w;
    bool here = abs(dot(d, texelFetch(normal_picture, at, 0).xyz)) < 2 * pixel + texel &&
                length(d) < 3 * pixel / max(cosine, 0.05) + texel;
    return here ? cosine : 0;
}
#endif

// What the picture shows along a ray through x gives to the point, over the density of samples.
vec3 gathered(vec3 x) {
    ivec2 at;
    float w;
#ifdef LIGHT
    if (!find_pixel(light, x, textureSize(light_position, 0), at, w)) return vec3(0);
    vec4 position = texelFetch(light_position, at, 0), entered = texelFetch(light_entered, at, 0);
    if (entered.w <= 0) return vec3(0);
    vec3 n = entered.xyz;
#else
    if (!find_pixel(camera, x, textureSize(position_picture, 0), at, w)) return vec3(0);
    vec4 position = texelFetch(position_picture, at, 0);
    if (int(position.w) - 1 != part) return vec3(0);
    vec3 n = texelFetch(normal_picture, at, 0).xyz;
#endif
    // The place within the pixel, on the plane that it shows.
    vec3 ray = ray_to(source, x), y = position.xyz;
    float cosine = -dot(ray, n);
    if (cosine > 0.05) meet(source, x, ray, position.xyz, n, y);
    float p = density(planes[0], x, ray) + density(planes[1], x, ray);
    if (p <= 0) return vec3(0);
    vec3 r = profile(distance(o, y));
#ifdef LIGHT
    float cosine_w = (light.clip * vec4(y, 1)).w, texel = light.pixel * cosine_w;
    float share = 1 - camera_share(cosine_in_camera(y, n, texel));
    // The beam of a texel, per solid angle or per area across it.
    float c = light.parallel != 0 ? 1 : cosine_w / distance(y, light.eye);
    return r * (entered.w * share / (light.pixel * light.pixel * c * c * c * p));
#else
    float share = camera_share(cosine);
    if (share <= 0) return vec3(0);
    return r * texelFetch(lit_picture, at, 0).rgb * (share * spread(camera, y) / (cosine * p));
#endif
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(below_image)))) return;
    vec4 position = texelFetch(position_picture, pixel, 0);
    if (int(position.w) - 1 != part) return;
    o = position.xyz;
    vec2 noise = pixel_noise(pixel, frame_shift);

    // Planes across the picture's rays: no distance on them is longer than that on the surface, so
    // that no place is drawn too seldom. Besides, in the camera's picture, the tangent plane, on which
    // foreshortened surfaces are drawn as they lie; in a light's, one at the depth where it enters.
#ifdef FAST
    ivec2 counts = ivec2(samples, 0);
#else
    ivec2 counts = ivec2((samples + 1) / 2, samples / 2);
#endif
    vec3 across = -ray_to(source, o);
    float depth = 0;
#ifdef LIGHT
    // How deep below where the light enters.
    vec4 c = light.clip * vec4(o, 1);
    vec2 u = c.xy / c.w * 0.5 + 0.5;
    vec4 around = textureLod(light_position, u, 2);
    if (around.w > 0.01) depth = min(abs(dot(o - around.xyz / around.w, across)), deepest);
#endif
    int orders[2][3], bands[2];
#ifdef LIGHT
    vec3 first = across;
#else
    vec3 first = texelFetch(normal_picture, pixel, 0).xyz;
#endif
    planes[0] = make_plane(first, 0, counts[0], orders[0], bands[0]);
    planes[1] = make_plane(across, depth, counts[1], orders[1], bands[1]);

    vec3 sum = vec3(0), weights = vec3(0);
    for (int i = 0; i < 2; ++i) {
        Plane m = planes[i];
        if (bands[i] == 0) continue;
        vec3 s = normalize(cross(m.normal, abs(m.normal.x) < 0.7 ? vec3(1, 0, 0) : vec3(0, 1, 0)));
        vec3 t = cross(m.normal, s);
        for (int j = 0; j < counts[i]; ++j) {
            int order = j % bands[i], band = orders[i][order];
            int k = j / bands[i];
            float n = float(count_of(counts[i], order, bands[i]));
            float v = (float(k) + fract(noise.x + float(order) / 3)) / n;
            float r = radius_beyond(m.log_start[band] - log(1 - v), band);
            float rho = sqrt(max(r * r - m.z * m.z, 0));
            // Turned by the golden angle from one of a band to the next.
            float angle = 6.2831853 * fract(float(k) * 0.61803399 + noise.y + float(order) / 3 +
                                            0.5 * float(i));
            vec3 x = o + rho * (cos(angle) * s + sin(angle) * t);
#ifdef FAST
            ivec2 at;
            float w;
            if (!find_pixel(camera, x, textureSize(position_picture, 0), at, w)) continue;
            vec4 seen = texelFetch(position_picture, at, 0);
            // What lies far from where it was looked for is another part of the surface.
            if (int(seen.w) - 1 != part || distance(seen.xyz, x) > rho + 2 * camera.pixel * w)
                continue;
            vec3 here = profile(r);
            vec3 weight = here / dot(m.factor, here);
            sum += weight * texelFetch(lit_picture, at, 0).rgb;
            weights += weight;
#else
            sum += gathered(x);
#endif
        }
    }
#ifdef FAST
    vec3 own = texelFetch(lit_picture, pixel, 0).rgb;
    sum = totals * mix(own, sum / max(weights, 1e-30), greaterThan(weights, vec3(0)));
#endif
    vec4 before = imageLoad(below_image, pixel);
    imageStore(below_image, pixel, before + vec4(scale * sum, 0));
}
