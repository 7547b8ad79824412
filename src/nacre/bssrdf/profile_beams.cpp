// Profiles of sources along the beam.
#include "nacre/bssrdf/photon_beam_diffusion.h"
#include "nacre/bssrdf/profile_models.h"
#include "nacre/bssrdf/quantised_diffusion.h"
#include "nacre/bssrdf/radial_integral.h"

namespace nacre {

namespace {

Parameter moments_option() {
    return choice_parameter(
        "moments", "where the Fresnel moments come from",
        {{"exact", "quadrature"}, {"fit", "polynomials of d'Eon and Irving 2011"}});
}

class QuantisedProfile final : public RadialProfile {
  public:
    QuantisedProfile(const ProfileMedium& m, int count, MomentModel moments)
        : sum_(quantised_diffusion(m, count, moments)),
          scale_(1. / m.sigma_t_prime()),
          sigma_tr_(PhotonBeamDiffusion(m, false, moments).sigma_tr()) {}

    const ProfileDescription& description() const override { return quantised_diffusion_profile(); }
    double eval(double r) const override { return sum_.eval(r * r); }
    double cumulative(double r) const override { return sum_.cumulative(r * r); }
    double total() const override { return sum_.total(); }
    bool includes_single_scattering() const override { return false; }
    double scale() const override { return scale_; }
    double sigma_tr() const override { return sigma_tr_; }

  private:
    GaussianSum sum_;
    double scale_, sigma_tr_;
};

class PhotonBeamProfile final : public RadialProfile {
  public:
    PhotonBeamProfile(const ProfileMedium& m, bool kappa, bool single, MomentModel moments)
        : multiple_(m, kappa, moments),
          single_(m),
          with_single_(single),
          scale_(1. / (single ? m.sigma_t() : m.sigma_t_prime())) {}

    const ProfileDescription& description() const override { return photon_beam_profile(); }
    double eval(double r) const override {
        return multiple_.eval(r) + (with_single_ ? single_.eval(r) : 0.);
    }
    double cumulative(double r) const override {
        return r > 0. ? disk_integral(r, scale_, [&](double x) { return eval(x); }) : 0.;
    }
    double total() const override {
        return multiple_.total() + (with_single_ ? single_.total() : 0.);
    }
    bool includes_single_scattering() const override { return with_single_; }
    double scale() const override { return scale_; }
    double sigma_tr() const override { return multiple_.sigma_tr(); }

  private:
    PhotonBeamDiffusion multiple_;
    BeamSingleScattering single_;
    bool with_single_;
    double scale_;
};

}  // namespace

const ProfileDescription& quantised_diffusion_profile() {
    static const ProfileDescription description{
        .name = "quantised_diffusion",
        .title = "Quantised diffusion",
        .authors = "E. d'Eon, G. Irving",
        .year = 2011,
        .paper = "A Quantized-Diffusion Model for Rendering Translucent Materials, ACM TOG 30(4)",
        .formula =
            "R = alpha'^2 sum over i of Delta_i G(v_i, r)\n"
            "    [C_phi (w_real - w_image) + C_E (e_real + e_image)]\n"
            "weights in closed form: quantised_diffusion.h",
        .single_scattering = "left out; to be added",
        .options = {{.name = "count",
                     .meaning = "how many Gaussians",
                     .kind = ParameterKind::integer,
                     .low = 2.,
                     .high = 10000.,
                     .otherwise = 40.},
                    moments_option()},
        .make = [](const ProfileMedium& m,
                   const ParameterValues& o) -> std::unique_ptr<RadialProfile> {
            return std::make_unique<QuantisedProfile>(m, o.whole("count"),
                                                      o.choice<MomentModel>("moments"));
        }};
    return description;
}

const ProfileDescription& photon_beam_profile() {
    static const ProfileDescription description{
        .name = "photon_beam_diffusion",
        .title = "Photon beam diffusion",
        .authors = "R. Habel, P. H. Christensen, W. Jarosz",
        .year = 2013,
        .paper =
            "Photon Beam Diffusion: A Hybrid Monte Carlo Method for Subsurface Scattering, "
            "EGSR 2013",
        .formula =
            "R = integral over z of sigma_t' exp(-sigma_t' z) kappa R_pair(r; z, z + 4 A D)\n"
            "R_pair: the better dipole with its source at z\n"
            "kappa = 1 - exp(-2 sigma_t' (d_r + z))",
        .single_scattering = "exact, if asked for by single=on",
        .options = {choice_parameter("kappa", "correction near the source",
                                     {{"on", "the authors' fit"}, {"off", "none"}}),
                    choice_parameter("single", "add light scattered once",
                                     {{"off", "multiple scattering only"},
                                      {"on", "exact single scattering as well"}}),
                    moments_option()},
        .make = [](const ProfileMedium& m,
                   const ParameterValues& o) -> std::unique_ptr<RadialProfile> {
            return std::make_unique<PhotonBeamProfile>(m, o.word("kappa") == "on",
                                                       o.word("single") == "on",
                                                       o.choice<MomentModel>("moments"));
        }};
    return description;
}

}  // namespace nacre
