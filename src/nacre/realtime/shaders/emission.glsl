// What a light gives in a direction, over the irradiance at the object's middle (LightPoint).
uniform vec3 light_position, light_normal, light_color;
uniform float light_distance2, light_cosine;  // the cosine of the lamp's normal towards the middle
uniform int light_parallel, has_falloff;

// Irradiance at p facing the light, for `light_color` 1; `to_light` is a unit vector.
float irradiance_at(vec3 p, out vec3 to_light) {
    if (light_parallel != 0) {
        to_light = light_position;
        return 1;
    }
    vec3 d = light_position - p;
    float d2 = dot(d, d);
    to_light = d * inversesqrt(d2);
    float e = light_distance2 / d2;
    if (light_cosine > 0) e *= max(0, -dot(light_normal, to_light)) / light_cosine;
    return e;
}
