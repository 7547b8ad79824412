#include "nacre/goniometer/instrument.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <limits>

#include "nacre/math/error.h"
#include "nacre/math/frame.h"
#include "nacre/math/normal_number.h"

namespace nacre {
namespace {

constexpr double pi = std::numbers::pi, degree = pi / 180.;

struct Defaults {
    double incidence, exit, blocked, source, detector, noise, floor;
    bool isotropic;
};

std::vector<Parameter> instrument_parameters(const Defaults& d) {
    const auto angle = [](std::string_view name, std::string_view meaning, double otherwise) {
        return Parameter{.name = name,
                         .meaning = meaning,
                         .unit = "degrees",
                         .high = 90.,
                         .otherwise = otherwise};
    };
    return {
        angle("incidence", "largest polar angle of the light", d.incidence),
        angle("exit", "largest polar angle of the detector", d.exit),
        angle("blocked", "half-angle about the source that the detector does not reach", d.blocked),
        angle("source", "half-angle of the cone of the light", d.source),
        angle("detector", "half-angle of the cone of the detector", d.detector),
        {.name = "noise",
         .meaning = "standard deviation of a reading, a share of it",
         .otherwise = d.noise},
        {.name = "floor",
         .meaning = "standard deviation of a dark reading",
         .unit = "sr^-1",
         .high = 1e6,
         .otherwise = d.floor},
        choice_parameter("isotropic", "whether it measures at one azimuth of incidence only",
                         {{"no", "it turns the sample, too"}, {"yes", "for isotropic samples"}},
                         d.isotropic ? 1 : 0),
        {.name = "seed", .meaning = "of its noise", .kind = ParameterKind::integer, .high = 1e9}};
}

const InstrumentDescription foo{
    .name = "foo",
    .title = "Foo's gonioreflectometer",
    .meaning =
        "three axes, so for isotropic samples; parallel light; a still detector behind a mirror; "
        "up to 86 degrees. Known: the axes, the 86 degrees. Assumed: all else",
    .parameters = instrument_parameters({86., 86., 4., 0.5, 1., 0.02, 1e-4, true}),
    .references = {"S. C. Foo 1997, A Gonioreflectometer for Measuring the Bidirectional "
                   "Reflectance of Material for Use in Illumination Computation, MS thesis, "
                   "Cornell University"},
};

const InstrumentDescription cornell{
    .name = "cornell",
    .title = "Cornell's tables",
    .meaning =
        "Foo's instrument as in the tables of paints that Cornell published: up to 80 degrees of "
        "incidence, 79 of exit. Known: these angles, from the files. Assumed: all else",
    .parameters = instrument_parameters({80., 79., 4., 0.5, 1., 0.02, 1e-4, true}),
    .references = {"Cornell University Program of Computer Graphics, Reflectance Data"},
};

const InstrumentDescription ward{
    .name = "ward",
    .title = "Ward's imaging gonioreflectometer",
    .meaning =
        "a half-silvered hemisphere and a fish-eye lens show all directions at once, the source "
        "and the sample turn; noisier, and blind near the horizon. Known: that. Assumed: all "
        "numbers",
    .parameters = instrument_parameters({75., 75., 0., 1., 1., 0.05, 2e-3, false}),
    .references = {"G. J. Ward 1992, Measuring and Modeling Anisotropic Reflection, SIGGRAPH 92"},
};

/// Points spread evenly over the disc of that radius.
std::vector<Vec2<double>> disc(double radius, int count) {
    if (radius == 0.) return {{0., 0.}};
    std::vector<Vec2<double>> points;
    for (int i = 0; i < count; ++i) {
        const double r = radius * std::sqrt((i + 0.5) / count), phi = i * pi * (3. - std::sqrt(5.));
        points.push_back({r * std::cos(phi), r * std::sin(phi)});
    }
    return points;
}

/// Directions about the normal that detector and source see at once, as the detector's own: light
/// from beside the middle of the source goes beside, as from a mirror.
std::vector<Vec3d> cone(const Instrument& instrument) {
    const int each = instrument.source > 0. && instrument.detector > 0. ? 20 : 400;
    std::vector<Vec3d> directions;
    for (const Vec2<double>& a : disc(instrument.source * degree, each))
        for (const Vec2<double>& b : disc(instrument.detector * degree, each)) {
            const double x = a.x + b.x, y = a.y + b.y, angle = std::hypot(x, y);
            const double s = angle > 0. ? std::sin(angle) / angle : 1.;
            directions.push_back({x * s, y * s, std::cos(angle)});
        }
    return directions;
}

}  // namespace

const Catalogue<InstrumentDescription>& instruments() {
    static const InstrumentDescription* const list[] = {&cornell, &foo, &ward};
    static const Catalogue<InstrumentDescription> all("instrument", std::span(list));
    return all;
}

Instrument make_instrument(std::string_view text) {
    const std::size_t begin = std::min(text.find_first_not_of(" \t"), text.size());
    const std::size_t end = std::min(text.find_first_of(" \t", begin), text.size());
    const InstrumentDescription& d = instruments().find(text.substr(begin, end - begin));
    const ParameterValues v(d.name, d.parameters, parse_settings(text.substr(end)));
    return {std::string(d.name), v.number("incidence"), v.number("exit"),
            v.number("blocked"), v.number("source"),    v.number("detector"),
            v.number("noise"),   v.number("floor"),     v.word("isotropic") == "yes",
            v.whole("seed")};
}

void check_azimuths(const Instrument& instrument, const MeasurementSet& set) {
    for (const IncidenceMeasurement& m : set.incidences)
        if (instrument.isotropic && m.incidence.phi() != set.incidences.front().incidence.phi())
            throw InputError(
                fmt::format("the instrument {} measures at one azimuth of incidence: isotropic "
                            "surfaces, --turned; or isotropic=no",
                            instrument.name));
}

std::vector<InstrumentReading> read_instrument(const Instrument& instrument,
                                               const MeasurementSet& set) {
    const int lanes = std::min(3, int(set.lanes.size()));
    check_azimuths(instrument, set);
    const std::vector<Vec3d> directions = cone(instrument);
    std::vector<InstrumentReading> readings(set.incidences.size());
    tbb::parallel_for(std::size_t(0), readings.size(), [&](std::size_t n) {
        const IncidenceMeasurement& m = set.incidences[n];
        InstrumentReading& r = readings[n];
        constexpr double nan = std::numeric_limits<double>::quiet_NaN();
        r.value.assign(m.bins.size(), {nan, nan, nan});
        r.reached = m.rays > 0 && m.incidence.theta() <= instrument.incidence * degree;
        double all = 0., seen = 0., blur = 0., noise = 0.;
        for (int k = 0; k < lanes; ++k) all += m.reflected(k).value + m.transmitted(k).value;
        if (!r.reached) return;
        const Vec3d light = DirectionCell::at(m.incidence.theta(), m.incidence.phi()).draw(0., 0.);
        for (std::size_t bin = 0; bin < m.bins.size(); ++bin) {
            const DirectionCell cell = m.bins.cell(bin);
            const Vec3d middle = DirectionCell::at(cell.theta(), cell.phi()).draw(0., 0.);
            if (cell.theta() > instrument.exit * degree ||
                dot(middle, light) > std::cos(instrument.blocked * degree))
                continue;
            const auto frame = Frame<double>::around(middle);
            Random random(stream_key(std::uint64_t(instrument.seed), n, bin, 0x696e7374));
            for (int k = 0; k < lanes; ++k) {
                // The detector gathers the light of its cone and divides by its middle's cosine.
                double sum = 0.;
                for (const Vec3d& d : directions) {
                    const Vec3d w = frame.to_world(d);
                    if (w.z > 0.) sum += m.brdf(m.bins.index(w), k).value * w.z;
                }
                const double truth = m.brdf(bin, k).value;
                const double blurred =
                    directions.size() == 1 ? truth : sum / (double(directions.size()) * middle.z);
                const double found = blurred * (1. + instrument.noise * normal_number(random)) +
                                     instrument.floor * normal_number(random);
                const double light_of = cell.projected_solid_angle();
                r.value[bin][std::size_t(k)] = found;
                seen += truth * light_of;
                blur += std::abs(blurred - truth) * light_of;
                noise += std::abs(found - blurred) * light_of;
            }
        }
        if (!(all > 0.)) return;
        r.outside = 1. - seen / all;
        r.blur = blur / all;
        r.noise = noise / all;
    });
    return readings;
}

std::string csv_of(const MeasurementSet& set, const std::string& instrument,
                   const std::vector<InstrumentReading>& readings) {
    return csv_of(
        set,
        fmt::format("virtual gonioreflectometer of nacre, as the instrument '{}' would "
                    "have reported",
                    instrument),
        [&](std::size_t n, bool, std::size_t bin, int lane) {
            return readings[n].value[bin][std::size_t(lane)];
        },
        false);
}

}  // namespace nacre
