#ifndef __clang__
// g++ 12 takes the undefined registers of its own AVX-512 headers for variables that nobody set.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#pragma GCC diagnostic ignored "-Wuninitialized"
#endif

#include "nacre/measured/factor/partial_svd.h"

#include <Spectra/SymEigsSolver.h>

#include <algorithm>
#include <numeric>
#include <optional>

#include "nacre/math/random.h"
#include "nacre/measured/factor/thin_svd.h"

namespace nacre {
namespace {

using Eigen::MatrixXd;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using View = Eigen::Map<const RowMajor>;

// Of eigenvalues, relative: those of M^T M are the squares.
constexpr double tolerance = 1e-12;
constexpr int most_restarts = 1000;

std::vector<double> to_vector(const Eigen::VectorXd& v) { return {v.data(), v.data() + v.size()}; }

Svd to_svd(const ThinSvd& svd) {
    Svd r;
    r.sigma = to_vector(svd.sigma);
    for (Eigen::Index j = 0; j < svd.sigma.size(); ++j) {
        r.u.push_back(to_vector(svd.u.col(j)));
        r.v.push_back(to_vector(svd.v.col(j)));
    }
    return r;
}

/// x -> M x of a symmetric matrix, otherwise x -> M^T M x.
class SymmetricProduct {
  public:
    using Scalar = double;
    SymmetricProduct(const View& m, bool symmetric)
        : m_(m), symmetric_(symmetric), product_(m.rows()) {}
    Eigen::Index rows() const { return m_.cols(); }
    Eigen::Index cols() const { return m_.cols(); }
    void perform_op(const double* x, double* y) const {
        product_.noalias() = m_ * Eigen::Map<const Eigen::VectorXd>(x, m_.cols());
        Eigen::Map<Eigen::VectorXd> result(y, m_.cols());
        if (symmetric_)
            result = product_;
        else
            result.noalias() = m_.transpose() * product_;
    }

  private:
    const View& m_;
    bool symmetric_;
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
std::optional<EigenPairs> largest_eigenvalues(SymmetricProduct op, int terms) {
    const int n = int(op.rows());
    Spectra::SymEigsSolver<SymmetricProduct> solver(op, terms,
                                                    std::min(n, std::max(2 * terms + 10, 20)));
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
bool is_svd_of(const View& m, const ThinSvd& svd) {
    const auto& [sigma, u, v] = svd;
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

/// Of a matrix of a rank up to what is asked for and a little more: nothing if it has a higher one.
/// The images of so many random vectors span those of all (N. Halko, P. Martinsson, J. Tropp 2011,
/// Finding Structure with Randomness, SIAM Review 53(2)).
std::optional<Svd> low_rank_svd(const View& m, int terms) {
    const Eigen::Index n = m.rows(), width = std::min<Eigen::Index>(n, 2 * terms + 20);
    Random random(stream_key(31, 1));
    MatrixXd span(n, width);
    for (double& x : span.reshaped()) x = random.next() - 0.5f;
    for (int i = 0; i < 2; ++i) {
        span = i == 0 ? MatrixXd(m * span) : MatrixXd(m * (m.transpose() * span));
        span = orthonormal_basis(span);
    }
    const MatrixXd within = m.transpose() * span;
    if (!((m - span * within.transpose()).norm() <= 1e-12 * m.norm())) return std::nullopt;
    const ThinSvd svd = exact_svd(within);
    return to_svd({svd.sigma.head(terms), span * svd.v.leftCols(terms), svd.u.leftCols(terms)});
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
    const View m(matrix.data(), n, n);
    const ThinSvd svd = quick_svd(m);
    return to_svd(is_svd_of(m, svd) ? svd : exact_svd(m));
}

Svd partial_svd(std::span<const double> matrix, int n, int terms) {
    terms = std::min(terms, n);
    if (4 * terms > n) return first_terms(full_svd(matrix, n), terms);
    const View m(matrix.data(), n, n);
    const bool symmetric = is_symmetric(matrix, n);
    if (auto e = largest_eigenvalues({m, symmetric}, terms)) {
        ThinSvd svd;
        if (symmetric) {
            // A negative eigenvalue is a singular value whose two vectors are opposite.
            const auto sign = [](double x) { return x < 0. ? -1. : 1.; };
            svd.sigma = e->values.cwiseAbs();
            svd.v = std::move(e->vectors);
            svd.u = svd.v * e->values.unaryExpr(sign).asDiagonal();
        } else {
            // The square roots of small eigenvalues would be noise; M itself knows them better.
            svd = exact_svd(m * e->vectors);
            svd.v = e->vectors * svd.v;
        }
        if (is_svd_of(m, svd)) return to_svd(svd);
    }
    if (auto svd = low_rank_svd(m, terms)) return *svd;
    return first_terms(full_svd(matrix, n), terms);
}

}  // namespace nacre
