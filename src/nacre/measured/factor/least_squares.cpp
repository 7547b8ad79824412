// g++ 12 takes the undefined registers of its own AVX-512 headers for variables that nobody set.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"

#include "nacre/measured/factor/least_squares.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "nacre/math/random.h"

namespace nacre {
namespace {

using Eigen::VectorXd;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Of a term that is new, alone; of all together, at most, and until one of them lowers the square of
// the error by less than this share.
constexpr int first_sweeps = 12, most_sweeps = 60;
constexpr double enough = 1e-3;
constexpr int random_starts = 2;

}  // namespace

struct LeastSquaresFactors::State {
    int n = 0;
    bool nonnegative = false;
    std::vector<VectorXd> g, h;
    RowMajor matrix;  ///< 0 where not known
    RowMajor rest;    ///< what the terms leave of it; 0 where not known
    RowMajor mask;    ///< 1 where known; empty if that is everywhere
    double size2 = 0.;

    double bounded(double x) const { return nonnegative ? std::max(x, 0.) : x; }

    /// Sets one term to the best for all others.
    void update(std::size_t j) {
        VectorXd above = VectorXd::Zero(n), below = VectorXd::Zero(n);
        const bool all = mask.size() == 0;
        const VectorXd h2 = h[j].cwiseAbs2();
        const double whole = h2.sum();
        double g2 = 0.;
        for (int k = 0; k < n; ++k) {
            auto row = rest.row(k);
            const double weight = all ? whole : mask.row(k).dot(h2);
            const double old = g[j][k];
            const double now = weight > 0. ? bounded(old + row.dot(h[j]) / weight) : old;
            const double change = now - old;
            if (change != 0.) {
                if (all)
                    row -= change * h[j].transpose();
                else
                    row -= change * h[j].transpose().cwiseProduct(mask.row(k));
            }
            g[j][k] = now;
            if (now == 0.) continue;
            above += now * row.transpose();
            if (all)
                g2 += now * now;
            else
                below += now * now * mask.row(k).transpose();
        }
        if (all) below.setConstant(g2);
        VectorXd change(n);
        for (int l = 0; l < n; ++l) {
            const double now = below[l] > 0. ? bounded(h[j][l] + above[l] / below[l]) : h[j][l];
            change[l] = now - h[j][l];
            h[j][l] = now;
        }
        for (int k = 0; k < n; ++k) {
            if (g[j][k] == 0.) continue;
            if (all)
                rest.row(k) -= g[j][k] * change.transpose();
            else
                rest.row(k) -= g[j][k] * change.transpose().cwiseProduct(mask.row(k));
        }
        balance(j);
    }
    /// Both of a term the same size.
    void balance(std::size_t j) {
        const double a = g[j].norm(), b = h[j].norm();
        if (!(a > 0. && b > 0.)) return;
        const double s = std::sqrt(b / a);
        g[j] *= s;
        h[j] /= s;
    }
    /// A new term that begins as the row of the rest that holds the most.
    void add() {
        int most = 0;
        double largest = -1.;
        for (int k = 0; k < n; ++k) {
            const double s =
                nonnegative ? rest.row(k).cwiseMax(0.).squaredNorm() : rest.row(k).squaredNorm();
            if (s > largest) largest = s, most = k;
        }
        VectorXd start = rest.row(most).transpose();
        if (nonnegative) start = start.cwiseMax(0.);
        g.push_back(VectorXd::Zero(n));
        h.push_back(std::move(start));
        for (int i = 0; i < first_sweeps; ++i) update(g.size() - 1);
    }
    void improve() {
        double before = rest.squaredNorm();
        for (int i = 0; i < most_sweeps && before > 1e-28 * size2; ++i) {
            for (std::size_t j = 0; j < g.size(); ++j) update(j);
            const double now = rest.squaredNorm();
            if (now >= (1. - enough) * before) break;
            before = now;
        }
    }
    void begin_at_random(int terms, std::uint64_t number) {
        Random random(stream_key(29, number, terms));
        g.assign(terms, VectorXd(n));
        h.assign(terms, VectorXd(n));
        for (auto* factors : {&g, &h})
            for (VectorXd& f : *factors)
                for (int k = 0; k < n; ++k) f[k] = 0.01 + random.next();
        // The best multiple of the sum.
        RowMajor sum = RowMajor::Zero(n, n);
        for (int j = 0; j < terms; ++j) sum.noalias() += g[j] * h[j].transpose();
        if (mask.size()) sum = sum.cwiseProduct(mask);
        const double scale = sum.cwiseProduct(matrix).sum() / sum.squaredNorm();
        for (VectorXd& f : g) f *= scale;
        rest = matrix - scale * sum;
    }
};

LeastSquaresFactors::LeastSquaresFactors(std::span<const double> matrix,
                                         std::span<const std::uint8_t> known, int n,
                                         bool nonnegative)
    : state_(std::make_unique<State>()) {
    State& s = *state_;
    s.n = n;
    s.nonnegative = nonnegative;
    s.matrix = Eigen::Map<const RowMajor>(matrix.data(), n, n);
    s.rest = s.matrix;
    s.size2 = s.matrix.squaredNorm();
    if (!known.empty())
        s.mask =
            Eigen::Map<
                const Eigen::Matrix<std::uint8_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
                known.data(), n, n)
                .cast<double>();
}

LeastSquaresFactors::~LeastSquaresFactors() = default;

void LeastSquaresFactors::grow_to(int terms) {
    State& s = *state_;
    if (int(s.g.size()) >= terms) return;
    while (int(s.g.size()) < terms) s.add();
    s.improve();
    if (!s.nonnegative || terms == 1) return;
    for (int i = 0; i < random_starts; ++i) {
        auto g = s.g, h = s.h;
        RowMajor rest = s.rest;
        s.begin_at_random(terms, i);
        s.improve();
        if (s.rest.squaredNorm() < rest.squaredNorm()) continue;
        s.g = std::move(g);
        s.h = std::move(h);
        s.rest = std::move(rest);
    }
}

FactorTerms LeastSquaresFactors::terms() const {
    FactorTerms r;
    for (const VectorXd& f : state_->g) r.g.emplace_back(f.data(), f.data() + f.size());
    for (const VectorXd& f : state_->h) r.h.emplace_back(f.data(), f.data() + f.size());
    return r;
}

double LeastSquaresFactors::relative_error() const {
    return std::sqrt(state_->rest.squaredNorm() / state_->size2);
}

}  // namespace nacre
