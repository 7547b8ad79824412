// Profiles of point sources and their images.
#include "nacre/bssrdf/better_dipole.h"
#include "nacre/bssrdf/dipole.h"
#include "nacre/bssrdf/multipole.h"
#include "nacre/bssrdf/profile_models.h"

namespace nacre {

namespace {

Parameter boundary_option() {
    return choice_parameter(
        "boundary", "which reflectance enters the boundary parameter A",
        {{"fit", "one moment by the fit of Jensen et al. 2001, eta from 0.4 to 3"},
         {"exact", "one moment, exact"},
         {"two_moment", "two moments, exact"}});
}

// Dipole and BetterDipole have one face.
template <class Model, const ProfileDescription& (*describe)(), bool single>
class DipoleProfile final : public RadialProfile {
  public:
    template <class Option>
    DipoleProfile(const ProfileMedium& m, Option option)
        : model_(m.sigma_s_prime(), m.sigma_a, m.eta, option) {}

    const ProfileDescription& description() const override { return describe(); }
    double eval(double r) const override { return model_.eval(r * r); }
    double cumulative(double r) const override { return model_.cumulative(r * r); }
    double total() const override { return model_.total(); }
    bool includes_single_scattering() const override { return single; }
    double scale() const override { return model_.z_r; }
    double sigma_tr() const override { return model_.sigma_tr; }

  private:
    Model model_;
};

class MultipoleProfile final : public RadialProfile {
  public:
    MultipoleProfile(const ProfileMedium& m, double thickness, double eta_below,
                     BoundaryModel boundary)
        : model_(m, thickness, eta_below > 0. ? eta_below : m.eta, boundary),
          scale_(1. / m.sigma_t_prime()) {}

    const ProfileDescription& description() const override { return multipole_profile(); }
    double eval(double r) const override { return model_.reflectance(r); }
    double cumulative(double r) const override { return model_.reflectance_within(r); }
    double total() const override { return model_.total_reflectance(); }
    bool includes_single_scattering() const override { return true; }
    double scale() const override { return scale_; }
    double sigma_tr() const override { return model_.sigma_tr(); }

  private:
    Multipole model_;
    double scale_;
};

}  // namespace

const ProfileDescription& dipole_profile() {
    static const ProfileDescription description{
        .name = "dipole",
        .title = "Classical dipole",
        .authors = "H. W. Jensen, S. Marschner, M. Levoy, P. Hanrahan",
        .year = 2001,
        .paper = "A Practical Model for Subsurface Light Transport, SIGGRAPH 2001, eq. 4",
        .formula =
            "R = alpha'/(4 pi) sum over z in {z_r, z_v} of\n"
            "    z (1 + sigma_tr d) exp(-sigma_tr d) / d^3,   d^2 = r^2 + z^2\n"
            "z_r = 1/sigma_t', z_v = z_r (1 + 4 A/3)",
        .single_scattering = "in the total, though not where it leaves",
        .options = {boundary_option()},
        .errata = {"Equation 4 prints 1/sigma_t' for z_v in the second term in one place.",
                   "The published fit of Fdr for eta < 1 ends in 0.0636/eta^3; copies with eta^2 "
                   "circulate."},
        .make = [](const ProfileMedium& m,
                   const ParameterValues& o) -> std::unique_ptr<RadialProfile> {
            return std::make_unique<DipoleProfile<Dipole<double>, dipole_profile, true>>(
                m, o.choice<BoundaryModel>("boundary"));
        }};
    return description;
}

const ProfileDescription& better_dipole_profile() {
    static const ProfileDescription description{
        .name = "better_dipole",
        .title = "Better dipole",
        .authors = "E. d'Eon",
        .year = 2012,
        .paper = "A Better Dipole, technical note",
        .formula =
            "R = alpha'^2 / (4 pi) { C_phi/D (exp(-sigma_tr d_r)/d_r - exp(-sigma_tr d_v)/d_v)\n"
            "    + C_E sum over z of z (1 + sigma_tr d) exp(-sigma_tr d) / d^3 }\n"
            "D = (2 sigma_a + sigma_s') / (3 sigma_t'^2), z_v = z_r + 4 A D",
        .single_scattering = "left out; to be added",
        .options = {choice_parameter(
            "moments", "where the Fresnel moments come from",
            {{"exact", "quadrature"},
             {"fit", "polynomials of d'Eon and Irving 2011, eta from 0.25 to 2.5"}})},
        .errata = {"The factor is alpha'^2; with alpha' the source would count light that was "
                   "scattered once only."},
        .make = [](const ProfileMedium& m,
                   const ParameterValues& o) -> std::unique_ptr<RadialProfile> {
            return std::make_unique<
                DipoleProfile<BetterDipole<double>, better_dipole_profile, false>>(
                m, o.choice<MomentModel>("moments"));
        }};
    return description;
}

const ProfileDescription& multipole_profile() {
    static const ProfileDescription description{
        .name = "multipole",
        .title = "Multipole (reflectance of a slab)",
        .authors = "C. Donner, H. W. Jensen",
        .year = 2005,
        .paper = "Light Diffusion in Multi-Layered Translucent Materials, ACM TOG 24(3)",
        .formula =
            "R = alpha'/(4 pi) sum over i of f(2 i L + l') - f(2 i L - l' - 2 z_b)\n"
            "f(z) = z (1 + sigma_tr d) exp(-sigma_tr d) / d^3\n"
            "l' = 1/sigma_t', z_b = 2 A l'/3, L = thickness + z_b + z_b below",
        .single_scattering = "in the total, though not where it leaves",
        .options = {{.name = "thickness",
                     .meaning = "of the slab, at least the transport mean free path",
                     .unit = "mm",
                     .high = infinite,
                     .above_low = true,
                     .otherwise = 10.},
                    {.name = "eta_below",
                     .meaning = "index of the slab over that of what lies below; 0: as above",
                     .high = infinite},
                    boundary_option()},
        .errata = {"Without absorption the sum must not be integrated term by term."},
        .invertible = false,
        .make = [](const ProfileMedium& m,
                   const ParameterValues& o) -> std::unique_ptr<RadialProfile> {
            return std::make_unique<MultipoleProfile>(m, o.number("thickness"),
                                                      o.number("eta_below"),
                                                      o.choice<BoundaryModel>("boundary"));
        }};
    return description;
}

}  // namespace nacre
