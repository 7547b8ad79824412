#include "nacre/reflectance/he_torrance.h"

namespace nacre {

// The manual page of he_torrance.h, apart from it for length.
const ModelDescription& he_torrance_description() {
    static const ModelDescription description{
        .name = "he_torrance",
        .title = "He-Torrance-Sillion-Greenberg",
        .authors = "X. D. He, K. E. Torrance, F. X. Sillion, D. P. Greenberg",
        .year = 1991,
        .paper = "A Comprehensive Physical Model for Light Reflection, SIGGRAPH 91",
        .equations = "4-25, 65-84: specular, directional diffuse, uniform diffuse",
        .formula =
            "f = mirror of share F(wi.z) e^-g S + F(u) G S D/(pi wi.z wo.z) + kd/pi\n"
            "v = wi + wo, u = |v|/2, kappa = 2 pi/lambda, G = (v.v/v_z)^2\n"
            "g = (kappa sigma v_z)^2, sigma = sigma0/sqrt(1 + x^2)\n"
            "x exp(x^2/2) = (K(wi) + K(wo))/sqrt(8 pi), K = tan(theta) erfc(a)\n"
            "a = tau cot(theta)/(2 sigma0), S = S1(wi) S1(wo)\n"
            "S1 = (1 - erfc(a)/2)/(1 + L), L = (exp(-a^2)/(sqrt(pi) a) - erfc(a))/2\n"
            "D = (kappa tau)^2/16 sum_j g^j e^-g/(j! j) exp(-(kappa tau v_xy)^2/(4 j))",
        .parameters =
            {choice_parameter("shadowing", "L",
                              {{"smith", "with exp(-a^2), as B. G. Smith 1967 derives it"},
                               {"printed",
                                "without, as the paper prints it: darker at grazing "
                                "incidence"}}),
             {.name = "kd",
              .meaning = "albedo of the uniform diffuse part, pi a(lambda)",
              .kind = ParameterKind::spectrum,
              .otherwise = 0.},
             {.name = "n",
              .meaning = "index of refraction",
              .kind = ParameterKind::spectrum,
              .high = 10.,
              .above_low = true,
              .otherwise = 0.96,
              .aliases = {"eta"}},
             {.name = "k",
              .meaning = "index of absorption; 0: a dielectric",
              .kind = ParameterKind::spectrum,
              .high = 20.,
              .otherwise = 6.7},
             {.name = "parallel",
              .meaning = "share of the light that is polarised parallel to the plane of incidence; "
                         "1/2: natural light",
              .otherwise = 0.5,
              .aliases = {"h"}},
             {.name = "sigma0",
              .meaning = "standard deviation of the surface's heights",
              .unit = "micrometres",
              .high = 20.,
              .above_low = true,
              .otherwise = 0.18},
             {.name = "tau",
              .meaning = "distance over which the heights' correlation falls to 1/e",
              .unit = "micrometres",
              .high = 1000.,
              .above_low = true,
              .otherwise = 3.},
             {.name = "lambda",
              .meaning = "wavelength; 0: that of the light",
              .kind = ParameterKind::wavelength,
              .unit = "nm",
              .high = 1e6}},
        // The bound is measured: the maximum over sigma0, tau (in wavelengths) and the angle with F
        // = 1, which every other F scales down. It lies at m = 2 sigma0/tau = 0.0039, cot(theta) =
        // 1.66 m and kappa sigma0 m = 0.168; for a diffuse part kd is added.
        .behaviours =
            {{.options = "parallel=0.5",
              .energy = Energy::exceeds,
              .energy_note = "by 6.24 % at most, at 89.629 degrees for facets that reflect "
                             "everything and lambda=83.18 sigma0=0.5721 tau=294.2; rougher "
                             "surfaces return clearly less than they get at grazing incidence, "
                             "where light scatters more than once",
              .witness = "n=1e-8 k=20 lambda=83.18 sigma0=0.5721 tau=294.2",
              .witness_degrees = 89.629,
              .at_most = 1.0625,
              .conditions = {{.parameter = "kd", .high = 0.}},
              .examples = {"sigma0=0.18 tau=3", "sigma0=0.05 tau=1 n=0.2 k=3.4",
                           "sigma0=0.5 tau=2.5 n=1.5 k=0", "sigma0=0.2 tau=2 n=0.2 k=3.4",
                           "shadowing=printed sigma0=0.2 tau=1 n=0.2 k=3.4"}},
             {.options = "parallel=0.5",
              .energy = Energy::exceeds,
              .energy_note = "kd is added without taking anything from the highlight, so keep it "
                             "below what facets do not reflect",
              .witness = "kd=1 n=1e-8 k=20 lambda=83.18 sigma0=0.5721 tau=294.2",
              .witness_degrees = 89.629,
              .at_most = 2.0625,
              .examples = {"sigma0=0.5 tau=2.5 n=1.5 k=0 kd=0.3"}},
             {.options = "parallel=1",
              .reciprocal = false,
              .energy = Energy::exceeds,
              .energy_note = "as for natural light; the polarisation is that of the light, so "
                             "exchanging the directions asks another question",
              .witness = "n=1e-8 k=20 lambda=83.18 sigma0=0.5721 tau=294.2",
              .witness_degrees = 89.629,
              .at_most = 1.0625,
              .conditions = {{.parameter = "kd", .high = 0.}},
              .examples = {"sigma0=0.2 tau=1.5 n=1.5 k=0"}}},
        .sampling =
            "one-sample mixture of the cosine and v_xy from the sum's normal "
            "distributions, j Poisson distributed with the g of the mirror direction; one "
            "wavelength in turn, the density their mean",
        .errata =
            {"L is printed without exp(-a^2), which Smith's has; the authors' code has it too. At "
             "60 degrees it is worth 0.156 of albedo for sigma0 = 0.2, tau = 2.",
             "The quotient of polarisation vectors in G equals (v.v/v_z)^2 identically.",
             "Secondary literature writes g m for g^m in the sum and sums over n; prints L with L "
             "in its own denominator; omits kappa in v_xy; and makes \"Smith and Bruce\" of Bruce "
             "G. Smith.",
             "The uniform diffuse part is given as a(lambda), a BRDF; kd is its albedo, pi a."},
        .references =
            {"X. D. He et al. 1991, SIGGRAPH 91, 175-186",
             "P. Beckmann, A. Spizzichino 1963, The Scattering of Electromagnetic Waves "
             "from Rough Surfaces",
             "B. G. Smith 1967, Geometrical Shadowing of a Random Rough Surface, IEEE TAP "
             "15(5)",
             "N. Holzschuch, R. Pacanowski 2017, A Two-Scale Microfacet Reflectance Model "
             "Combining Reflection and Diffraction, ACM TOG 36(4) (erratum of L)"},
    };
    return description;
}

}  // namespace nacre
