// What all media share: coefficients as spectra.
#include "nacre/scene/media/types.h"

namespace nacre {

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

}  // namespace

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

SpectrumPtr get_uniform_coefficient(const SceneNode& node, std::string_view name, ColorRole role,
                                    float otherwise) {
    const SceneNode::Child* child = node.child(name, "volume");
    if (!child) return get_coefficient(node, name, role, otherwise);
    if (child->node->type != "constvolume") return nullptr;
    const SpectrumPtr value = get_coefficient(*child->node, "value", role, 1.f);
    child->node->check_all_used();
    return value;
}

void set_scattering_and_absorption(Medium& medium, SpectrumPtr scattering, SpectrumPtr absorption) {
    medium.sigma_t = std::make_shared<SumSpectrum>(scattering, absorption);
    medium.albedo = std::make_shared<AlbedoSpectrum>(std::move(scattering), std::move(absorption));
}

}  // namespace nacre
