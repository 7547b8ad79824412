#include "nacre/measured/angle_grid.h"

#include <numbers>

#include "nacre/measured/number_text.h"

namespace nacre {
namespace {

constexpr double pi = std::numbers::pi, rounding = 1e-9;

}  // namespace

AngleAxis::AngleAxis(std::vector<double> values, bool azimuth) : azimuth_(azimuth) {
    std::sort(values.begin(), values.end());
    for (const double v : values)
        if (nodes_.empty() || v > nodes_.back() + rounding) nodes_.push_back(v);
    for (std::size_t i = 1; i < nodes_.size(); ++i)
        largest_step_ = std::max(largest_step_, nodes_[i] - nodes_[i - 1]);
    if (!azimuth || nodes_.size() < 2) return;
    const double open = 2. * pi - (nodes_.back() - nodes_.front());
    round_ = open <= 1.001 * largest_step_ + rounding;
    half_circle_ =
        !round_ && std::abs(nodes_.front()) < 1e-6 && std::abs(nodes_.back() - pi) < 1e-6;
}

int AngleAxis::find(double value) const {
    return int(std::lower_bound(nodes_.begin(), nodes_.end(), value - rounding) - nodes_.begin());
}

bool AngleAxis::fine_enough() const {
    return size() > 1 && largest_step_ <= (azimuth_ ? pi / 3. : pi / 9.) + 1e-6;
}

std::optional<AngleAxis::Place> AngleAxis::place(double x) const {
    const int last = size() - 1;
    if (azimuth_) {
        if (last == 0) return Place{0, 0, 0.};
        x -= 2. * pi * std::floor((x - nodes_.front() + rounding) / (2. * pi));
        if (folded_ && x > pi) x = 2. * pi - x;
        if (x > nodes_.back() + rounding) {
            if (!round_) return std::nullopt;
            const double open = 2. * pi - (nodes_.back() - nodes_.front());
            return Place{last, 0, (x - nodes_.back()) / open};
        }
    } else if (x < nodes_.front() - 0.5 * largest_step_ ||
               x > nodes_.back() + 0.5 * largest_step_) {
        return std::nullopt;
    }
    const int above = int(std::upper_bound(nodes_.begin(), nodes_.end(), x) - nodes_.begin());
    if (above == 0) return Place{0, 0, 0.};
    if (above > last) return Place{last, last, 0.};
    const double low = nodes_[above - 1], high = nodes_[above];
    // Nothing passes the horizon.
    if (!azimuth_ && low < 0.5 * pi && high > 0.5 * pi)
        return x < 0.5 * pi ? Place{above - 1, above - 1, 0.} : Place{above, above, 0.};
    return Place{above - 1, above, (x - low) / (high - low)};
}

std::unique_ptr<Measured> GridMeasured::make(const std::vector<AngleRow>& rows,
                                             const std::vector<double>& values,
                                             const MeasuredInfo& info) {
    auto grid = std::make_unique<GridMeasured>();
    std::array<std::vector<double>, 4> angles;
    const auto of = [&](const AngleRow& r) {
        return info.isotropic ? std::array{r.theta_i, 0., r.theta_o, r.phi_o - r.phi_i}
                              : std::array{r.theta_i, r.phi_i, r.theta_o, r.phi_o};
    };
    for (const AngleRow& r : rows)
        for (int k = 0; k < 4; ++k) angles[k].push_back(of(r)[k]);
    double cells = 1.;
    for (int k = 0; k < 4; ++k) {
        grid->axis_[k] = AngleAxis(std::move(angles[k]), k % 2 == 1);
        // One azimuth of light is all that an isotropic surface needs; one of exits is a section, of
        // which nothing follows for others.
        if (k == 1 && info.isotropic) continue;
        if (!grid->axis_[k].fine_enough()) return nullptr;
        cells *= grid->axis_[k].size();
    }
    // Mirrored at the plane of incidence an isotropic surface is the same; others need not be.
    if (info.isotropic) grid->axis_[3].fold();
    if (cells != double(rows.size())) return nullptr;
    const std::size_t n = std::size_t(info.channels);
    std::vector<bool> taken(rows.size());
    grid->values_.resize(values.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        std::size_t cell = 0;
        for (int k = 0; k < 4; ++k)
            cell = cell * grid->axis_[k].size() + grid->axis_[k].find(of(rows[i])[k]);
        if (taken[cell]) return nullptr;
        taken[cell] = true;
        grid->cell_.push_back(cell);
        std::copy_n(values.begin() + std::ptrdiff_t(i * n), n,
                    grid->values_.begin() + std::ptrdiff_t(cell * n));
    }
    grid->rows_ = rows;
    grid->info_ = info;
    grid->info_.parameterisation = fmt::format(
        "grid of theta_i ({}), phi_i ({}), theta_o ({}), phi_o ({})", grid->axis_[0].size(),
        grid->axis_[1].size(), grid->axis_[2].size(), grid->axis_[3].size());
    grid->count_samples();
    if (grid->info_.missing == grid->info_.samples) return nullptr;
    grid->info_.reflection_front = grid->info_.transmission_front = false;
    grid->for_each_sample([&](const MeasuredSample& s) {
        if (s.state == SampleState::missing) return;
        (s.wo.z > 0. ? grid->info_.reflection_front : grid->info_.transmission_front) = true;
    });
    return grid;
}

bool GridMeasured::eval(const Vec3d& wi, const Vec3d& wo, std::span<double> out) const {
    if (!(wi.z > 0.) || !(std::abs(wo.z) > 0.)) return false;
    const auto theta = [](const Vec3d& w) { return std::atan2(std::hypot(w.x, w.y), w.z); };
    const auto phi = [](const Vec3d& w) {
        return w.x == 0. && w.y == 0. ? 0. : std::atan2(w.y, w.x);
    };
    const bool isotropic = info_.isotropic;
    const double angles[4] = {theta(wi), isotropic ? 0. : phi(wi), theta(wo),
                              isotropic ? phi(wo) - phi(wi) : phi(wo)};
    AngleAxis::Place at[4];
    for (int k = 0; k < 4; ++k) {
        if (!std::isfinite(angles[k])) return false;
        const auto place = axis_[k].place(angles[k]);
        if (!place) return false;
        at[k] = *place;
    }
    const std::size_t n = std::size_t(info_.channels);
    double found = 0.;
    std::fill_n(out.begin(), n, 0.);
    for (int corner = 0; corner < 16; ++corner) {
        double weight = 1.;
        std::size_t cell = 0;
        for (int k = 0; k < 4; ++k) {
            const bool up = corner >> k & 1;
            weight *= up ? at[k].part : 1. - at[k].part;
            cell = cell * axis_[k].size() + (up ? at[k].high : at[k].low);
        }
        if (!(weight > 0.)) continue;
        const double* v = values_.data() + cell * n;
        bool known = true;
        for (std::size_t c = 0; c < n; ++c) known = known && !std::isnan(v[c]);
        if (!known) continue;
        for (std::size_t c = 0; c < n; ++c) out[c] += weight * v[c];
        found += weight;
    }
    // As for MERL: what is not measured is left out, while less than half of the weight is.
    if (found < 0.5) return false;
    for (std::size_t c = 0; c < n; ++c) out[c] /= found;
    return true;
}

void GridMeasured::for_each_sample(const std::function<void(const MeasuredSample&)>& visit) const {
    const std::size_t n = std::size_t(info_.channels);
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        const std::span<const double> value(values_.data() + cell_[i] * n, n);
        bool missing = false, negative = false;
        for (const double v : value) {
            missing = missing || std::isnan(v);
            negative = negative || v < 0.;
        }
        visit({polar_direction(rows_[i].theta_i, rows_[i].phi_i),
               polar_direction(rows_[i].theta_o, rows_[i].phi_o),
               missing    ? SampleState::missing
               : negative ? SampleState::negative
                          : SampleState::good,
               value});
    }
}

}  // namespace nacre
