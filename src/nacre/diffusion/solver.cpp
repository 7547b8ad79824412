#include "nacre/diffusion/solver.h"

#include <fmt/format.h>

#include <cmath>

#include "nacre/math/error.h"

namespace nacre {
namespace {

/// The largest of |r| / |b| over the bands; bands without light are solved as they are.
double worst(BandDoubles rr, BandDoubles bb) {
    double most = 0.;
    for (int b = 0; b < BandDoubles::size; ++b)
        if (bb[b] > 0. || !(rr[b] == 0.)) most = std::max(most, std::sqrt(rr[b] / bb[b]));
    return most;
}

BandDoubles quotient(BandDoubles a, BandDoubles b) {
    const BandDoubles zero(0.);
    return select(b > zero, a / select(b > zero, b, BandDoubles(1.)), zero);
}

/// Vectors of a solve, and the cycle on a residual.
class Solve {
  public:
    Solve(Multigrid& multigrid, std::span<const BandDoubles> b, std::vector<BandDoubles>& x)
        : multigrid_(multigrid), b_(b), x_(x), r_(b.size()), in_(b.size()), out_(b.size()) {
        bb_ = sum_over(b.size(), [&](std::size_t i) { return b[i] * b[i]; });
    }

    double residual() { return worst(multigrid_.matrix().residual(x_, b_, r_), bb_); }
    void cycle(bool full) {
        // Scaled, so that the smallest residual is still a good float.
        const BandDoubles rr = dot(r_, r_);
        BandDoubles scale = sqrt(rr * BandDoubles(1. / double(r_.size())));
        const BandDoubles over = quotient(BandDoubles(1.), scale);
        for_blocks(0, r_.size(), [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) in_[i] = to_float(r_[i] * over);
        });
        if (full)
            multigrid_.full_cycle(in_, out_);
        else
            multigrid_.v_cycle(in_, out_);
        scale_ = scale;
    }
    BandDoubles correction(std::size_t i) const { return to_double(out_[i]) * scale_; }
    void add_correction() {
        for_blocks(0, r_.size(), [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) x_[i] += correction(i);
        });
    }
    /// Along the next direction of conjugate gradients; `r_` is the residual.
    void step() {
        cycle(false);
        const std::size_t n = r_.size();
        const BandDoubles rz = sum_over(n, [&](std::size_t i) { return r_[i] * correction(i); });
        BandDoubles beta(0.);
        if (p_.empty()) {
            p_.resize(n);
            ap_.resize(n);
        } else {
            // Of Polak and Ribiere: what a float cycle lacks in symmetry does no harm. Since then
            // r has lost alpha A p.
            const BandDoubles overlap =
                sum_over(n, [&](std::size_t i) { return ap_[i] * correction(i); });
            beta = quotient(BandDoubles(0.) - alpha_ * overlap, rz_);
        }
        for_blocks(0, n, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) p_[i] = correction(i) + beta * p_[i];
        });
        rz_ = rz;
        const BandDoubles pap = multigrid_.matrix().multiply(p_, ap_);
        const BandDoubles rp = dot(r_, p_);
        alpha_ = quotient(rp, pap);
        for_blocks(0, n, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                x_[i] += alpha_ * p_[i];
                r_[i] -= alpha_ * ap_[i];
            }
        });
    }
    double carried_residual() { return worst(dot(r_, r_), bb_); }

  private:
    static BandDoubles dot(std::span<const BandDoubles> a, std::span<const BandDoubles> b) {
        return sum_over(a.size(), [&](std::size_t i) { return a[i] * b[i]; });
    }

    Multigrid& multigrid_;
    std::span<const BandDoubles> b_;
    std::vector<BandDoubles>& x_;
    std::vector<BandDoubles> r_, p_, ap_;
    std::vector<BandFloats> in_, out_;
    BandDoubles bb_, scale_, rz_, alpha_;
};

}  // namespace

double SolveReport::factor() const {
    if (residuals.size() < 3) return residuals.size() < 2 ? 0. : residuals[1] / residuals[0];
    return std::pow(residuals.back() / residuals[1], 1. / double(residuals.size() - 2));
}

SolveReport solve(Multigrid& multigrid, std::span<const BandDoubles> b, std::vector<BandDoubles>& x,
                  const SolveOptions& options, const Work& work) {
    const bool fresh = x.empty();
    if (fresh) x.assign(b.size(), BandDoubles(0.));
    Solve state(multigrid, b, x);
    SolveReport report;
    double left = state.residual();
    report.residuals.push_back(left);
    WorkPhase phase(work, "diffusion", std::uint64_t(options.most_cycles));
    if (fresh && options.full_start && left > options.tolerance) {
        state.cycle(true);
        state.add_correction();
        report.residuals.push_back(left = state.residual());
        report.cycles = 1;
    }
    while (left > options.tolerance) {
        if (!std::isfinite(left) || report.cycles >= options.most_cycles)
            throw RunError(fmt::format(
                "the diffusion equation was not solved to {:g} within {} cycles: {:g} is left; set "
                "a larger tolerance",
                options.tolerance, report.cycles, left));
        phase.advance();
        if (options.method == SolveOptions::Method::v_cycles) {
            state.cycle(false);
            state.add_correction();
            left = state.residual();
        } else {
            state.step();
            left = state.carried_residual();
            if (!(left > options.tolerance)) left = state.residual();
        }
        ++report.cycles;
        report.residuals.push_back(left);
    }
    return report;
}

}  // namespace nacre
