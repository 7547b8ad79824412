// g++ 12 takes the undefined registers of its own AVX-512 headers for variables that nobody set.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"

#include "nacre/measured/factor/partial_svd.h"

#include <Spectra/MatOp/DenseSymMatProd.h>
#include <Spectra/SymEigsSolver.h>
#include <Eigen/SVD>

#include <algorithm>
#include <numeric>
#include <optional>

#include "nacre/math/random.h"

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

// Of what is checked: departures from 1 and 0, or of a product from the largest singular value.
constexpr double allowed = 1e-8;

bool is_orthonormal(const MatrixXd& v) {
    const double off =
        (v.transpose() * v - MatrixXd::Identity(v.cols(), v.cols())).cwiseAbs().maxCoeff();
    return off <= allowed;
}

/// The eigenvalues of the largest size; nothing if they were not found.
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
        return std::nullopt;
    }
    if (found < terms || solver.info() != Spectra::CompInfo::Successful) return std::nullopt;
    EigenPairs r{solver.eigenvalues(), solver.eigenvectors()};
    // The solver makes up directions where a matrix of low rank leaves none, and then says that it
    // was successful.
    if (!is_orthonormal(r.vectors)) return std::nullopt;
    return r;
}

/// Whether these are singular values and vectors, and no larger value is left.
bool is_svd_of(const View& m, const Eigen::VectorXd& sigma, const MatrixXd& u, const MatrixXd& v) {
    const double scale = sigma[0];
    if (!is_orthonormal(u) || !is_orthonormal(v)) return false;
    const MatrixXd forward = m * v - u * sigma.asDiagonal();
    const MatrixXd back = m.transpose() * u - v * sigma.asDiagonal();
    if (!(forward.cwiseAbs().maxCoeff() <= allowed * scale) ||
        !(back.cwiseAbs().maxCoeff() <= allowed * scale))
        return false;
    // The power method on what is left comes near its largest value from below.
    Random random(stream_key(31, m.rows()));
    Eigen::VectorXd x(m.cols()), y;
    for (double& value : x) value = random.next() - 0.5f;
    double left = 0.;
    for (int i = 0; i < 12; ++i) {
        x /= std::max(x.norm(), 1e-300);
        y = m * x - u * sigma.cwiseProduct(v.transpose() * x);
        left = y.norm();
        x = m.transpose() * y - v * sigma.cwiseProduct(u.transpose() * y);
    }
    return left <= sigma[sigma.size() - 1] * (1. + allowed) + allowed * scale;
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
    Eigen::VectorXd sigma;
    MatrixXd u, v;
    if (is_symmetric(matrix, n)) {
        Spectra::DenseSymMatProd<double, Eigen::Lower, Eigen::RowMajor> op(m);
        if (auto e = largest_eigenvalues(op, terms)) {
            // A negative eigenvalue is a singular value whose two vectors are opposite.
            const auto sign = [](double x) { return x < 0. ? -1. : 1.; };
            sigma = e->values.cwiseAbs();
            v = std::move(e->vectors);
            u = v * e->values.unaryExpr(sign).asDiagonal();
        }
    } else {
        GramProduct op(m);
        if (const auto e = largest_eigenvalues(op, terms)) {
            // The square roots of small eigenvalues would be noise; M itself knows them better.
            const Eigen::JacobiSVD<MatrixXd> svd(m * e->vectors,
                                                 Eigen::ComputeThinU | Eigen::ComputeThinV);
            sigma = svd.singularValues();
            u = svd.matrixU();
            v = e->vectors * svd.matrixV();
        }
    }
    if (sigma.size() == 0 || !is_svd_of(m, sigma, u, v))
        return first_terms(full_svd(matrix, n), terms);
    return to_svd(sigma, u, v);
}

}  // namespace nacre
