// R(r) in red, green and blue (band_profiles.h). Whoever includes it declares
// `uniform sampler2D profile_table`.
uniform float profile_low, profile_range;

vec3 profile(float r) {
    float x = clamp((log2(max(r, 1e-30)) - profile_low) / profile_range, 0, 1);
    float width = float(textureSize(profile_table, 0).x);
    return exp2(textureLod(profile_table, vec2((x * (width - 1) + 0.5) / width, 0.5), 0).rgb);
}
