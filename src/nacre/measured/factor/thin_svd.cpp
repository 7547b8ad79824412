#ifndef __clang__
// g++ 12 takes the undefined registers of its own AVX-512 headers for variables that nobody set.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#pragma GCC diagnostic ignored "-Wuninitialized"
// Fully optimised it takes 27 s to compile, so 20.
#pragma GCC optimize("O1")
#endif

#include "nacre/measured/factor/thin_svd.h"

#include <Eigen/QR>
#include <Eigen/SVD>

namespace nacre {
namespace {

template <class Solver>
ThinSvd solved(const Eigen::MatrixXd& m) {
    const Solver svd(m, Eigen::ComputeThinU | Eigen::ComputeThinV);
    return {svd.singularValues(), svd.matrixU(), svd.matrixV()};
}

}  // namespace

ThinSvd quick_svd(const Eigen::MatrixXd& m) { return solved<Eigen::BDCSVD<Eigen::MatrixXd>>(m); }
ThinSvd exact_svd(const Eigen::MatrixXd& m) { return solved<Eigen::JacobiSVD<Eigen::MatrixXd>>(m); }

Eigen::MatrixXd orthonormal_basis(const Eigen::MatrixXd& m) {
    return Eigen::HouseholderQR<Eigen::MatrixXd>(m).householderQ() *
           Eigen::MatrixXd::Identity(m.rows(), m.cols());
}

}  // namespace nacre
