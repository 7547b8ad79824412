// Scattering vectors of layers.
#include <fmt/format.h>

#include "nacre/bssrdf/better_dipole.h"
#include "nacre/bssrdf/dipole.h"
#include "nacre/layers/adding_doubling.h"
#include "nacre/layers/hanrahan_krueger.h"
#include "nacre/layers/interfaces.h"
#include "nacre/layers/kubelka_munk.h"
#include "nacre/layers/slab_monte_carlo.h"
#include "nacre/math/error.h"
#include "nacre/vectors/scattering.h"

namespace nacre {
namespace {

using nlohmann::json;

constexpr double infinity = std::numeric_limits<double>::infinity();

double cosine_of(const json& degrees) {
    return std::cos(degrees.get<double>() * std::numbers::pi / 180.);
}

/// A layer of 1 mm; a half space if tau is infinite.
Layer layer_of(double albedo, double tau, double g, double eta) {
    if (std::isinf(tau)) return {albedo, 1. - albedo, g, infinity, eta};
    return {albedo * tau, (1. - albedo) * tau, g, 1., eta};
}

AddingDoublingResult precise(const LayerStack& stack, std::span<const double> incident,
                             std::span<const double> outgoing = {}) {
    return adding_doubling(stack, incident, outgoing, {.accuracy = 1e-9});
}

}  // namespace

void compare_kubelka_munk(const json& group, Comparison& result) {
    for (const json& row : group.value("single", json::array())) {
        const TwoStream matter{row.at("S"), row.at("K")};
        const double d = row.at("d");
        const KubelkaMunkLayer layer = kubelka_munk(matter, d);
        const std::string where = fmt::format("S {:g} K {:g} d {:g}", matter.S, matter.K, d);
        result.add(where + " R", layer.reflectance, row.at("R"));
        result.add(where + " T", layer.transmittance, row.at("T"));
        result.add(where + " A", layer.absorptance, row.at("A"));
        if (row.contains("R_infinity"))
            result.add(where + " R_infinity", kubelka_munk_infinite(matter), row["R_infinity"]);
        for (const json& b : row.value("over_backing", json::array()))
            result.add(fmt::format("{} over {}", where, b.at("Rg").dump()),
                       over_backing(flux_layer(layer), b["Rg"]), b.at("R"));
    }
    int number = 0;
    for (const json& row : group.value("stacks", json::array())) {
        FluxLayer all;
        for (const json& l : row.at("layers"))
            all = stacked(all, flux_layer(kubelka_munk({l.at("S"), l.at("K")}, l.at("d"))));
        const std::string where = fmt::format("stack {}", number++);
        result.add(where + " R_top", all.reflectance_above, row.at("R_top"));
        result.add(where + " R_bottom", all.reflectance_below, row.at("R_bottom"));
        result.add(where + " T", all.transmittance_down, row.at("T"));
        result.add(where + " R_over_backing", over_backing(all, row.at("backing")),
                   row.at("R_over_backing"));
    }
    for (const json& row : group.value("saunderson", json::array())) {
        const Saunderson surface = saunderson(row.at("n"), Entry::normal);
        const double inside = row.at("R_internal");
        const std::string where = fmt::format("Saunderson {} R {:g}", row["n"].dump(), inside);
        result.add(where + " k1", surface.k1, row.at("k1"));
        result.add(where + " k2", surface.k2, row.at("k2"));
        result.add(where, surface.over(inside), row.at("R_measured"));
    }
}

void compare_hanrahan_krueger(const json& group, Comparison& result) {
    for (const json& row : group) {
        const double w = row.at("W"), tau = row.at("tau"), g = row.at("g"), n = row.at("n");
        const double cos_i = cosine_of(row.at("theta_i")), sin_i = std::sqrt(1. - cos_i * cos_i);
        const HanrahanKrueger<double> model{w, tau, {g}, n};
        const std::string where =
            fmt::format("g {:g} tau {:g} n {:g} theta_i {}", g, tau, n, row["theta_i"].dump());
        for (const json& s : row.at("samples")) {
            const double cos_o = cosine_of(s.at("theta_o")), sin_o = std::sqrt(1. - cos_o * cos_o);
            const double phi = s.at("phi").get<double>() * std::numbers::pi / 180.;
            // At phi = 0 light goes on in the direction in which it came.
            const Vec3d wi{-sin_i, 0., cos_i};
            const Vec3d up{sin_o * std::cos(phi), sin_o * std::sin(phi), cos_o};
            const std::string to = fmt::format("{} theta_o {}", where, s["theta_o"].dump());
            result.add(to + " f_r", model.eval(wi, up), s.at("f_r"));
            result.add(to + " f_t", model.eval(wi, {up.x, up.y, -up.z}), s.at("f_t"));
        }
        if (!row.contains("rho_r_1")) continue;
        const HanrahanKruegerStack stack({{layer_of(w, tau, g, n)}});
        const LayerTotals t = stack.totals(cos_i);
        result.add(where + " rho_r_1", t.reflectance - t.specular, row["rho_r_1"]);
        result.add(where + " rho_t_1", t.transmittance - t.unscattered, row.at("rho_t_1"));
        result.add(where + " unscattered_T", t.unscattered, row.at("unscattered_T"));
    }
}

void compare_slab(const json& group, Comparison& result) {
    int number = 0;
    for (const json& row : group) {
        LayerStack stack;
        for (const json& l : row.at("layers"))
            stack.layers.push_back(layer_of(l.at("albedo"), l.at("tau"), l.at("g"), row.at("n")));
        std::vector<double> cosines;
        for (const json& i : row.at("incidence")) cosines.push_back(cosine_of(i.at("theta_i")));
        const AddingDoublingResult r = precise(stack, cosines);
        const double tolerance = 1e-8 + row.at("quadrature_uncertainty").get<double>();
        const std::string where = fmt::format("stack {}", number++);
        for (std::size_t i = 0; i < cosines.size(); ++i) {
            const json& in = row["incidence"][i];
            const auto add = [&](const char* key, double value) {
                result.add(fmt::format("{} theta_i {} {}", where, in["theta_i"].dump(), key), value,
                           in.at(key), tolerance);
            };
            add("R_total", r.collimated[i].reflectance);
            add("T_total", r.collimated[i].transmittance);
            add("R_specular", r.collimated[i].specular);
            add("R_unscattered", unscattered_light(stack, cosines[i]).reflectance);
            add("T_unscattered", r.collimated[i].unscattered);
        }
        result.add(where + " R_diffuse_incidence", r.diffuse.reflectance,
                   row.at("R_diffuse_incidence"), tolerance);
        result.add(where + " T_diffuse_incidence", r.diffuse.transmittance,
                   row.at("T_diffuse_incidence"), tolerance);
    }
}

void compare_half_space(const json& group, Comparison& result) {
    for (const json& row : group) {
        const double albedo = row.at("albedo"), g = row.at("g"), n = row.at("n");
        std::vector<double> cosines;
        for (const json& theta : row.at("theta_i")) cosines.push_back(cosine_of(theta));
        const AddingDoublingResult r = precise({{layer_of(albedo, infinity, g, n)}}, cosines);
        const double tolerance = 1e-8 + row.at("uncertainty").get<double>();
        const std::string where = fmt::format("albedo {:g} g {:g} n {:g}", albedo, g, n);
        for (std::size_t i = 0; i < cosines.size(); ++i)
            for (const char* key : {"R_total", "R_total_Hfunction_exact"})
                if (row.contains(key))
                    result.add(fmt::format("{} {} {}", where, key, i), r.collimated[i].reflectance,
                               row[key].at(i), tolerance);
        result.add(where + " R_diffuse_incidence", r.diffuse.reflectance,
                   row.at("R_diffuse_incidence"), tolerance);
        const double reduced = row.at("alpha_prime");
        result.add(where + " dipole_Rd_total_exactA",
                   Dipole<double>(reduced, 1. - reduced, n, BoundaryModel::exact).total(),
                   row.at("dipole_Rd_total_exactA"));
        result.add(where + " better_dipole_total_exact",
                   BetterDipole<double>(reduced, 1. - reduced, n).total(),
                   row.at("better_dipole_total_exact"));
    }
}

/// Width of bins whose multiples all edges are, to a millionth of the last edge.
double common_width(const std::vector<double>& edges) {
    double first = edges.front();
    for (std::size_t i = 1; i < edges.size(); ++i)
        if (!(edges[i] > edges[i - 1]))
            throw InputError("monte_carlo vectors: \"r_edges\" must ascend");
    if (!(first >= 0.)) throw InputError("monte_carlo vectors: \"r_edges\" must not be negative");
    const double least = 1e-6 * edges.back();
    double width = 0.;
    for (double edge : edges) {
        // Euclid's algorithm; what is left over by rounding is nothing.
        double a = std::max(edge, width), b = std::min(edge, width);
        while (b > least) {
            const double rest = std::abs(a - b * std::round(a / b));
            a = b;
            b = rest;
        }
        width = a;
    }
    constexpr double most = 10000.;
    if (!(edges.back() <= most * width * (1. + 1e-9)))
        throw InputError(
            fmt::format("monte_carlo vectors: \"r_edges\" have no common width of at least a "
                        "{:g}th of the last, {:g} mm; "
                        "round them",
                        most, edges.back()));
    return width;
}

void compare_monte_carlo(const json& group, Comparison& result) {
    int number = 0;
    for (const json& row : group) {
        LayerStack stack{{}, row.at("n_above"), row.at("n_below")};
        for (const json& l : row.at("layers"))
            stack.layers.push_back({l.at("sigma_s"), l.at("sigma_a"), l.at("g"),
                                    l.at("d").is_string() ? infinity : l["d"].get<double>(),
                                    l.at("n")});
        SlabMonteCarloOptions options;
        options.photons = 400'000;
        options.cosine = cosine_of(row.at("theta_i"));
        const std::vector<double> edges = row.value("r_edges", std::vector<double>{});
        if (edges.size() > 1) {
            options.bins.radius_width = common_width(edges);
            options.bins.radius = int(std::lround(edges.back() / options.bins.radius_width));
        }
        const SlabMonteCarloResult r = slab_monte_carlo(stack, options);
        const std::string where = fmt::format("run {}", number++);
        const auto add = [&](const char* key, double value, double error) {
            result.add_estimate(where + " " + key, value, error, row.at(key),
                                row.at(std::string(key) + "_se"));
        };
        const double scattered = r.totals.reflectance - r.totals.specular;
        add("R_diffuse", scattered, r.error.reflectance);
        add("T", r.totals.transmittance, r.error.transmittance);
        add("A", r.totals.absorptance, r.error.absorptance);
        const auto exact = [&](const char* key, double value, double error) {
            if (row.contains(key))
                result.add_estimate(where + " " + key, value, error, row[key], 0.);
        };
        exact("adding_doubling_R_diffuse", scattered, r.error.reflectance);
        exact("adding_doubling_T", r.totals.transmittance, r.error.transmittance);
        for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
            // Means of the bins that make up the ring, by their areas: 1, 3, 5, ... times the
            // first.
            const auto bin = [&](double edge) {
                return std::size_t(std::lround(edge / options.bins.radius_width));
            };
            double sum = 0., square = 0., area = 0.;
            for (std::size_t b = bin(edges[i]); b < bin(edges[i + 1]); ++b) {
                const double a = double(2 * b + 1);
                sum += a * r.reflected_radius[b].mean;
                square += a * a * r.reflected_radius[b].error * r.reflected_radius[b].error;
                area += a;
            }
            result.add_estimate(fmt::format("{} ring {}", where, i), sum / area,
                                std::sqrt(square) / area, row.at("R_of_r_mean_per_area").at(i),
                                row.at("R_of_r_se").at(i));
        }
    }
}

