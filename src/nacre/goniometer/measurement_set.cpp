#include "nacre/goniometer/measurement_set.h"

#include <nlohmann/json.hpp>

#include "nacre/math/error.h"
#include "nacre/text/whole_file.h"

namespace nacre {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr const char* format_name = "nacre measurement 1";

double degrees(double radians) { return radians * 180. / std::numbers::pi; }

bool passes(const IncidenceMeasurement& m) {
    for (double s : m.below.sum)
        if (s > 0.) return true;
    return false;
}

ordered_json sums_json(const IncidenceMeasurement::Sums& s) {
    ordered_json r = ordered_json::array();
    for (double x : s.sum) r.push_back(x);
    for (double x : s.square) r.push_back(x);
    return r;
}
IncidenceMeasurement::Sums sums_of(const json& j) {
    const auto numbers = j.get<std::array<double, 8>>();
    IncidenceMeasurement::Sums s;
    std::copy_n(numbers.begin(), 4, s.sum.begin());
    std::copy_n(numbers.begin() + 4, 4, s.square.begin());
    return s;
}

/// A value of each lane, with its errors.
template <class F>
void put(ordered_json& to, const std::string& name, std::size_t lanes, F&& value) {
    ordered_json values = ordered_json::array(), errors = ordered_json::array();
    for (std::size_t k = 0; k < lanes; ++k) {
        const MeasuredValue v = value(int(k));
        values.push_back(v.value);
        errors.push_back(v.error);
    }
    to[name] = values;
    to[name + "_error"] = errors;
}

ordered_json incidence_json(const IncidenceMeasurement& m, std::size_t lanes) {
    ordered_json r;
    const DirectionCell& c = m.incidence;
    r["theta"] = {degrees(c.theta_low), degrees(c.theta_high)};
    r["phi"] = {degrees(c.phi_low), degrees(c.phi_high)};
    r["rays"] = m.rays;
    ordered_json sums;
    sums["incidence"] = {c.theta_low, c.theta_high, c.phi_low, c.phi_high};
    if (m.rays == 0) {  // nothing is known of it, which is not 0
        r["sums"] = sums;
        return r;
    }
    put(r, "reflected", lanes, [&](int k) { return m.reflected(k); });
    put(r, "transmitted", lanes, [&](int k) { return m.transmitted(k); });
    put(r, "blocked", lanes, [&](int k) { return m.blocked(k); });
    put(r, "lost", lanes, [&](int k) { return m.lost(k); });
    for (const bool below : {false, true}) {
        if (below && !passes(m)) continue;
        ordered_json values = ordered_json::array(), errors = ordered_json::array();
        for (std::size_t i = 0; i < m.bins.size(); ++i) {
            ordered_json one;
            put(one, "v", lanes, [&](int k) { return below ? m.btdf(i, k) : m.brdf(i, k); });
            values.push_back(one["v"]);
            errors.push_back(one["v_error"]);
        }
        r[below ? "btdf" : "brdf"] = values;
        r[below ? "btdf_error" : "brdf_error"] = errors;
    }
    for (const auto* s : {&m.above, &m.below, &m.cut, &m.gone})
        sums["shares"].push_back(sums_json(*s));
    sums["bins"] = ordered_json::array();
    for (const auto& s : m.of_bin) sums["bins"].push_back(sums_json(s));
    r["sums"] = sums;
    return r;
}

IncidenceMeasurement incidence_of(const json& j, const HemisphereBins& bins) {
    const json& sums = j.at("sums");
    const auto angle = sums.at("incidence").get<std::array<double, 4>>();
    const auto rays = j.at("rays").get<std::uint64_t>();
    const std::size_t count = rays > 0 ? sums.at("bins").size() : 2 * bins.size();
    if (count != 2 * bins.size())
        throw InputError(fmt::format("{} sums stand where {} bins need {}", count, bins.size(),
                                     2 * bins.size()));
    // Without rays nothing is made for the bins: a short file must not ask for much memory.
    IncidenceMeasurement m({angle[0], angle[1], angle[2], angle[3]},
                           rays > 0 ? bins : HemisphereBins{1, 1});
    m.rays = rays;
    if (m.rays == 0) return m;
    const json& shares = sums.at("shares");
    m.above = sums_of(shares.at(0));
    m.below = sums_of(shares.at(1));
    m.cut = sums_of(shares.at(2));
    m.gone = sums_of(shares.at(3));
    const json& of_bin = sums.at("bins");
    for (std::size_t i = 0; i < m.of_bin.size(); ++i) m.of_bin[i] = sums_of(of_bin[i]);
    return m;
}

}  // namespace

