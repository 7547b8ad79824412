#ifndef __clang__
// g++ 12 takes the undefined registers of its own AVX-512 headers for variables that nobody set.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#pragma GCC diagnostic ignored "-Wuninitialized"
// Optimised fully it takes a quarter to a third longer to compile.
#pragma GCC optimize("O1")
#endif

#include "nacre/measured/factor/thin_svd.h"

#include <Eigen/SVD>

namespace nacre {

ThinSvd quick_svd(const Eigen::MatrixXd& m) {
    const Eigen::BDCSVD<Eigen::MatrixXd> svd(m, Eigen::ComputeThinU | Eigen::ComputeThinV);
    return {svd.singularValues(), svd.matrixU(), svd.matrixV()};
}

}  // namespace nacre
