#pragma once
// A BRDF factored into sums of products of textures, and how far they are from it.
#include <span>

#include "nacre/measured/factor/brdf.h"
#include "nacre/measured/factor/matrix.h"

namespace nacre {

enum class FactorMethod {
    /// Least squares: the singular value decomposition where the whole matrix is known.
    svd,
    /// The same with factors that are nowhere negative.
    nonnegative,
    /// Kautz and McCool's normalised decomposition, one term: g is the mean of each row, h the mean
    /// over the rows of f/g.
    normalised,
};

struct FactorOptions {
    FactorGrid grid;
    FactorMethod method = FactorMethod::svd;
    /// Factors log(f + e), e a thousandth of the mean of f: f is then a product of sums' powers
    /// (M. McCool, J. Ang, A. Ahmad 2001, Homomorphic Factorization of BRDFs, SIGGRAPH).
    bool logarithmic = false;
    /// Rows and columns count with the root of their solid angle times cosine, so that the error is
    /// one of reflected light; else all texels are alike.
    bool weighted = false;
    std::vector<int> terms = {1, 2, 3, 4, 5, 6, 7, 8};  ///< J, ascending
};

/// Root mean squares as parts of the BRDF's own: 1 is the error of a black surface.
struct FactorErrors {
    int terms = 0;
    double matrix = 0.;    ///< of what is factored, in its own norm: never rises with J
    double largest = 0.;   ///< |f' - f| at the texels' pairs, over the largest f
    double weighted = 0.;  ///< of f at these pairs, by cos(theta_i) cos(theta_o) dwi dwo
    /// Of f cos(theta_i) between them, at the directions of fit_samples.h, textures interpolated:
    /// what is rendered.
    double rendered = 0.;
    double rendered_log = 0.;  ///< the same of log(1 + f cos(theta_i))
};

struct Factorisation {
    std::vector<FactoredBrdf> brdfs;  ///< one for each J of the options
    std::vector<FactorErrors> errors;
    /// Of the singular value decomposition of a whole matrix: the first values, by band; else empty.
    std::array<std::vector<double>, 3> sigma;
    int channels = 3;                               ///< 1: red, green and blue are the same
    std::size_t pairs = 0, below = 0, missing = 0;  ///< FactorMatrix
    double seconds_sampling = 0., seconds_factoring = 0.;
};

/// Throws InputError as sample_matrix and sample_target do, and for options that exclude each
/// other: logarithms are negative, so they have no non-negative factors, and the normalised
/// decomposition has one term and no logarithms.
Factorisation factorise(const Target& target, const FactorOptions& options = {});

}  // namespace nacre
