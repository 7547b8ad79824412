#include "nacre/measured/audit_verdict.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "nacre/measured/number_text.h"

namespace nacre {
namespace {

constexpr double degree = std::numbers::pi / 180.;

void judge_values(const MeasuredInfo& info, Audit& a) {
    if (info.negative > 0)
        a.doubtful.push_back(fmt::format(
            "{} of {} samples are negative, down to {:.3g} sr^-1, which no BRDF is: noise; they "
            "render as 0",
            info.negative, info.samples, a.range.most_negative));
    else
        a.trusted.emplace_back("no value is negative");
    if (a.outliers.count > 0) {
        const AuditedPair& p = a.outliers.worst.front();
        a.doubtful.push_back(fmt::format(
            "{} of {} samples lie far from their neighbours, by error or because a highlight is "
            "narrower than the samples are apart; the farthest, {:.3g} among {:.3g} sr^-1, at {}",
            a.outliers.count, a.outliers.looked_at, p.value, p.other, place_in_words(p)));
    } else if (a.outliers.looked_at > 0) {
        a.trusted.push_back(fmt::format("no sample lies far from its neighbours ({} looked at)",
                                        a.outliers.looked_at));
    }
}

void judge_reciprocity(Audit& a) {
    const AuditReciprocity& r = a.reciprocity;
    if (r.pairs == 0) return;
    if (r.apart > 0) {
        const AuditedPair& p = r.worst.front();
        a.doubtful.push_back(
            fmt::format("{}: {:.2g} % in the mean when light and viewer are exchanged, more than "
                        "{:.0f} % at {} "
                        "of {} pairs; the most, {:.3g} against {:.3g} sr^-1, at {}",
                        r.mean > 0.05 ? "not reciprocal" : "reciprocal in the mean alone",
                        100. * r.mean, 100. * AuditReciprocity::allowed, r.apart, r.pairs, p.value,
                        p.other, place_in_words(p)));
    } else if (r.largest == 0.) {
        a.trusted.emplace_back(
            "reciprocal: exchanged light and viewer have one value in these coordinates");
    } else {
        a.trusted.push_back(
            fmt::format("reciprocal: {:.2g} % in the mean when light and viewer are exchanged, "
                        "{:.2g} % at most",
                        100. * r.mean, 100. * r.largest));
    }
}

void judge_albedo(Audit& a) {
    if (a.albedo.empty()) return;
    const AuditAlbedo* most = &a.albedo.front();
    std::size_t above = 0;
    double known = 1.;
    for (const AuditAlbedo& x : a.albedo) {
        if (x.largest > most->largest) most = &x;
        above += x.largest > AuditAlbedo::most;
        if (x.theta <= 60.)
            known = std::min(known, std::max(x.known_reflected, x.known_transmitted));
    }
    const std::string where = fmt::format("{:.3g} at {:g} degrees of incidence{}", most->largest,
                                          most->theta, most->front ? "" : " from behind");
    if (above > 0)
        a.doubtful.push_back(fmt::format(
            "more light leaves than comes in at {} of {} incidences: {}; renderings can grow "
            "brighter with every reflection",
            above, a.albedo.size(), where));
    else if (most->largest < 1e-3)
        a.doubtful.push_back(
            fmt::format("nearly no light comes back ({}): is the scale right?", where));
    else
        a.trusted.push_back(fmt::format("no more light leaves than comes in: at most {}{}", where,
                                        known < 0.95 ? ", of the exits that are known" : ""));
}

void judge_coverage(const MeasuredInfo& info, Audit& a) {
    if (info.reflection_front) {
        const std::string share = fmt::format(
            "{:.1f} % of pairs of directions within 80 degrees of the normal", 100. * a.known);
        if (a.known > 0.99)
            a.trusted.push_back(share + " are known");
        else
            a.doubtful.push_back("only " + share +
                                 " are known; the picture of the coverage says which");
    }
    const double least = std::min(info.largest_incidence, info.largest_exit);
    if (least < 79.5)
        a.doubtful.push_back(
            fmt::format("nothing is known beyond {:.1f} degrees of {}", least,
                        info.largest_incidence <= info.largest_exit ? "incidence" : "exit"));
    else
        a.doubtful.emplace_back(
            "beyond 80 degrees of incidence or exit measurements are unreliable, whatever stands "
            "there");
}

}  // namespace

std::string place_in_words(const AuditedPair& p) {
    const double phi = std::remainder(std::atan2(p.wo.y, p.wo.x) - std::atan2(p.wi.y, p.wi.x),
                                      2. * std::numbers::pi);
    return fmt::format("theta_i {:.1f}, theta_o {:.1f}, phi {:.1f} degrees",
                       theta_of(p.wi) / degree, theta_of(p.wo) / degree, std::abs(phi) / degree);
}

void judge(const MeasuredInfo& info, Audit& audit) {
    judge_coverage(info, audit);
    judge_values(info, audit);
    judge_reciprocity(audit);
    judge_albedo(audit);
}

}  // namespace nacre
