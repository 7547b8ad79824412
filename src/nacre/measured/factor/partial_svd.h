#pragma once
// The largest singular values of a square matrix with their vectors, M = sum_j sigma_j u_j v_j^T.
//
// C. Eckart, G. Young 1936, The Approximation of One Matrix by Another of Lower Rank, Psychometrika
// 1(3): the first J terms are the nearest matrix of rank J, and the square of the Frobenius norm of
// the rest is the sum of the squares of the singular values that are left out.
#include <span>
#include <vector>

namespace nacre {

struct Svd {
    std::vector<double> sigma;              ///< descending
    std::vector<std::vector<double>> u, v;  ///< one of length n for each of them
};

/// The `terms` largest of an n x n matrix, row by row, without the others: Lanczos' method of the
/// library Spectra on M of symmetric matrices (whose singular values are the sizes of the
/// eigenvalues), else on M^T M, the values then taken from M itself. What it finds is checked: M v =
/// sigma u, M^T u = sigma v, orthonormal, nothing larger left. Matrices of which it does not find
/// that (of a rank below what is asked for) and small ones are decomposed in full.
Svd partial_svd(std::span<const double> matrix, int n, int terms);
/// All of them.
Svd full_svd(std::span<const double> matrix, int n);

/// Whether M = M^T within 1e-9 of its largest entry.
bool is_symmetric(std::span<const double> matrix, int n);

}  // namespace nacre
