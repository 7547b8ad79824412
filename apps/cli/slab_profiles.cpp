#include "apps/cli/slab_profiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "nacre/layers/adding_doubling.h"
#include "nacre/layers/hanrahan_krueger.h"
#include "nacre/layers/slab_monte_carlo.h"
#include "nacre/math/error.h"

namespace nacre::cli {
namespace {

SlabMonteCarloResult simulate(const SlabTask& task, const SlabBins& bins) {
    SlabMonteCarloOptions options;
    options.photons = task.photons;
    options.seed = task.seed;
    options.cosine = task.cosine;
    options.bins = bins;
    const Work alone;
    return slab_monte_carlo(task.stack, options, task.work ? *task.work : alone);
}

double ten_free_paths(const LayerStack& stack) {
    double most = 0.;
    for (const Layer& l : stack.layers) most = std::max(most, l.sigma_s * (1. - l.g) + l.sigma_a);
    return most > 0. ? 10. / most : 10.;
}

/// A table that begins with a column of positions.
class Columns {
  public:
    Columns(Table table, const std::vector<double>& positions) : table_(std::move(table)) {
        for (const double x : positions) table_.rows.push_back({x});
    }

    void add(const std::string& name, const std::vector<double>& values) {
        table_.columns.push_back(name);
        for (std::size_t i = 0; i < values.size(); ++i) table_.rows[i].push_back(values[i]);
    }
    /// With its standard errors in a column beside it.
    void add(const std::string& name, const std::vector<double>& values,
             const std::vector<double>& errors) {
        add(name, values);
        add(name + "_error", errors);
        table_.errors[table_.columns.size() - 1] = table_.columns.size() - 2;
    }
    void add(const std::string& name, const std::vector<Estimate>& estimates) {
        std::vector<double> values, errors;
        for (const Estimate& e : estimates) {
            values.push_back(e.mean);
            errors.push_back(e.error);
        }
        add(name, values, errors);
    }

    /// With the columns' names in words for the picture.
    Table table() && {
        for (const std::string& column : table_.columns) {
            std::string name = column;
            std::ranges::replace(name, '_', ' ');
            for (const auto& [from, to] :
                 {std::pair("ad ", "adding-doubling, "), std::pair("mc ", "Monte Carlo, ")})
                if (name.starts_with(from)) name.replace(0, 3, to);
            table_.names.push_back(name == "ad"   ? "adding-doubling"
                                   : name == "mc" ? "Monte Carlo"
                                                  : name);
        }
        return std::move(table_);
    }

