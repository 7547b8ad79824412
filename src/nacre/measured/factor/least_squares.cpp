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
constexpr int first_sweeps = 12, most_sweeps = 40;
constexpr double enough = 1e-3;
constexpr double exact = 1e-13;  // of the square of the matrix: nothing is left to better
constexpr int random_starts = 2;

}  // namespace

struct LeastSquaresFactors::State {
    int n = 0;
    bool nonnegative = false;
    std::vector<VectorXd> g, h;
    RowMajor matrix;            ///< 0 where not known
    RowMajor rest;              ///< what the terms leave of it; 0 where not known
    RowMajor mask;              ///< 1 where known: of the rows that are not known whole
    std::vector<int> mask_row;  ///< where a row stands in it; -1: known whole
    double size2 = 0.;

    bool whole(int k) const { return mask_row[k] < 0; }
    double bounded(double x) const { return nonnegative ? std::max(x, 0.) : x; }

    /// Takes g change^T off the rest. The next pass over the rest does it: passes are what takes
    /// the time.
    struct Pending {
        VectorXd g, change;
    };
    Pending pending;

    /// row -= x^T, at what is known of it.
    void subtract(int k, double factor, const VectorXd& x) {
        if (whole(k))
            rest.row(k) -= factor * x.transpose();
        else
            rest.row(k) -= factor * x.transpose().cwiseProduct(mask.row(mask_row[k]));
    }
    void settle(int k) {
        if (pending.g.size() && pending.g[k] != 0.) subtract(k, pending.g[k], pending.change);
    }
    void settle() {
        for (int k = 0; k < n; ++k) settle(k);
        pending = {};
    }
    double rest2() {
        settle();
        return rest.squaredNorm();
    }

    /// Sets one term to the best for all others.
    void update(std::size_t j) {
        VectorXd above = VectorXd::Zero(n), below = VectorXd::Zero(n);
        const VectorXd h2 = h[j].cwiseAbs2();
        const double all = h2.sum();
        double g2 = 0.;
        for (int k = 0; k < n; ++k) {
            settle(k);
            const double weight = whole(k) ? all : mask.row(mask_row[k]).dot(h2);
            const double old = g[j][k];
            const double now = weight > 0. ? bounded(old + rest.row(k).dot(h[j]) / weight) : old;
            if (now != old) subtract(k, now - old, h[j]);
            g[j][k] = now;
            if (now == 0.) continue;
            above += now * rest.row(k).transpose();
            if (whole(k))
                g2 += now * now;
            else
                below += now * now * mask.row(mask_row[k]).transpose();
        }
        below.array() += g2;
        pending.g = g[j];
        pending.change.resize(n);
        for (int l = 0; l < n; ++l) {
            const double now = below[l] > 0. ? bounded(h[j][l] + above[l] / below[l]) : h[j][l];
            pending.change[l] = now - h[j][l];
            h[j][l] = now;
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
        settle();
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
        double before = rest2();
        for (int i = 0; i < most_sweeps && before > exact * size2; ++i) {
            for (std::size_t j = 0; j < g.size(); ++j) update(j);
            const double now = rest2();
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
        for (int k = 0; k < n; ++k)
            if (!whole(k)) sum.row(k) = sum.row(k).cwiseProduct(mask.row(mask_row[k]));
        const double scale = sum.cwiseProduct(matrix).sum() / sum.squaredNorm();
        for (VectorXd& f : g) f *= scale;
        rest = matrix - scale * sum;
        pending = {};
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
    s.mask_row.assign(n, -1);
    int partial = 0;
    const auto row = [&](int k) { return known.subspan(std::size_t(k) * n, n); };
    for (int k = 0; k < n && !known.empty(); ++k)
        if (std::ranges::find(row(k), 0) != row(k).end()) s.mask_row[k] = partial++;
    s.mask.resize(partial, n);
    for (int k = 0; k < n; ++k)
        for (int l = 0; l < n && s.mask_row[k] >= 0; ++l) s.mask(s.mask_row[k], l) = row(k)[l];
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
        s.settle();
        RowMajor rest = s.rest;
        s.begin_at_random(terms, i);
        s.improve();
        if (s.rest2() < rest.squaredNorm()) continue;
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
    return std::sqrt(state_->rest2() / state_->size2);
}

}  // namespace nacre
