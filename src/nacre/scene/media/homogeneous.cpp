// Homogeneous media, whose coefficients may be given as extinction and albedo, as scattering and
// absorption, by the name of a measured medium, or by the colour that a thick body shows.
#include "nacre/bssrdf/chiang2016.h"
#include "nacre/optics/media.h"
#include "nacre/scene/media/types.h"

namespace nacre {

namespace {

void set_extinction_and_albedo(const SceneNode& node, Medium& medium) {
    const auto get = [&](const char* name, ColorRole role, float otherwise) {
        SpectrumPtr value = get_uniform_coefficient(node, name, role, otherwise);
        if (!value)
            node.fail_at(name,
                         fmt::format("'{}' of a homogeneous medium is the same everywhere; use "
                                     "<medium type=\"heterogeneous\"> for a {}",
                                     name, node.child(name, "volume")->node->type));
        return value;
    };
    medium.sigma_t = get("sigma_t", ColorRole::unbounded, 1.f);
    medium.albedo = get("albedo", ColorRole::reflectance, 0.75f);
}

/// sigma_a and sigma_s, as in Mitsuba 0.6.
void set_sigma_s_and_sigma_a(const SceneNode& node, Medium& medium) {
    for (const char* other : {"sigma_t", "albedo"})
        if (node.has(other))
            node.fail_at(other,
                         "give either 'sigma_t' and 'albedo' or 'sigma_s' and 'sigma_a', "
                         "not a mixture");
    for (const auto& [given, missing] : {std::pair{"sigma_s", "sigma_a"}, {"sigma_a", "sigma_s"}})
        if (!node.has(missing))
            node.fail_at(given, fmt::format("'{}' needs '{}' as well", given, missing));
    set_scattering_and_absorption(medium,
                                  get_coefficient(node, "sigma_s", ColorRole::unbounded, 0.f),
                                  get_coefficient(node, "sigma_a", ColorRole::unbounded, 0.f));
}

void set_measured(const SceneNode& node, Medium& medium) {
    for (const char* other : {"sigma_t", "albedo", "sigma_a", "sigma_s"})
        if (node.has(other))
            node.fail_at(other, fmt::format("give either 'material' or '{}', not both", other));
    try {
        const MeasuredMedium& measured = measured_media().find(node.get_string("material"));
        set_scattering_and_absorption(medium, make_rgb_unbounded(measured.sigma_s_prime),
                                      make_rgb_unbounded(measured.sigma_a));
    } catch (const InputError& error) {
        node.fail_at("material", error.what());
    }
}

/// Parameter `name`, a colour in RGB or a number, each component of which `is_valid`.
template <class F>
Vec3f get_rgb(const SceneNode& node, const char* name, F is_valid, const char* range) {
    using Kind = ColorValue::Kind;
    const ColorValue* color = node.get_color(name);
    if (!color || (color->kind != Kind::rgb && color->kind != Kind::constant))
        node.fail_at(name, fmt::format("'{}' must be a number or a colour in RGB", name));
    const Vec3f rgb =
        color->kind == Kind::rgb ? color->rgb : Vec3f{color->value, color->value, color->value};
    for (int i = 0; i < 3; ++i)
        if (!is_valid(rgb[i]))
            node.fail_at(name,
                         fmt::format("'{}' must {}, but has the value {}", name, range, rgb[i]));
    return rgb;
}

/// `surface_color`, which a thick body shows under diffuse light, and `radius`, mm, over which
/// light spreads in it: Chiang et al. 2016, band by band. The inversion is for isotropic
/// scattering; another phase function gets more scattering by the similarity relation.
void set_surface_color(const SceneNode& node, Medium& medium) {
    for (const char* other : {"material", "sigma_t", "albedo", "sigma_a", "sigma_s"})
        if (node.has(other))
            node.fail_at(
                other,
                fmt::format("give either 'surface_color' and 'radius' or '{}', not a mixture",
                            other));
    for (const auto& [given, missing] :
         {std::pair{"surface_color", "radius"}, {"radius", "surface_color"}})
        if (!node.has(missing))
            node.fail_at(given, fmt::format("'{}' needs '{}' as well", given, missing));
    const Vec3f color = get_rgb(
        node, "surface_color", [](float x) { return x >= 0.f && x <= 1.f; }, "lie within [0, 1]");
    const Vec3f radius = get_rgb(
        node, "radius", [](float x) { return x > 0.f && std::isfinite(x); },
        "be finite and positive");
    Vec3f scattering, absorption;
    for (int i = 0; i < 3; ++i) {
        const auto isotropic = chiang2016_medium(color[i], radius[i]);
        scattering[i] = isotropic.sigma_s / (1.f - medium.phase.mean_cosine());
        absorption[i] = isotropic.sigma_t - isotropic.sigma_s;
    }
    set_scattering_and_absorption(medium, make_rgb_unbounded(scattering),
                                  make_rgb_unbounded(absorption));
}

}  // namespace

void set_homogeneous_coefficients(const SceneNode& node, Medium& medium) {
    if (node.has("surface_color") || node.has("radius"))
        set_surface_color(node, medium);
    else if (node.has("material"))
        set_measured(node, medium);
    else if (node.has("sigma_s") || node.has("sigma_a"))
        set_sigma_s_and_sigma_a(node, medium);
    else
        set_extinction_and_albedo(node, medium);
}

}  // namespace nacre
