#include "nacre/report/advice.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace nacre {
namespace {

struct Winner {
    const ErrorLaw* law = nullptr;
    double seconds = 0;
    std::vector<std::string> ties;
    std::vector<std::string> unsure;  ///< faster, perhaps, if their error is small enough

    bool same_as(const Winner& w) const { return law == w.law && ties == w.ties; }
};

/// Time that repeats cannot tell from `seconds`.
double tied_below(const ErrorLaw& law, double seconds) {
    return seconds * (1 + std::max(0.1, law.time_spread));
}

Winner winner_at(std::span<const ErrorLaw> laws, double error) {
    Winner w;
    for (const ErrorLaw& law : laws) {
        const TimeToReach t = time_to_reach(law, error);
        if (t.reach == Reach::certain && (!w.law || t.seconds < w.seconds))
            w.law = &law, w.seconds = t.seconds;
    }
    for (const ErrorLaw& law : laws) {
        const TimeToReach t = time_to_reach(law, error);
        if (t.reach == Reach::unsure) w.unsure.push_back(law.name);
        if (w.law && &law != w.law && t.reach == Reach::certain &&
            t.seconds <= std::max(tied_below(*w.law, w.seconds), tied_below(law, w.seconds)))
            w.ties.push_back(law.name);
    }
    return w;
}

std::string percent(double error) { return fmt::format("{:.3g} %", 100 * error); }

std::string list_of(std::vector<std::string> names) {
    constexpr std::size_t most = 3;
    if (names.size() > most) {
        const std::size_t more = names.size() - most;
        names.resize(most);
        return fmt::format("{} and {} more", fmt::join(names, ", "), more);
    }
    if (names.size() < 2) return names.empty() ? "" : names.front();
    const std::string last = names.back();
    names.pop_back();
    return fmt::format("{} and {}", fmt::join(names, ", "), last);
}

bool same_picture(const Image& a, const Image& b) {
    return a.width == b.width && a.height == b.height && a.data == b.data;
}

}  // namespace

TimeToReach time_to_reach(const ErrorLaw& law, double error) {
    if (law.floor - 2 * law.sigma >= error) return {Reach::never};
    const double floor = law.floor + 2 * law.sigma;
    if (!(floor < error)) return {Reach::unsure};
    const double frame = law.frame * law.noise * law.noise / (error * error - floor * floor);
    return {Reach::certain, law.precompute + std::max(frame, law.least_frame)};
}

std::vector<std::string> advise(std::span<const ErrorLaw> laws, std::span<const double> errors) {
    std::vector<std::string> sentences;
    if (laws.empty()) return {"No technique has numbers, so none is recommended."};
    for (std::size_t i = 0; i < errors.size();) {
        const Winner w = winner_at(laws, errors[i]);
        std::size_t last = i;
        Winner at_last = w;
        while (last + 1 < errors.size()) {
            Winner next = winner_at(laws, errors[last + 1]);
            if (!next.same_as(w)) break;
            at_last = std::move(next), ++last;
        }
        const std::string range =
            last == i ? percent(errors[i])
                      : fmt::format("{} to {}", percent(errors[i]), percent(errors[last]));
        if (!w.law) {
            std::string s = fmt::format("An error of {} is certainly reached by none", range);
            if (!w.unsure.empty())
                s += fmt::format("; the noise leaves open whether {} {}", list_of(w.unsure),
                                 w.unsure.size() == 1 ? "does" : "do");
            sentences.push_back(s + ".");
        } else {
            const bool only =
                w.ties.empty() && std::ranges::count_if(laws, [&](const ErrorLaw& law) {
                                      return time_to_reach(law, errors[i]).reach == Reach::certain;
                                  }) == 1;
            std::string s =
                fmt::format("For an error of {} {} {}: {}", range,
                            laws.size() == 1 ? "the only one compared is"
                            : only           ? "only"
                                             : "the fastest is",
                            laws.size() == 1 || !only ? w.law->name : w.law->name + " is certain",
                            time_in_words(w.seconds));
            if (time_in_words(at_last.seconds) != time_in_words(w.seconds))
                s += fmt::format(" to {}", time_in_words(at_last.seconds));
            if (!w.ties.empty()) s += fmt::format("; not told apart by time: {}", list_of(w.ties));
            if (only && !w.unsure.empty() && laws.size() > 1)
                s += fmt::format("; left open by noise: {}", list_of(w.unsure));
            sentences.push_back(s + ".");
        }
        i = last + 1;
    }
    return sentences;
}