void compare_anchors(const json& group, Comparison& result) {
    // The numbers stand in the text: "... a=0.9 tau=2 g=0.75 n=1 normal incidence".
    const auto number = [](const std::string& text, const std::string& key, double otherwise) {
        const std::size_t at = text.find(" " + key + "=");
        return at == text.npos ? otherwise : std::stod(text.substr(at + key.size() + 2));
    };
    const std::vector<double> normal{1.};
    for (const json& row : group) {
        const std::string text = row.at("case");
        if (row.contains("value")) {
            // H(1) of a conservative, isotropic half space: its BRDF is H(mu) H(mu0) / (4 pi (mu +
            // mu0)). Printed to four decimals.
            const AddingDoublingResult r =
                precise({{layer_of(1., infinity, 0., 1.)}}, normal, normal);
            result.add("H(1)", std::sqrt(8. * std::numbers::pi * r.brdf.front()), row["value"],
                       5e-5);
            continue;
        }
        const Layer layer = layer_of(number(text, "a", 0.), number(text, "tau", infinity),
                                     number(text, "g", 0.), number(text, "n", 1.));
        const LayerTotals t = precise({{layer}}, normal).collimated.front();
        // One unit of the last digit, of which half is the stated precision: Giovanelli's last
        // digit is off by one, as the values show that stand beside the printed ones ("oracle").
        const double printed = 2. * row.at("quoted_precision").get<double>();
        const json oracle = row.value("oracle", json::array());
        std::size_t place = 0;
        const auto add = [&](const char* key, double value) {
            if (!row.contains(key)) return;
            result.add(text, value, row[key], printed);
            // Rounded to seven digits.
            if (oracle.is_number())
                result.add(text + " (oracle)", value, oracle, 1e-7);
            else if (place < oracle.size())
                result.add(text + " (oracle)", value, oracle[place++], 1e-7);
        };
        add("R_diffuse", t.reflectance - t.specular);
        add("T_total", t.transmittance);
        add("R_total", t.reflectance);
    }
}

}  // namespace nacre
