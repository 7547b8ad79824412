#include "nacre/measured/fit_residuals.h"

#include <tbb/parallel_for.h>

#include "nacre/measured/model_slopes.h"

namespace nacre {

FitResiduals::FitResiduals(const ModelDescription& model, const std::array<ValuesD, 3>& fixed,
                           const std::vector<Unknown>& unknowns, const TargetSamples& samples,
                           FitMetric metric)
    : model_(model),
      fixed_(fixed),
      unknowns_(unknowns),
      layout_(unknowns),
      samples_(samples),
      metric_(metric),
      slot_(model.parameters.size(), -1) {
    for (std::size_t u = 0; u < unknowns.size(); ++u)
        for (int i : unknowns[u].parameters) slot_[i] = int(u);
    set_num_residuals(int(3 * samples.size()));
    mutable_parameter_block_sizes()->push_back(layout_.size);
    const double size = target_size(samples, metric);
    for (double w : samples.weight) factor_.push_back(std::sqrt(w / 3.) / size);
}

bool FitResiduals::Evaluate(double const* const* x, double* residuals, double** jacobians) const {
    double* jacobian = jacobians ? jacobians[0] : nullptr;
    std::atomic<bool> finite = true;
    for (int band = 0; band < 3; ++band) {
        const ValuesD values = values_at(x[0], band);
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, samples_.size(), 256),
                          [&](const auto& r) {
                              if (!add(values, band, r.begin(), r.end(), residuals, jacobian))
                                  finite = false;
                          });
    }
    return finite;
}

ValuesD FitResiduals::values_at(const double* x, int band) const {
    ValuesD values = fixed_[band];
    for (std::size_t u = 0; u < unknowns_.size(); ++u)
        for (int i : unknowns_[u].parameters)
            values.set_scalar(i, x[layout_.first[u] + (unknowns_[u].colour ? band : 0)]);
    return values;
}

void FitResiduals::note_active(const double* x, std::vector<bool>& active) const {
    std::vector<double> residuals(num_residuals());
    std::vector<double> jacobian(residuals.size() * layout_.size);
    double* rows = jacobian.data();
    Evaluate(&x, residuals.data(), &rows);
    for (std::size_t u = 0; u < unknowns_.size(); ++u)
        for (std::size_t k = layout_.first[u]; k < jacobian.size() && !active[u]; k += layout_.size)
            active[u] = jacobian[k] != 0.;
}

bool FitResiduals::add(const ValuesD& values, int band, std::size_t begin, std::size_t end,
                       double* residuals, double* jacobian) const {
    const std::size_t n = end - begin;
    const int slots = jacobian ? int(unknowns_.size()) : 0;
    const std::vector<int> none(slot_.size(), -1);
    std::vector<double> value(n), slopes(n * slots);
    eval_with_slopes(model_, values, jacobian ? slot_ : none, slots,
                     std::span(samples_.wi).subspan(begin, n),
                     std::span(samples_.wo).subspan(begin, n), value, slopes);
    bool finite = true;
    for (std::size_t k = 0; k < n; ++k) {
        const std::size_t i = begin + k, row = 3 * i + band;
        const double c = samples_.wi[i].z, f = value[k] * c;
        residuals[row] =
            factor_[i] * (seen(f, metric_) - seen(samples_.value[i][band] * c, metric_));
        finite = finite && std::isfinite(residuals[row]);
        if (!jacobian) continue;
        const double chain =
            factor_[i] * c * (metric_ == FitMetric::cosine ? 1. : 1. / (1. + std::max(f, 0.)));
        double* to = jacobian + row * layout_.size;
        std::fill(to, to + layout_.size, 0.);
        for (int u = 0; u < slots; ++u) {
            const double slope = chain * slopes[k * slots + u];
            // At the ends of ranges roots may have none: such a pair does not pull.
            to[layout_.first[u] + (unknowns_[u].colour ? band : 0)] =
                std::isfinite(slope) ? slope : 0.;
        }
    }
    return finite;
}

}  // namespace nacre