  private:
    Table table_;
};

/// Not a number where the method refuses the stack, unless it is the `only` one, and for the error
/// where it has none.
Estimate reflectance_of(const SlabMethod& method, const SlabTask& task, bool only) {
    const double none = std::nan("");
    try {
        const SlabAnswer a = method.solve(task);
        return {a.totals.reflectance, a.error ? a.error->reflectance : none};
    } catch (const InputError&) {
        if (only) throw;
        return {none, none};
    }
}

std::vector<double> middles(int bins, double width) {
    std::vector<double> r;
    for (int i = 0; i < bins; ++i) r.push_back((i + 0.5) * width);
    return r;
}

}  // namespace

Table radial_table(const SlabTask& task, double rmax, int bins) {
    SlabBins wanted;
    wanted.radius = bins;
    wanted.radius_width = (rmax > 0. ? rmax : ten_free_paths(task.stack)) / bins;
    const SlabMonteCarloResult r = simulate(task, wanted);
    const std::vector<double> radii = middles(bins, wanted.radius_width);
    Table t{"Slab: light that leaves, by slab Monte Carlo",
            {"r_mm"},
            {},
            PlotKind::semilog,
            "share of the power / mm⁻²"};
    t.x_label = "distance from entry / mm";
    t.weights = radii;  // the areas of equal rings grow like them
    Columns columns(std::move(t), radii);
    columns.add("reflected", r.reflected_radius);
    columns.add("transmitted", r.transmitted_radius);
    return std::move(columns).table();
}

Table angular_table(const SlabTask& task, const std::vector<const SlabMethod*>& methods, int bins) {
    const auto has = [&](std::string_view name) {
        return std::any_of(methods.begin(), methods.end(),
                           [&](const SlabMethod* m) { return m->name == name; });
    };
    if (!has("ad") && !has("mc"))
        throw InputError("--angular is told by the methods ad and mc; --method has neither");
    const std::vector<double> angles = middles(bins, 90. / bins);
    Table t{"Slab: light that leaves, over the angle of exit",
            {"theta_deg"},
            {},
            PlotKind::semilog,
            "share of the power / sr⁻¹"};
    t.x_label = "angle of exit to the normal / degrees";
    for (const double a : angles) t.weights.push_back(std::sin(a * std::numbers::pi / 180.));
    Columns columns(std::move(t), angles);
    if (has("ad")) {
        std::vector<double> cosines;
        for (const double a : angles) cosines.push_back(std::cos(a * std::numbers::pi / 180.));
        const AddingDoublingResult r = adding_doubling(task.stack, {&task.cosine, 1}, cosines);
        // Radiance over irradiance becomes power per solid angle.
        const auto power = [&](std::vector<double> radiance) {
            for (std::size_t i = 0; i < radiance.size(); ++i) radiance[i] *= cosines[i];
            return radiance;
        };
        columns.add("ad_reflected", power(r.brdf));
        columns.add("ad_transmitted", power(r.btdf));
    }
    if (has("mc")) {
        SlabBins wanted;
        wanted.angle = bins;
        const SlabMonteCarloResult r = simulate(task, wanted);
        columns.add("mc_reflected", r.reflected_angle);
        columns.add("mc_transmitted", r.transmitted_angle);
    }
    return std::move(columns).table();
}

Table lobe_table(const LayerStack& stack, const std::vector<double>& incidences) {
    constexpr double degree = std::numbers::pi / 180.;
    const HanrahanKruegerStack layers(stack);
    Table t{"Slab: light scattered once",
            {"theta_o_deg"},
            {},
            PlotKind::polar,
            "BRDF times cosine of incidence / sr⁻¹, as distance from the origin"};
    t.names = {""};
    for (const double a : incidences) {
        t.columns.push_back(fmt::format("theta_i={:g}", a));
        t.names.push_back(fmt::format("incidence {:g}°", a));
    }
    for (double out = -179.75; out < 180.; out += 0.5) {
        std::vector<double> row{out};
        for (const double a : incidences) {
            const Vec3d wi{-std::sin(a * degree), 0., std::cos(a * degree)};
            row.push_back(layers.eval(wi, {std::sin(out * degree), 0., std::cos(out * degree)}) *
                          wi.z);
        }
        t.rows.push_back(std::move(row));
    }
    return t;
}

Table spectrum_table(const SkinParameters& skin, const SlabTask& task,
                     const std::vector<const SlabMethod*>& methods, double from, double to,
                     double step) {
    std::vector<double> wavelengths;
    // Multiples, not sums, lest the last one be missed by rounding.
    for (int i = 0; from + i * step <= to * (1. + 1e-12); ++i)
        wavelengths.push_back(from + i * step);
    Table t{"Reflectance of skin", {"nm"}, {}, PlotKind::curves, "reflectance"};
    t.x_label = "wavelength / nm";
    Columns columns(std::move(t), wavelengths);
    for (const SlabMethod* m : methods) {
        std::vector<double> values, errors;
        for (const double nm : wavelengths) {
            SlabTask at = task;
            at.stack = skin_stack(skin, nm);
            if (task.stack.eta_above > 0.) at.stack.eta_above = task.stack.eta_above;
            if (task.stack.eta_below > 0.) at.stack.eta_below = task.stack.eta_below;
            const Estimate r = reflectance_of(*m, at, methods.size() == 1);
            values.push_back(r.mean);
            errors.push_back(r.error);
        }
        const std::string name(m->name);
        if (std::all_of(errors.begin(), errors.end(), [](double e) { return std::isnan(e); }))
            columns.add(name, values);
        else
            columns.add(name, values, errors);
    }
    return std::move(columns).table();
}

}  // namespace nacre::cli
