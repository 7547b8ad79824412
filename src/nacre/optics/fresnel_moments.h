#pragma once
// Fresnel reflectance averaged over diffuse light, and the boundary condition of diffusion theory
// that follows from it. Here eta is n_medium / n_outside and the light is inside the medium, so eta
// > 1 means internal reflection with total reflection beyond the critical angle.

namespace nacre {

/// Moment C_k = integral over mu in [0, 1] of F(mu) mu^k, k >= 0, by quadrature: exact to 1e-12 for
/// eta from 1/3 to 3. 0 at eta = 1.
double fresnel_moment(int k, double eta);

/// Cosine-weighted mean reflectance of diffuse light inside the medium, 2 C_1. Closed form (Walsh
/// 1926; Duntley 1942) for eta > 1.01, quadrature closer to 1.
double diffuse_reflectance_internal(double eta);
/// The same for diffuse light from outside; T_ext = eta^2 T_int.
double diffuse_reflectance_external(double eta);

/// Fit to `diffuse_reflectance_internal` of Egan and Hilgeman 1973, Groenhuis et al. 1983, used by
/// Jensen et al. 2001:
///   eta >= 1: -1.440 / eta^2 + 0.710 / eta + 0.668 + 0.0636 eta
///   eta <  1: -0.4399 + 0.7099 / eta - 0.3319 / eta^2 + 0.0636 / eta^3
/// (the last exponent is 3; copies with 2 circulate). 0.0016 at eta = 1, where the truth is 0.
/// Within 0.035 for 0.4 <= eta <= 3; it passes 1 at 3.85 and 0.26.
double diffuse_reflectance_fit(double eta);

/// Polynomial fits to 2 C_1 and 3 C_2 of d'Eon and Irving 2011, A Quantized-Diffusion Model for
/// Rendering Translucent Materials, ACM TOG 30(4). About 1 % off for 0.25 <= eta <= 2.5, beyond
/// which they pass 1; they do not vanish at eta = 1.
double two_c1_fit(double eta);
double three_c2_fit(double eta);

/// Which reflectance enters the boundary parameter A.
enum class BoundaryModel {
    fit,    ///< one moment by `diffuse_reflectance_fit`: A = (1 + Fdr) / (1 - Fdr), Jensen 2001
    exact,  ///< the same with the exact 2 C_1
    two_moment,  ///< A = (1 + 3 C_2) / (1 - 2 C_1), exact moments; consistent with the flux
                 ///< boundary condition (d'Eon 2012) and about 10 % smaller
};

/// Throw InputError for an eta at which the fits no longer follow the truth.
void check_reflectance_fit(double eta);
void check_moment_fits(double eta);

/// A of the boundary condition phi = 2 A D dphi/dz; 1 at eta = 1 for every model. Throws InputError
/// if the fit is asked for beyond its range.
double boundary_parameter(double eta, BoundaryModel model);

}  // namespace nacre
