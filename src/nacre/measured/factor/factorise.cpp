#include "nacre/measured/factor/factorise.h"

#include <tbb/parallel_for.h>

#include <chrono>

#include "nacre/math/error.h"
#include "nacre/measured/factor/least_squares.h"
#include "nacre/measured/factor/partial_svd.h"
#include "nacre/measured/fit_samples.h"

namespace nacre {
namespace {

void check(const FactorOptions& o) {
    if (o.terms.empty() || !std::ranges::is_sorted(o.terms, std::less_equal<>()) ||
        o.terms.front() < 1)
        throw InputError("numbers of terms must be whole, above 0 and ascend");
    if (o.terms.back() > o.grid.count())
        throw InputError(fmt::format("a matrix of {0} x {0} has at most {0} terms, not {1}",
                                     o.grid.count(), o.terms.back()));
    if (o.logarithmic && o.method != FactorMethod::svd)
        throw InputError(o.method == FactorMethod::nonnegative
                             ? "logarithms are negative where f is small: they have no "
                               "non-negative factors"
                             : "the normalised decomposition is one of f, not of its logarithm");
    if (o.method == FactorMethod::normalised && o.terms.back() != 1)
        throw InputError("the normalised decomposition has one term: J = 1");
}

/// The matrix of one band as it is factored: logarithms if asked for, then rows and columns
/// weighted.
struct Scaled {
    std::vector<double> values;
    std::vector<double> row, column;  ///< weights; empty: all 1
    double floor = 0.;                ///< what was added to f before its logarithm
};

Scaled scale(const FactorMatrix& m, int channel, const FactorOptions& o) {
    const int n = m.grid.count();
    Scaled s;
    s.values = m.values[channel];
    if (o.logarithmic) {
        double sum = 0.;
        for (double v : s.values) sum += std::max(v, 0.);
        const double mean = sum / double(m.size() - m.below - m.missing);
        s.floor = std::max(1e-3 * mean, 1e-30);
        for (std::size_t i = 0; i < s.values.size(); ++i)
            s.values[i] = m.has(i) ? std::log(std::max(s.values[i], 0.) + s.floor) : 0.;
    }
    if (!o.weighted) return s;
    for (int k = 0; k < n; ++k) {
        s.row.push_back(std::sqrt(m.grid.row_weight(k)));
        s.column.push_back(std::sqrt(m.grid.column_weight(k)));
    }
    for (int k = 0; k < n; ++k)
        for (int l = 0; l < n; ++l) s.values[std::size_t(k) * n + l] *= s.row[k] * s.column[l];
    return s;
}

/// Factors of the matrix itself from those of the weighted one.
FactorTerms unscaled(FactorTerms terms, const Scaled& s) {
    if (s.row.empty()) return terms;
    for (std::size_t j = 0; j < terms.g.size(); ++j)
        for (std::size_t k = 0; k < s.row.size(); ++k) {
            terms.g[j][k] /= s.row[k];
            terms.h[j][k] /= s.column[k];
        }
    return terms;
}

/// Each singular value is shared evenly by its two textures.
FactorTerms terms_of(const Svd& svd, int count) {
    FactorTerms r;
    for (int j = 0; j < count; ++j) {
        r.g.push_back(svd.u[j]);
        r.h.push_back(svd.v[j]);
        for (auto* factor : {&r.g.back(), &r.h.back()})
            for (double& x : *factor) x *= std::sqrt(svd.sigma[j]);
    }
    return r;
}

FactorTerms normalised(const FactorMatrix& m, const std::vector<double>& values) {
    const int n = m.grid.count();
    FactorTerms r{{std::vector<double>(n)}, {std::vector<double>(n)}};
    std::vector<double>&g = r.g[0], &h = r.h[0];
    std::vector<int> count(n);
    for (int k = 0; k < n; ++k) {
        double sum = 0.;
        int known = 0;
        for (int l = 0; l < n; ++l) {
            const std::size_t at = std::size_t(k) * n + l;
            sum += values[at];
            known += m.has(at);
        }
        if (!(sum > 0.)) continue;
        g[k] = sum / known;
        for (int l = 0; l < n; ++l) {
            const std::size_t at = std::size_t(k) * n + l;
            h[l] += values[at] / g[k];
            count[l] += m.has(at);
        }
    }
    for (int l = 0; l < n; ++l)
        if (count[l] > 0) h[l] /= count[l];
    return r;
}

/// The factors of one band, for each number of terms.
std::vector<FactorTerms> factor(const FactorMatrix& m, const Scaled& s, const FactorOptions& o,
                                std::vector<double>& sigma) {
    const int n = m.grid.count();
    std::vector<FactorTerms> r;
    if (o.method == FactorMethod::normalised) return {unscaled(normalised(m, s.values), s)};
    if (o.method == FactorMethod::svd && m.known.empty()) {
        const Svd svd = partial_svd(s.values, n, o.terms.back());
        sigma = svd.sigma;
        for (int count : o.terms) r.push_back(unscaled(terms_of(svd, count), s));
        return r;
    }
    LeastSquaresFactors factors(s.values, m.known, n, o.method == FactorMethod::nonnegative);
    for (int count : o.terms) {
        factors.grow_to(count);
        r.push_back(unscaled(factors.terms(), s));
    }
    return r;
}

/// Sums over the pairs that are known.
struct Sums {
    double left = 0., all = 0.;                    ///< of what is factored
    double left_weighted = 0., all_weighted = 0.;  ///< of f
    double largest_left = 0., largest = 0.;

