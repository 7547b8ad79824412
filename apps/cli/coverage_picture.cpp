#include "apps/cli/coverage_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "nacre/measured/measured.h"
#include "nacre/measured/number_text.h"

namespace nacre::cli {
namespace {

constexpr double pi = std::numbers::pi, degree = pi / 180.;
constexpr int rings = 18, sectors = 36;
constexpr double radius = 70., cell = 165., left = 78., top = 62.;

/// Colours of the diagrams (plot.cpp).
constexpr const char *known_colour = "#2f93cc", *negative_colour = "#cc5200",
                     *unknown_colour = "#e4e5e2", *ink = "#1c1d1f", *grey = "#5c6065";

struct Disc {
    std::string known, negative;  ///< paths of their patches
    double share = 0.;            ///< of exits that are known, by cosine
};

/// Where a direction is drawn: light comes from the left.
std::string point(double theta, double phi) {
    const double r = radius * std::sqrt(2.) * std::sin(0.5 * theta);
    return fmt::format("{:.1f} {:.1f}", -r * std::cos(phi), r * std::sin(phi));
}

Disc disc_of(const Measured& data, bool front, double incidence, bool above) {
    Disc disc;
    Vec3d wi = polar_direction(incidence, 0.);
    if (!front) wi.z = -wi.z;
    std::vector<double> out(std::size_t(data.info().channels));
    constexpr double step = 0.5 * pi / rings, turn = 2. * pi / sectors;
    double all = 0.;
    for (int s = 0; s < sectors; ++s) {
        // Patches that follow one another outwards and are alike are one.
        std::string* run = nullptr;
        int begin = 0;
        const auto finish = [&](int end) {
            if (run)
                *run += fmt::format("M{}L{}L{}L{}Z", point(begin * step, s * turn),
                                    point(end * step, s * turn), point(end * step, (s + 1) * turn),
                                    point(begin * step, (s + 1) * turn));
        };
        for (int r = 0; r < rings; ++r) {
            Vec3d wo = polar_direction((r + 0.5) * step, (s + 0.5) * turn);
            if (!above) wo.z = -wo.z;
            const double weight = std::sin((2. * r + 1.) * step);
            all += weight;
            std::string* path = nullptr;
            if (data.eval(wi, wo, out)) {
                disc.share += weight;
                path =
                    *std::min_element(out.begin(), out.end()) < 0. ? &disc.negative : &disc.known;
            }
            if (path == run) continue;
            finish(r);
            run = path;
            begin = r;
        }
        finish(rings);
    }
    disc.share /= all;
    return disc;
}

std::string text_at(double x, double y, const std::string& text, const char* anchor = "middle",
                    int size = 12, const char* colour = grey) {
    std::string safe;
    for (const char c : text) safe += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
    return fmt::format(
        "<text x='{:.0f}' y='{:.0f}' text-anchor='{}' font-size='{}' fill='{}'>{}</text>\n", x, y,
        anchor, size, colour, safe);
}

}  // namespace

std::string coverage_picture(const Measured& data, const std::string& title) {
    constexpr int incidences[] = {0, 15, 30, 45, 60, 75};
    const MeasuredInfo& info = data.info();
    struct Row {
        bool front, above;
        const char* name;
    };
    std::vector<Row> rows;
    if (info.reflection_front) rows.push_back({true, true, "reflected"});
    if (info.transmission_front) rows.push_back({true, false, "through"});
    if (info.reflection_back) rows.push_back({false, false, "reflected, from behind"});
    if (info.transmission_back) rows.push_back({false, true, "through, from behind"});
    const double width = left + 6 * cell, height = top + double(rows.size()) * (cell + 14.) + 34.;
    std::string svg = fmt::format(
        "<svg xmlns='http://www.w3.org/2000/svg' width='{0:.0f}' height='{1:.0f}' viewBox='0 0 "
        "{0:.0f} {1:.0f}' font-family='Noto Sans,Arial,sans-serif'>\n"
        "<rect width='100%' height='100%' fill='white'/>\n",
        width, height);
    svg += text_at(0.5 * width, 22., title, "middle", 15, ink);
    for (int i = 0; i < 6; ++i)
        svg += text_at(left + (i + 0.5) * cell, 48., fmt::format("incidence {}°", incidences[i]));
    for (std::size_t r = 0; r < rows.size(); ++r) {
        const double y = top + (double(r) + 0.5) * (cell + 14.) - 7.;
        svg += fmt::format("<g transform='rotate(-90 30 {:.0f})'>{}</g>\n", y,
                           text_at(30., y, rows[r].name, "middle", 12, ink));
        for (int i = 0; i < 6; ++i) {
            const Disc disc = disc_of(data, rows[r].front, incidences[i] * degree, rows[r].above);
            const double x = left + (i + 0.5) * cell;
            svg += fmt::format("<g transform='translate({:.1f} {:.1f})'>\n", x, y);
            svg += fmt::format("<circle r='{}' fill='{}'/>\n", radius, unknown_colour);
            for (const auto& [path, colour] :
                 {std::pair{&disc.known, known_colour}, std::pair{&disc.negative, negative_colour}})
                if (!path->empty())
                    svg += fmt::format("<path d='{}' fill='{}' stroke='{}' stroke-width='0.3'/>\n",
                                       *path, colour, colour);
            for (const double theta : {30., 60., 90.})
                svg += fmt::format(
                    "<circle r='{:.1f}' fill='none' stroke='{}' stroke-width='0.6' "
                    "stroke-opacity='{}'/>\n",
                    radius * std::sqrt(2.) * std::sin(0.5 * theta * degree), ink,
                    theta < 90. ? 0.35 : 1.);
            // The mirror direction, or the one straight through.
            svg +=
                fmt::format("<circle cx='{:.1f}' r='3' fill='none' stroke='{}'/></g>\n",
                            radius * std::sqrt(2.) * std::sin(0.5 * incidences[i] * degree), ink);
            svg += text_at(x, y + radius + 15., fmt::format("{:.0f} % known", 100. * disc.share));
        }
    }
    double x = left;
    for (const auto& [colour, name] :
         {std::pair{known_colour, "known"}, std::pair{negative_colour, "known, negative"},
          std::pair{unknown_colour, "not known"}}) {
        svg += fmt::format("<rect x='{:.0f}' y='{:.0f}' width='12' height='12' fill='{}'/>\n", x,
                           height - 24., colour);
        svg += text_at(x + 18., height - 14., name, "start");
        x += 130.;
    }
    svg +=
        text_at(x, height - 14.,
                "exits seen from above, circles at 30° and 60°; small circle: mirrored or straight",
                "start");
    return svg + "</svg>\n";
}

}  // namespace nacre::cli
