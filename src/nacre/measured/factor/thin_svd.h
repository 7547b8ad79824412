#pragma once
// Eigen's decompositions of dense matrices, in a file of their own, because its templates take long to compile.
#include <Eigen/Core>

namespace nacre {

/// m = u diag(sigma) v^T, sigma falling.
struct ThinSvd {
    Eigen::VectorXd sigma;
    Eigen::MatrixXd u, v;
};
/// By dividing and conquering: quick, and no numbers where many singular values are 0.
ThinSvd quick_svd(const Eigen::MatrixXd& m);
/// By Jacobi's rotations: exact, and slow for large matrices.
ThinSvd exact_svd(const Eigen::MatrixXd& m);
/// An orthonormal basis of the columns' span; at least as many rows as columns.
Eigen::MatrixXd orthonormal_basis(const Eigen::MatrixXd& m);

}  // namespace nacre
