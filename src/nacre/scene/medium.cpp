#include "nacre/scene/medium.h"

#include "nacre/optics/media.h"
#include "nacre/scene/build.h"

namespace nacre {

MediumCoefficients Medium::coefficients(const Point3f& p, const Wavelengths& w) const {
    const Spectral t = (sigma_t_volume ? sigma_t_volume->eval(p, w) : sigma_t->eval(w)) * scale;
    const Spectral a = albedo_volume ? albedo_volume->eval(p, w) : albedo->eval(w);
    return {t * a, t};
}

Spectral Medium::majorant(const Wavelengths& w) const {
    return (sigma_t_volume ? Spectral(sigma_t_volume->max()) : sigma_t->eval(w)) * scale;
}

bool Medium::is_spectral() const {
    return (sigma_t && sigma_t->is_spectral()) || (albedo && albedo->is_spectral());
}

namespace {

/// Extinction from scattering and absorption.
class SumSpectrum final : public Spectrum {
  public:
    SumSpectrum(SpectrumPtr a, SpectrumPtr b) : a_(std::move(a)), b_(std::move(b)) {}

    Spectral eval(const Wavelengths& w) const override { return a_->eval(w) + b_->eval(w); }
    Vec3f rgb() const override { return a_->rgb() + b_->rgb(); }
    float max() const override { return a_->max() + b_->max(); }
    bool is_spectral() const override { return a_->is_spectral() || b_->is_spectral(); }

  private:
    SpectrumPtr a_, b_;
};

/// Single-scattering albedo from scattering and absorption; 0 where there is neither.
class AlbedoSpectrum final : public Spectrum {
  public:
    AlbedoSpectrum(SpectrumPtr scattering, SpectrumPtr absorption)
        : s_(std::move(scattering)), a_(std::move(absorption)) {}

    Spectral eval(const Wavelengths& w) const override {
        const Spectral s = s_->eval(w), t = s + a_->eval(w);
        return select(t > Spectral(0.f), s / t, Spectral(0.f));
    }
    Vec3f rgb() const override {
        const Vec3f s = s_->rgb(), t = s + a_->rgb();
        const auto ratio = [](float x, float y) { return y > 0.f ? x / y : 0.f; };
        return {ratio(s.x, t.x), ratio(s.y, t.y), ratio(s.z, t.z)};
    }
    float max() const override { return s_->max() > 0.f ? 1.f : 0.f; }
    bool is_spectral() const override { return s_->is_spectral() || a_->is_spectral(); }