    void operator+=(const Sums& s) {
        left += s.left, all += s.all;
        left_weighted += s.left_weighted, all_weighted += s.all_weighted;
        largest_left = std::max(largest_left, s.largest_left);
        largest = std::max(largest, s.largest);
    }
};

Sums sums_of(const FactorMatrix& m, int channel, const Scaled& s, const FactorTerms& terms,
             bool logarithmic, const std::vector<double>& measure) {
    const int n = m.grid.count();
    std::vector<Sums> rows(n);
    tbb::parallel_for(0, n, [&](int k) {
        std::vector<double> row(n);
        for (std::size_t j = 0; j < terms.g.size(); ++j) {
            const double g = terms.g[j][k];
            const double* h = terms.h[j].data();
            for (int l = 0; l < n; ++l) row[l] += g * h[l];
        }
        Sums& sum = rows[k];
        for (int l = 0; l < n; ++l) {
            const std::size_t at = std::size_t(k) * n + l;
            if (!m.has(at)) continue;
            const double weight = s.row.empty() ? 1. : s.row[k] * s.column[l];
            const double rest = s.values[at] - weight * row[l];
            const double f = m.values[channel][at];
            const double off = (logarithmic ? std::exp(row[l]) : std::max(row[l], 0.)) - f;
            sum += {rest * rest,
                    s.values[at] * s.values[at],
                    measure[at] * off * off,
                    measure[at] * f * f,
                    std::abs(off),
                    f};
        }
    });
    Sums all;
    for (const Sums& r : rows) all += r;
    return all;
}

std::vector<double> measures(const FactorGrid& grid) {
    const int n = grid.count();
    std::vector<double> r(std::size_t(n) * n);
    tbb::parallel_for(0, n, [&](int k) {
        for (int l = 0; l < n; ++l) r[std::size_t(k) * n + l] = grid.measure(k, l);
    });
    return r;
}

void add_rendered_errors(const TargetSamples& samples, const FactoredBrdf& brdf, FactorErrors& e) {
    std::vector<Vec3d> found(samples.size());
    tbb::parallel_for(std::size_t(0), samples.size(), [&](std::size_t i) {
        found[i] = brdf.value(samples.wi[i], samples.wo[i]).value_or(Vec3d{});
    });
    double sum[2] = {};
    for (std::size_t i = 0; i < samples.size(); ++i)
        for (int c = 0; c < 3; ++c)
            for (const FitMetric metric : {FitMetric::cosine, FitMetric::log}) {
                const double cosine = samples.wi[i].z;
                const double off =
                    seen(found[i][c] * cosine, metric) - seen(samples.value[i][c] * cosine, metric);
                sum[int(metric)] += samples.weight[i] * off * off / 3.;
            }
    e.rendered = std::sqrt(sum[0]) / target_size(samples, FitMetric::cosine);
    e.rendered_log = std::sqrt(sum[1]) / target_size(samples, FitMetric::log);
}

/// The terms of one or three bands as textures.
std::vector<FactorTerm> textures(const std::array<const FactorTerms*, 3>& bands) {
    std::vector<FactorTerm> r(bands[0]->g.size());
    const auto texture = [&](auto&& of) {
        FactorTexture t(of(*bands[0]).size());
        for (std::size_t k = 0; k < t.size(); ++k)
            for (int c = 0; c < 3; ++c) t[k][c] = float(of(*bands[c])[k]);
        return t;
    };
    for (std::size_t j = 0; j < r.size(); ++j) {
        r[j].g = texture([&](const FactorTerms& t) -> const auto& { return t.g[j]; });
        r[j].h = texture([&](const FactorTerms& t) -> const auto& { return t.h[j]; });
    }
    return r;
}

}  // namespace

Factorisation factorise(const Target& target, const FactorOptions& options) {
    check(options);
    const auto start = std::chrono::steady_clock::now();
    const auto seconds = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    Factorisation r;
    const FactorMatrix m = sample_matrix(target, options.grid);
    r.channels = m.channels();
    r.pairs = m.size();
    r.below = m.below;
    r.missing = m.missing;
    r.seconds_sampling = seconds();
    std::array<Scaled, 3> scaled;
    std::array<std::vector<FactorTerms>, 3> factors;
    tbb::parallel_for(0, r.channels, [&](int c) {
        scaled[c] = scale(m, c, options);
        factors[c] = factor(m, scaled[c], options, r.sigma[c]);
    });
    r.seconds_factoring = seconds() - r.seconds_sampling;
    const std::vector<double> measure = measures(options.grid);
    const TargetSamples samples = sample_target(target);
    for (std::size_t i = 0; i < options.terms.size(); ++i) {
        Sums sums;
        for (int c = 0; c < r.channels; ++c)
            sums += sums_of(m, c, scaled[c], factors[c][i], options.logarithmic, measure);
        const auto band = [&](int c) { return &factors[std::min(c, r.channels - 1)][i]; };
        r.brdfs.emplace_back(options.grid, textures({band(0), band(1), band(2)}),
                             options.logarithmic, target.name(), target.isotropic());
        FactorErrors e{.terms = options.terms[i],
                       .matrix = std::sqrt(sums.left / sums.all),
                       .largest = sums.largest_left / sums.largest,
                       .weighted = std::sqrt(sums.left_weighted / sums.all_weighted)};
        add_rendered_errors(samples, r.brdfs.back(), e);
        r.errors.push_back(e);
    }
    return r;
}

}  // namespace nacre