std::optional<ErrorLaw> error_law(const ExperimentRow& row, const std::string& reference) {
    if (!row.verdict || row.measurement.timings.empty()) return {};
    const Measurement& m = row.measurement;
    const Verdict& v = *row.verdict;
    const std::string options = row.peer ? "" : row.setting.options();
    ErrorLaw law;
    law.name = row.peer ? std::string(row.peer->name)
                        : name_with_setting(row.setting.choice.technique, options);
    law.precompute = m.median_of(&Timing::precompute);
    law.frame = m.median_of(&Timing::frame);
    law.least_frame = law.frame / std::max(1, row.peer ? m.samples : row.setting.samples);
    const auto [least, most] = std::ranges::minmax(m.timings, {}, &Timing::frame);
    law.time_spread = law.frame > 0 ? (most.frame - least.frame) / law.frame : 0;
    law.noise = v.noise;
    if (row.peer || row.setting.choice.technique != reference) {
        law.floor = v.pixel_systematic;
        law.sigma = v.pixel_sigma;
    }
    return law;
}

std::vector<std::optional<std::size_t>> identical_rows(const std::vector<ExperimentRow>& rows) {
    std::vector<std::optional<std::size_t>> same(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
        for (std::size_t j = 0; j < i && rows[i].verdict && !same[i]; ++j)
            if (rows[j].verdict && same_picture(rows[i].measurement.mean, rows[j].measurement.mean))
                same[i] = j;
    return same;
}

std::vector<std::string> advise(const Experiment& e, const std::string& reference) {
    std::vector<ErrorLaw> laws;
    int failed = 0, missing = 0;
    const auto same = identical_rows(e.rows);
    const bool several = std::ranges::any_of(e.rows, [&](const ExperimentRow& r) {
        return !r.peer && r.setting.samples != e.rows.front().setting.samples;
    });
    for (std::size_t i = 0; i < e.rows.size(); ++i) {
        failed += e.rows[i].measurement.status == Measurement::Status::failed;
        missing += e.rows[i].measurement.status == Measurement::Status::missing;
        if (same[i]) continue;
        if (auto law = error_law(e.rows[i], reference)) {
            if (several && !e.rows[i].peer)
                law->name += fmt::format(" at {} spp", e.rows[i].setting.samples);
            laws.push_back(std::move(*law));
        }
    }
    std::vector<std::string> sentences = advise(laws);
    if (failed)
        sentences.push_back(fmt::format("{} failed and {} no part in this.",
                                        failed == 1 ? "One technique" : fmt::to_string(failed),
                                        failed == 1 ? "has" : "have"));
    if (missing)
        sentences.push_back(
            fmt::format("{} of {} were not run: the finished comparison may say otherwise.",
                        missing, e.rows.size()));
    return sentences;
}

std::string name_with_setting(const std::string& name, const std::string& setting) {
    return setting.empty() ? name : fmt::format("{} ({})", name, setting);
}

std::string time_in_words(double s) {
    if (s >= 5400) return fmt::format("{:.3g} h", s / 3600);
    if (s >= 90) return fmt::format("{:.2g} min", s / 60);
    return s < 0.001 ? "under 1 ms" : fmt::format("{:.2g} s", s);
}

}  // namespace nacre
