#pragma once
// How a particle scatters: the phase functions of nacre as one small value.
//
// A phase function p(cos theta) is a probability density over the sphere, sr^-1: it integrates
// to 1. cos theta = dot(d_in, d_out) with both directions along propagation, so 1 means straight
// on. Each function has its own file with formula and source, a template over its number type;
// PhaseFunction is any one of them, chosen at run time without a virtual call, because a random
// walk asks for one at every collision.
#include <cmath>
#include <span>
#include <string_view>

#include "nacre/math/fast.h"
#include "nacre/math/frame.h"
#include "nacre/math/vec.h"
#include "nacre/optics/phase_cornette_shanks.h"
#include "nacre/optics/phase_henyey_greenstein.h"
#include "nacre/optics/phase_isotropic.h"
#include "nacre/optics/phase_mie.h"
#include "nacre/optics/phase_rayleigh.h"
#include "nacre/optics/phase_schlick.h"

namespace nacre {

class PhaseFunction {
  public:
    enum class Kind {
        isotropic,
        rayleigh,
        mie_hazy,
        mie_murky,
        mie_murky_33,
        hg,
        schlick,
        cornette_shanks,
        two_term_hg
    };

    /// Isotropic.
    constexpr PhaseFunction() = default;

    static PhaseFunction isotropic() { return {}; }
    static PhaseFunction rayleigh() { return PhaseFunction(Kind::rayleigh); }
    static PhaseFunction mie_hazy() { return PhaseFunction(Kind::mie_hazy); }
    static PhaseFunction mie_murky() { return PhaseFunction(Kind::mie_murky); }
    static PhaseFunction mie_murky_33() { return PhaseFunction(Kind::mie_murky_33); }
    /// These throw InputError unless every asymmetry lies in (-1, 1) and the share in [0, 1].
    static PhaseFunction henyey_greenstein(float g);
    static PhaseFunction schlick(float k);
    static PhaseFunction cornette_shanks(float g);
    static PhaseFunction two_term_hg(float first, float g1, float g2);

    /// By the name used in scene files (`names`); `parameter` is g, or k for schlick, and is
    /// ignored by functions without one; two_term_hg has its own maker. Throws InputError on an
    /// unknown name.
    static PhaseFunction named(std::string_view name, float parameter = 0.f);
    static std::span<const std::string_view> names();

    Kind kind() const { return kind_; }
    std::string_view name() const;

    /// p, sr^-1; also the density of `sample` over solid angle.
    float eval(float cos_theta) const {
        return visit([=](const auto& p) { return p.eval(cos_theta); });
    }
    /// A cosine distributed as 2 pi p from a uniform number in [0, 1).
    float sample_cos(float u) const {
        return visit([=](const auto& p) { return p.sample_cos(u); });
    }
    float mean_cosine() const {
        return visit([](const auto& p) { return p.mean_cosine(); });
    }
    /// The propagation direction after a collision of light that travels along the unit vector d.
    Vec3f sample(const Vec3f& d, Vec2f u) const {
        const float c = sample_cos(u.x), s = std::sqrt(std::fmax(0.f, 1.f - c * c));
        const Vec2f turn = fast_unit_circle(u.y);
        const Vec3f out = Framef::around(d).to_world({s * turn.x, s * turn.y, c});
        // Rounding would let the length drift over the thousands of turns of a long walk; one
        // Newton step of 1 / length is enough.
        return out * (1.5f - 0.5f * dot(out, out));
    }

  private:
    constexpr explicit PhaseFunction(Kind kind, float a = 0.f, float b = 0.f, float c = 0.f)
        : kind_(kind), a_(a), b_(b), c_(c) {}

    template <class F>
    float visit(F&& f) const {
        switch (kind_) {
            case Kind::isotropic:
                break;
            case Kind::rayleigh:
                return f(RayleighPhase<float>{});
            case Kind::mie_hazy:
                return f(MiePhase<float>::hazy());
            case Kind::mie_murky:
                return f(MiePhase<float>::murky());
            case Kind::mie_murky_33:
                return f(MiePhase<float>::murky_33());
            case Kind::hg:
                return f(HenyeyGreensteinPhase<float>{a_});
            case Kind::schlick:
                return f(SchlickPhase<float>{a_});
            case Kind::cornette_shanks:
                return f(CornetteShanksPhase<float>{a_});
            case Kind::two_term_hg:
                return f(TwoTermHenyeyGreensteinPhase<float>{a_, b_, c_});
        }
        return f(IsotropicPhase<float>{});
    }

    Kind kind_ = Kind::isotropic;
    float a_ = 0.f, b_ = 0.f, c_ = 0.f;
};

}  // namespace nacre