  private:
    SpectrumPtr s_, a_;
};

/// Calls `check` with every number of a colour as it was written.
template <class F>
void for_each_value(const ColorValue& color, F&& check) {
    switch (color.kind) {
        case ColorValue::Kind::rgb:
            for (int i = 0; i < 3; ++i) check(color.rgb[i]);
            break;
        case ColorValue::Kind::constant:
            check(color.value);
            break;
        case ColorValue::Kind::tabulated:
            for (const float v : color.values) check(v);
            break;
        case ColorValue::Kind::blackbody:
            break;
    }
}

/// Parameter `name` of `node` as a spectrum within the range that its role allows.
SpectrumPtr get_coefficient(const SceneNode& node, std::string_view name, ColorRole role,
                            float otherwise) {
    if (const ColorValue* color = node.get_color(name)) {
        if (color->kind == ColorValue::Kind::blackbody)
            node.fail_at(name, fmt::format("'{}' is a property of matter, so it cannot be a "
                                           "blackbody emission",
                                           name));
        for_each_value(*color, [&](float v) {
            if (role == ColorRole::reflectance && !(v >= 0.f && v <= 1.f))
                node.fail_at(name, fmt::format("'{}' must lie within [0, 1], but has the value {}",
                                               name, v));
            if (!(v >= 0.f) || !std::isfinite(v))
                node.fail_at(name,
                             fmt::format("'{}' must be finite and at least 0, but has the value {}",
                                         name, v));
        });
    }
    return get_spectrum(node, name, role, make_constant(otherwise));
}

/// `name` as a constant or, where `volumes` are allowed, as a volume.
void get_field(const SceneNode& node, std::string_view name, ColorRole role, float otherwise,
               bool volumes, BuildContext& context, SpectrumPtr& constant, VolumePtr& volume) {
    const SceneNode::Child* child = node.child(name, "volume");
    if (!child) {
        constant = get_coefficient(node, name, role, otherwise);
    } else if (child->node->type == "constvolume") {
        constant = get_coefficient(*child->node, "value", role, 1.f);
        child->node->check_all_used();
    } else if (volumes) {
        volume = make_volume(*child->node, role, context);
    } else {
        node.fail_at(name, fmt::format("'{}' of a homogeneous medium is the same everywhere; use "
                                       "<medium type=\"heterogeneous\"> for a {}",
                                       name, child->node->type));
    }
}

void set_measured(const SceneNode& node, Medium& medium) {
    for (const char* other : {"sigma_t", "albedo", "sigma_a", "sigma_s"})
        if (node.has(other))
            node.fail_at(other, fmt::format("give either 'material' or '{}', not both", other));
    try {
        const MeasuredMedium& measured = measured_medium(node.get_string("material"));
        const SpectrumPtr s = make_rgb_unbounded(measured.sigma_s_prime);
        const SpectrumPtr a = make_rgb_unbounded(measured.sigma_a);
        medium.sigma_t = std::make_shared<SumSpectrum>(s, a);
        medium.albedo = std::make_shared<AlbedoSpectrum>(s, a);
    } catch (const InputError& error) {
        node.fail_at("material", error.what());
    }
}

/// sigma_a and sigma_s, as in Mitsuba 0.6.
void set_scattering_and_absorption(const SceneNode& node, Medium& medium) {
    for (const char* other : {"sigma_t", "albedo"})
        if (node.has(other))
            node.fail_at(other,
                         "give either 'sigma_t' and 'albedo' or 'sigma_s' and 'sigma_a', "
                         "not a mixture");
    for (const auto& [given, missing] : {std::pair{"sigma_s", "sigma_a"}, {"sigma_a", "sigma_s"}})
        if (!node.has(missing))
            node.fail_at(given, fmt::format("'{}' needs '{}' as well", given, missing));
    const SpectrumPtr s = get_coefficient(node, "sigma_s", ColorRole::unbounded, 0.f);
    const SpectrumPtr a = get_coefficient(node, "sigma_a", ColorRole::unbounded, 0.f);
    medium.sigma_t = std::make_shared<SumSpectrum>(s, a);
    medium.albedo = std::make_shared<AlbedoSpectrum>(s, a);
}

float get_scale(const SceneNode& node) {
    const double scale = node.get_float("scale", 1.0);
    if (!(scale >= 0.0) || !std::isfinite(scale))
        node.fail_at(
            "scale",
            fmt::format("'scale' must be finite and at least 0, but has the value {}", scale));
    return static_cast<float>(scale);
}

MediumPtr build_medium(const SceneNode& node, bool volumes, BuildContext& context) {
    auto medium = std::make_shared<Medium>();
    medium->id = node.id;
    // Files give coefficients per millimetre; rays count in scene units.
    medium->scale = get_scale(node) * static_cast<float>(context.mm_per_unit);
    if (!volumes && node.has("material")) {
        set_measured(node, *medium);
    } else if (!volumes && (node.has("sigma_s") || node.has("sigma_a"))) {
        set_scattering_and_absorption(node, *medium);
    } else {
        get_field(node, "sigma_t", ColorRole::unbounded, 1.f, volumes, context, medium->sigma_t,
                  medium->sigma_t_volume);
        get_field(node, "albedo", ColorRole::reflectance, 0.75f, volumes, context, medium->albedo,
                  medium->albedo_volume);
    }
    const auto phases = node.children_of("phase");
    if (phases.size() > 1)
        throw InputError(phases[1]->location.str() + ": a medium has only one phase function");
    if (!phases.empty()) medium->phase = make_phase(*phases[0]->node);
    // Choices of Mitsuba's integrators that change noise and time, never the picture: nacre's
    // decide for themselves.
    node.get_bool("has_spectral_extinction", true);
    node.get_bool("sample_emitters", true);
    node.check_all_used();
    return medium;
}

MediumPtr build_homogeneous(const SceneNode& node, BuildContext& context) {
    return build_medium(node, false, context);
}
MediumPtr build_heterogeneous(const SceneNode& node, BuildContext& context) {
    return build_medium(node, true, context);
}

using Factory = MediumPtr (*)(const SceneNode&, BuildContext&);
constexpr std::pair<std::string_view, Factory> factories[] = {
    {"homogeneous", build_homogeneous},
    {"heterogeneous", build_heterogeneous},
};

}  // namespace

MediumPtr make_medium(const SceneNode& node, BuildContext& context) {
    if (const auto built = context.media.find(&node); built != context.media.end())
        return built->second;
    std::vector<std::string> known;
    for (const auto& [name, factory] : factories) {
        if (name == node.type) return context.media[&node] = factory(node, context);
        known.emplace_back(name);
    }
    node.fail(fmt::format("unknown medium type '{}'{}", node.type, suggestion(node.type, known)));
}

}  // namespace nacre
