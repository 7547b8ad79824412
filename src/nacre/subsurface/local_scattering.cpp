#include "nacre/subsurface/local_scattering.h"

#include <limits>

#include "nacre/math/quadrature.h"
#include "nacre/math/sampling.h"
#include "nacre/optics/fresnel_moments.h"
#include "nacre/technique/common_parameters.h"

namespace nacre {

namespace {

using HalfSpace = HanrahanKrueger<float, Spectral, PhaseFunction>;

class LocalScatteringBsdf final : public Bsdf {
  public:
    /// `rest` is rho X, `by_cosine` the probability with which `sample` draws from Lambert's law.
    LocalScatteringBsdf(const ObjectBoundary& boundary, const SurfacePoint& at,
                        const HalfSpace& once, Spectral rest, float by_cosine)
        : boundary_(boundary), at_(at), once_(once), rest_(rest), by_cosine_(by_cosine) {}

    Spectral eval(const Vec3f& wi, const Vec3f& wo) const override {
        if (!EntryLobe::is_outside(at_, wi)) return Spectral(0.f);
        HalfSpace once = once_;
        // The first order lets light in and out as a smooth boundary does.
        if (boundary_.rough()) once.albedo *= Spectral(boundary_.over_smooth(wi.z));
        const float entered = boundary_.transmittance(wi.z) * cosine_hemisphere_pdf(wi.z);
        Spectral f = rest_ * Spectral(entered);
        const float leaves = 1.f - once.specular(wo.z);
        if (leaves > 0.f) f += once.eval(wi, wo) * Spectral(wi.z / leaves);
        return f;
    }
    float pdf(const Vec3f& wi, const Vec3f& wo) const override {
        if (!(wi.z > 0.f)) return 0.f;
        return by_cosine_ * cosine_hemisphere_pdf(wi.z) + (1.f - by_cosine_) * once_.pdf(wi, wo);
    }
    std::optional<BsdfSample> sample(const Vec3f& wo, float u1, Vec2f u2) const override {
        BsdfSample s;
        s.wi = u1 < by_cosine_ ? square_to_cosine_hemisphere(u2) : once_.sample(wo, u2);
        s.pdf = pdf(s.wi, wo);
        if (!(s.pdf > 0.f) || !EntryLobe::is_outside(at_, s.wi)) return std::nullopt;
        s.weight = eval(s.wi, wo) * Spectral(1.f / s.pdf);
        return s;
    }

  private:
    const ObjectBoundary& boundary_;
    SurfacePoint at_;
    HalfSpace once_;
    Spectral rest_;
    float by_cosine_;
};

}  // namespace

double single_scattering_share(double g, double eta) {
    const HanrahanKruegerStack half_space({{{.sigma_s = 1.,
                                             .g = g,
                                             .thickness = std::numeric_limits<double>::infinity(),
                                             .eta = eta}},
                                           1.,
                                           eta});
    const double flux = GaussLegendre(32).integrate(0., 1., [&](double cosine) {
        const LayerTotals t = half_space.totals(cosine);
        return 2. * cosine * (t.reflectance - t.specular);
    });
    return flux / (1. - diffuse_reflectance_external(eta));
}

LocalScatteringLobe::LocalScatteringLobe(const Medium& medium,
                                         std::shared_ptr<const ProfileTables> profile,
                                         const ObjectBoundary& boundary, float scale, Orders orders)
    : medium_(medium),
      profile_(std::move(profile)),
      boundary_(boundary),
      eta_(boundary.eta()),
      scale_(scale),
      share_(float(single_scattering_share(medium.phase.mean_cosine(), boundary.eta()))),
      orders_(orders) {
    // Of what was scattered once, the facets let out less.
    if (boundary.rough())
        share_ *= float(boundary.mean_transmittance() / (1. - diffuse_reflectance_external(eta_)));
}

const Bsdf& LocalScatteringLobe::at(const SurfacePoint& point, const Wavelengths& w,
                                    BsdfScratch& scratch) const {
    const MediumCoefficients c = medium_.coefficients({}, w);
    const Spectral none(0.f);
    const Spectral albedo =
        orders_.single
            ? select(c.sigma_t > none, c.sigma_s / max(c.sigma_t, Spectral(1e-30f)), none)
            : none;
    const Spectral once = albedo * Spectral(share_);
    Spectral rest = profile_->total(w);
    if (orders_.subtracted) rest = max(none, rest - once);
    rest *= Spectral(scale_);
    // Lambert's law serves both terms, and where the phase function leads below the surface it
    // alone does.
    const float diffuse = mean(rest, w), peaked = mean(once, w);
    const float by_cosine = peaked > 0.f ? std::max(0.5f, diffuse / (diffuse + peaked)) : 1.f;
    const HalfSpace half_space{albedo, Spectral(std::numeric_limits<float>::infinity()),
                               medium_.phase, eta_};
    return scratch.make<LocalScatteringBsdf>(boundary_, point, half_space, rest, by_cosine);
}

namespace {

TranslucencyPtr make_local_scattering(const ShapeInput& in) {
    auto profile = profile_tables(in);
    const auto choice = in.options.choice<SingleScatteringChoice>("single_scattering");
    const LocalScatteringLobe::Orders orders{
        .single = choice != SingleScatteringChoice::off,
        .subtracted =
            choice == SingleScatteringChoice::automatic && profile->includes_single_scattering()};
    return std::make_shared<LocalScattering>(
        in.boundary,
        LocalScatteringLobe(in.medium(), std::move(profile), in.boundary, exit_scale(in), orders));
}

}  // namespace

/// In the list of techniques/techniques.cpp.
const TechniqueDescription& local_scattering_technique() {
    static const TechniqueDescription description{
        .name = "hanrahan_krueger",
        .title = "local reflection with single scattering",
        .authors = "P. Hanrahan, W. Krueger",
        .year = 1993,
        .paper =
            "Reflection from Layered Surfaces due to Subsurface Scattering, SIGGRAPH 93; with "
            "what a diffusion profile holds of higher orders",
        .how =
            "all light leaves where it came in: the first order of a half space in closed form, "
            "higher orders as Lambert's law with the profile's total, less the first order "
            "where the profile includes it",
        .precomputes = "the profile's total and the first order's share of it",
        .keeps = {.view = true, .light = true, .geometry = true},
        .parameters = {profile_parameter(), exit_fresnel_parameter(),
                       single_scattering_parameter()},
        .variants = "profile=dipole|profile=better_dipole",
        .prepare = prepare_path_technique,
        .below = make_local_scattering};
    return description;
}

}  // namespace nacre
