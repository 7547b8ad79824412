#pragma once
// The homogeneous medium below a flat surface, as every diffusion profile takes it.

namespace nacre {

/// Coefficients in mm^-1; the phase function is Henyey and Greenstein's where a model needs one.
struct ProfileMedium {
    double sigma_s = 1.;  ///< scattering, >= 0
    double sigma_a = 0.;  ///< absorption, >= 0; not both 0
    double g = 0.;        ///< mean cosine of a scattering, in (-1, 1)
    double eta = 1.3;     ///< index of refraction over that outside, > 0

    /// A medium known by its reduced scattering: isotropic, of the same sigma_s'. Single scattering
    /// is then that of an isotropic medium.
    static ProfileMedium reduced(double sigma_s_prime, double sigma_a, double eta) {
        return {sigma_s_prime, sigma_a, 0., eta};
    }

    double sigma_t() const { return sigma_s + sigma_a; }
    double sigma_s_prime() const { return sigma_s * (1. - g); }
    double sigma_t_prime() const { return sigma_s_prime() + sigma_a; }
    /// Reduced albedo alpha'.
    double reduced_albedo() const { return sigma_s_prime() / sigma_t_prime(); }
};

/// Throws InputError, naming the coefficient, its value and its range, unless all lie in theirs.
/// (An albedo above 1 shows as a negative sigma_a.)
void check(const ProfileMedium& medium);

}  // namespace nacre
