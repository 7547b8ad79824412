// Profiles fitted to measurements or simulations.
#include <cmath>

#include "nacre/bssrdf/chiang2016.h"
#include "nacre/bssrdf/gaussian_sum.h"
#include "nacre/bssrdf/normalised_diffusion.h"
#include "nacre/bssrdf/profile_models.h"

namespace nacre {

namespace {

// 1 / sigma_tr of classical diffusion; the fit for diffuse mean free paths needs absorption.
double classical_sigma_tr(const ProfileMedium& m) {
    return std::sqrt(3. * m.sigma_a * m.sigma_t_prime());
}

double free_path(const ProfileMedium& m, NormalisedDiffusionFit fit) {
    if (fit != NormalisedDiffusionFit::diffuse_free_path) return 1. / m.sigma_t_prime();
    if (m.sigma_a == 0.)
        throw InputError(
            "normalised_diffusion: fit=diffuse_free_path needs absorption: without it the diffuse "
            "mean free path is infinite; use fit=diffuse");
    return 1. / classical_sigma_tr(m);
}

class NormalisedProfile final : public RadialProfile {
  public:
    NormalisedProfile(const ProfileMedium& m, NormalisedDiffusionFit fit)
        : model_(chiang2016_surface_albedo(m.reduced_albedo()), free_path(m, fit), fit),
          sigma_tr_(classical_sigma_tr(m)) {}

    const ProfileDescription& description() const override { return normalised_profile(); }
    double eval(double r) const override { return model_.eval(r); }
    double cumulative(double r) const override { return model_.cumulative(r); }
    double total() const override { return model_.total(); }
    bool includes_single_scattering() const override { return true; }
    double scale() const override { return model_.d; }
    double sigma_tr() const override { return sigma_tr_; }

  private:
    NormalisedDiffusion<double> model_;
    double sigma_tr_;
};

class SkinProfile final : public RadialProfile {
  public:
    explicit SkinProfile(int channel) : sum_(skin_gaussians(channel)) {}

    const ProfileDescription& description() const override { return gaussian_sum_profile(); }
    double eval(double r) const override { return sum_.eval(r * r); }
    double cumulative(double r) const override { return sum_.cumulative(r * r); }
    double total() const override { return sum_.total(); }
    bool includes_single_scattering() const override { return true; }
    double scale() const override { return std::sqrt(sum_.terms.front().variance); }
    double sigma_tr() const override { return 0.; }

  private:
    GaussianSum sum_;
};

}  // namespace

const ProfileDescription& normalised_profile() {
    static const ProfileDescription description{
        .name = "normalised_diffusion",
        .title = "Normalised diffusion",
        .authors = "P. H. Christensen, B. Burley",
        .year = 2015,
        .paper =
            "Approximate Reflectance Profiles for Efficient Subsurface Scattering, Pixar "
            "Technical Memo 15-04",
        .formula =
            "R = A (exp(-r/d) + exp(-r/(3 d))) / (8 pi d r),   d = l / s(A)\n"
            "A from alpha' by the inverse of chiang2016.h, a fit to the same simulations;\n"
            "the index of refraction is not used",
        .single_scattering = "included in the fit",
        .options = {choice_parameter(
            "fit", "which fit of s",
            {{"searchlight", "light at a right angle, l the transport mean free path"},
             {"diffuse", "diffuse light, l the transport mean free path"},
             {"diffuse_free_path", "l the diffuse mean free path 1/sigma_tr"}})},
        .errata = {"The paper holds the cumulative distribution not to be invertible; it is, by "
                   "Cardano's formula."},
        .make = [](const ProfileMedium& m,
                   const ParameterValues& o) -> std::unique_ptr<RadialProfile> {
            return std::make_unique<NormalisedProfile>(m, o.choice<NormalisedDiffusionFit>("fit"));
        }};
    return description;
}

const ProfileDescription& gaussian_sum_profile() {
    static const ProfileDescription description{
        .name = "gaussian_sum",
        .title = "Six Gaussians of skin",
        .authors = "E. d'Eon, D. Luebke",
        .year = 2007,
        .paper = "Advanced Techniques for Realistic Real-Time Skin Rendering, GPU Gems 3, ch. 14",
        .formula =
            "R = sum of w_i exp(-r^2/(2 v_i)) / (2 pi v_i)\n"
            "the medium is not used: lengths are those of skin, the total is 1",
        .single_scattering = "included in the fit",
        .options = {choice_parameter("channel", "which colour band",
                                     {{"red", "the widest"}, {"green", ""}, {"blue", ""}})},
        .invertible = false,
        .make = [](const ProfileMedium&,
                   const ParameterValues& o) -> std::unique_ptr<RadialProfile> {
            return std::make_unique<SkinProfile>(o.choice<int>("channel"));
        }};
    return description;
}

}  // namespace nacre
