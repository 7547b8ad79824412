#include "nacre/measured/fit_residuals.h"

#include <tbb/parallel_for.h>

#include "nacre/measured/model_slopes.h"

namespace nacre {

FitResiduals::FitResiduals(const FitProblem& problem, const TargetSamples& samples,
                           FitMetric metric)
    : problem_(problem),
      layout_(problem.layout()),
      samples_(samples),
      metric_(metric),
      lobes_(problem.lobes.size()) {
    for (Lobe& lobe : lobes_) lobe.slot.assign(problem.model.parameters.size(), -1);
    for (std::size_t u = 0; u < problem.unknowns.size(); ++u) {
        Lobe& lobe = lobes_[std::size_t(problem.unknowns[u].lobe)];
        if (lobe.unknowns == 0) lobe.first = u;
        for (int i : problem.unknowns[u].parameters) lobe.slot[i] = lobe.unknowns;
        ++lobe.unknowns;
    }
    set_num_residuals(int(problem.bands.size() * samples.size()));
    mutable_parameter_block_sizes()->push_back(layout_.size);
    const double size = target_size(samples, metric);
    for (double w : samples.weight) factor_.push_back(std::sqrt(w / 3.) / size);
}

bool FitResiduals::Evaluate(double const* const* x, double* residuals, double** jacobians) const {
    double* jacobian = jacobians ? jacobians[0] : nullptr;
    const std::size_t n = std::size_t(num_residuals()), wanted = jacobian ? n * layout_.size : 0;
    const std::span<const double> place(x[0], std::size_t(layout_.size));
    if (!last_.is_kept || !std::ranges::equal(last_.x, place) || last_.jacobian.size() < wanted) {
        last_.x.assign(place.begin(), place.end());
        last_.residuals.resize(n);
        last_.jacobian.resize(wanted);
        last_.is_kept =
            compute(x[0], last_.residuals.data(), jacobian ? last_.jacobian.data() : nullptr);
        if (!last_.is_kept) return false;
    }
    std::ranges::copy(last_.residuals, residuals);
    if (jacobian) std::ranges::copy(last_.jacobian, jacobian);
    return true;
}

bool FitResiduals::compute(const double* x, double* residuals, double* jacobian) const {
    std::atomic<bool> finite = true;
    for (std::size_t band = 0; band < problem_.bands.size(); ++band)
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, samples_.size(), 256),
                          [&](const auto& r) {
                              if (!add(x, band, r.begin(), r.end(), residuals, jacobian))
                                  finite = false;
                          });
    return finite;
}

ValuesD FitResiduals::values_at(const double* x, std::size_t lobe, std::size_t band) const {
    ValuesD values = problem_.lobes[lobe][problem_.bands[band]];
    for (int k = 0; k < lobes_[lobe].unknowns; ++k) {
        const std::size_t u = lobes_[lobe].first + k;
        for (int i : problem_.unknowns[u].parameters)
            values.set_scalar(i, x[layout_.first[u] + (problem_.unknowns[u].colour ? band : 0)]);
    }
    return values;
}

void FitResiduals::note_active(const double* x, std::vector<bool>& active) const {
    std::vector<double> residuals(num_residuals());
    std::vector<double> jacobian(residuals.size() * layout_.size);
    double* rows = jacobian.data();
    Evaluate(&x, residuals.data(), &rows);
    for (std::size_t u = 0; u < active.size(); ++u)
        for (std::size_t k = layout_.first[u]; k < jacobian.size() && !active[u]; k += layout_.size)
            active[u] = jacobian[k] != 0.;
}

bool FitResiduals::add(const double* x, std::size_t band, std::size_t begin, std::size_t end,
                       double* residuals, double* jacobian) const {
    const std::size_t n = end - begin, bands = problem_.bands.size();
    const std::vector<int> none(problem_.model.parameters.size(), -1);
    std::vector<double> f(n), value(n), slopes;
    // Derivatives by the unknowns, pair by pair, before the metric.
    std::vector<double> all(jacobian ? n * problem_.unknowns.size() : 0);
    for (std::size_t l = 0; l < lobes_.size(); ++l) {
        const Lobe& lobe = lobes_[l];
        const int slots = jacobian ? lobe.unknowns : 0;
        slopes.resize(n * slots);
        eval_with_slopes(problem_.model, values_at(x, l, band), jacobian ? lobe.slot : none, slots,
                         std::span(samples_.wi).subspan(begin, n),
                         std::span(samples_.wo).subspan(begin, n), value, slopes);
        for (std::size_t k = 0; k < n; ++k) {
            f[k] += value[k];
            for (int u = 0; u < slots; ++u)
                all[k * problem_.unknowns.size() + lobe.first + u] = slopes[k * slots + u];
        }
    }
    bool finite = true;
    for (std::size_t k = 0; k < n; ++k) {
        const std::size_t i = begin + k, row = bands * i + band;
        const double c = samples_.wi[i].z,
                     seen_target = seen(samples_.value[i][problem_.bands[band]] * c, metric_);
        residuals[row] = factor_[i] * (seen(f[k] * c, metric_) - seen_target);
        finite = finite && std::isfinite(residuals[row]);
        if (!jacobian) continue;
        const double chain = factor_[i] * c * seen_slope(f[k] * c, metric_);
        double* to = jacobian + row * layout_.size;
        std::fill(to, to + layout_.size, 0.);
        for (std::size_t u = 0; u < problem_.unknowns.size(); ++u) {
            const double slope = chain * all[k * problem_.unknowns.size() + u];
            // At the ends of ranges roots may have none: such a pair does not pull.
            to[layout_.first[u] + (problem_.unknowns[u].colour ? band : 0)] =
                std::isfinite(slope) ? slope : 0.;
        }
    }
    return finite;
}

}  // namespace nacre
