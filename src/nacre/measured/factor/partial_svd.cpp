// g++ 12 takes the undefined registers of its own AVX-512 headers for variables that nobody set.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"

#include "nacre/measured/factor/partial_svd.h"

#include <Spectra/MatOp/DenseSymMatProd.h>
#include <Spectra/SymEigsSolver.h>
#include <Eigen/SVD>

#include <algorithm>
#include <numeric>
#include <optional>

namespace nacre {
namespace {

using Eigen::MatrixXd;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using View = Eigen::Map<const RowMajor>;

// Of eigenvalues, relative: those of M^T M are the squares.
constexpr double tolerance = 1e-12;
constexpr int most_restarts = 1000;

std::vector<double> to_vector(const Eigen::VectorXd& v) { return {v.data(), v.data() + v.size()}; }

Svd to_svd(const Eigen::VectorXd& sigma, const MatrixXd& u, const MatrixXd& v) {
    Svd r;
    r.sigma = to_vector(sigma);
    for (Eigen::Index j = 0; j < sigma.size(); ++j) {
        r.u.push_back(to_vector(u.col(j)));
        r.v.push_back(to_vector(v.col(j)));
    }
    return r;
}

/// x -> M^T M x.
class GramProduct {
  public:
    using Scalar = double;
    explicit GramProduct(const View& m) : m_(m), product_(m.rows()) {}
    Eigen::Index rows() const { return m_.cols(); }
    Eigen::Index cols() const { return m_.cols(); }
    void perform_op(const double* x, double* y) const {
        product_.noalias() = m_ * Eigen::Map<const Eigen::VectorXd>(x, m_.cols());
        Eigen::Map<Eigen::VectorXd>(y, m_.cols()).noalias() = m_.transpose() * product_;
    }

  private:
    const View& m_;
    mutable Eigen::VectorXd product_;
};

struct EigenPairs {
    Eigen::VectorXd values;
    MatrixXd vectors;
};

/// The eigenvalues of the largest size; nothing if they did not converge.
template <class Operator>
std::optional<EigenPairs> largest_eigenvalues(Operator& op, int terms) {
    const int n = int(op.rows());
    Spectra::SymEigsSolver<Operator> solver(op, terms, std::min(n, std::max(2 * terms + 10, 20)));
    Eigen::Index found = 0;
    try {
        solver.init();
        found = solver.compute(Spectra::SortRule::LargestMagn, most_restarts, tolerance,
                               Spectra::SortRule::LargestMagn);
    } catch (const std::exception&) {
        // A matrix of lower rank than what is asked for may leave it without directions to go on.
        return std::nullopt;
    }
    if (found < terms || solver.info() != Spectra::CompInfo::Successful) return std::nullopt;
    return EigenPairs{solver.eigenvalues(), solver.eigenvectors()};
}

Svd first_terms(Svd svd, int terms) {
    svd.sigma.resize(terms);
    svd.u.resize(terms);
    svd.v.resize(terms);
    return svd;
}

}  // namespace

bool is_symmetric(std::span<const double> matrix, int n) {
    const double largest = View(matrix.data(), n, n).cwiseAbs().maxCoeff();
    for (int k = 0; k < n; ++k)
        for (int l = 0; l < k; ++l)
            if (!(std::abs(matrix[std::size_t(k) * n + l] - matrix[std::size_t(l) * n + k]) <=
                  1e-9 * largest))
                return false;
    return true;
}

Svd full_svd(std::span<const double> matrix, int n) {
    const Eigen::BDCSVD<MatrixXd> svd(View(matrix.data(), n, n),
                                      Eigen::ComputeThinU | Eigen::ComputeThinV);
    return to_svd(svd.singularValues(), svd.matrixU(), svd.matrixV());
}

Svd partial_svd(std::span<const double> matrix, int n, int terms) {
    terms = std::min(terms, n);
    if (4 * terms > n) return first_terms(full_svd(matrix, n), terms);
    const View m(matrix.data(), n, n);
    if (is_symmetric(matrix, n)) {
        Spectra::DenseSymMatProd<double, Eigen::Lower, Eigen::RowMajor> op(m);
        const auto e = largest_eigenvalues(op, terms);
        if (!e) return first_terms(full_svd(matrix, n), terms);
        // A negative eigenvalue is a singular value whose two vectors are opposite.
        const Eigen::VectorXd signs =
            e->values.unaryExpr([](double x) { return x < 0. ? -1. : 1.; });
        return to_svd(e->values.cwiseAbs(), e->vectors * signs.asDiagonal(), e->vectors);
    }
    GramProduct op(m);
    const auto e = largest_eigenvalues(op, terms);
    if (!e) return first_terms(full_svd(matrix, n), terms);
    // The square roots of small eigenvalues would be noise; M itself knows them better.
    const Eigen::JacobiSVD<MatrixXd> svd(m * e->vectors, Eigen::ComputeThinU | Eigen::ComputeThinV);
    return to_svd(svd.singularValues(), svd.matrixU(), e->vectors * svd.matrixV());
}

}  // namespace nacre