std::string csv_of(const MeasurementSet& set, const std::string& title,
                   const std::function<double(std::size_t, bool, std::size_t, int)>& value,
                   bool transmission) {
    std::string text = fmt::format("# {}\n", title);
    for (const auto& [name, fact] : set.facts) text += fmt::format("# {}: {}\n", name, fact);
    text += fmt::format("theta_i,phi_i,theta_o,phi_o,{}\n", fmt::join(set.lanes, ","));
    for (std::size_t n = 0; n < set.incidences.size(); ++n) {
        const IncidenceMeasurement& m = set.incidences[n];
        for (const bool below : {false, true}) {
            if (m.rays == 0 || (below && !(transmission && passes(m)))) continue;
            for (std::size_t i = 0; i < m.bins.size(); ++i) {
                const DirectionCell c = m.bins.cell(i);
                const double theta = degrees(c.theta());
                text += fmt::format("{:.6g},{:.6g},{:.6g},{:.6g}", degrees(m.incidence.theta()),
                                    degrees(m.incidence.phi()), below ? 180. - theta : theta,
                                    degrees(c.phi()));
                for (int k = 0; k < int(set.lanes.size()); ++k)
                    text += fmt::format(",{:.8g}", value(n, below, i, k));
                text += '\n';
            }
        }
    }
    return text;
}

std::string csv_of(const MeasurementSet& set, bool errors) {
    return csv_of(
        set,
        fmt::format("virtual gonioreflectometer of nacre{}", errors ? ": standard errors" : ""),
        [&](std::size_t n, bool below, std::size_t bin, int lane) {
            const IncidenceMeasurement& m = set.incidences[n];
            const MeasuredValue v = below ? m.btdf(bin, lane) : m.brdf(bin, lane);
            return errors ? v.error : v.value;
        });
}

std::string json_of(const MeasurementSet& set) {
    ordered_json r;
    r["format"] = format_name;
    r["complete"] = set.complete;
    for (const auto& [name, value] : set.facts) r["facts"][name] = value;
    r["lanes"] = set.lanes;
    const HemisphereBins bins =
        set.incidences.empty() ? HemisphereBins() : set.incidences.front().bins;
    r["bins"] = {bins.polar, bins.around};
    r["incidences"] = ordered_json::array();
    for (const IncidenceMeasurement& m : set.incidences)
        r["incidences"].push_back(incidence_json(m, set.lanes.size()));
    return r.dump() + "\n";
}

MeasurementSet read_measurement(const std::filesystem::path& file) {
    const auto text = read_whole_file(file);
    if (!text) throw InputError(fmt::format("cannot read '{}'", file.string()));
    try {
        const json j = json::parse(*text);
        if (!j.is_object() || j.value("format", "") != format_name)
            throw InputError("this is no measurement of 'nacre measure'");
        MeasurementSet set;
        set.complete = j.at("complete").get<bool>();
        set.facts = j.at("facts").get<std::map<std::string, std::string>>();
        set.lanes = j.at("lanes").get<std::vector<std::string>>();
        const auto sizes = j.at("bins").get<std::array<int, 2>>();
        const HemisphereBins bins{sizes[0], sizes[1]};
        if (bins.polar < 1 || bins.around < 1 || bins.size() > 1'000'000)
            throw InputError(fmt::format("{} by {} bins are impossible", sizes[0], sizes[1]));
        for (const json& i : j.at("incidences")) set.incidences.push_back(incidence_of(i, bins));
        return set;
    } catch (const json::exception& e) {
        throw InputError(fmt::format("{}: {}", file.string(), e.what()));
    } catch (const InputError& e) {
        throw InputError(fmt::format("{}: {}", file.string(), e.what()));
    }
}

void check_facts(const std::map<std::string, std::string>& found,
                 const std::map<std::string, std::string>& asked, const std::string& file) {
    for (const auto& [name, value] : asked) {
        const auto at = found.find(name);
        const std::string there = at == found.end() ? "nothing" : at->second;
        if (there != value)
            throw InputError(fmt::format("{} is of another measurement: its {} is {}, not {}", file,
                                         name, there, value));
    }
}

}  // namespace nacre
