// Poulin and Fournier's cylinders against rays cast at the cross-section, closed forms, bounds.
#include "nacre/math/error.h"
#include "nacre/math/quadrature.h"
#include "nacre/math/random.h"
#include "nacre/reflectance/cylinder_profile.h"
#include "nacre/reflectance/registry.h"
#include "tests/reflectance/family_data.h"

namespace nacre {
namespace {

using test::at_degrees;

struct Cylinders {
    bool raised;
    double spacing, depth;

    std::string text() const {
        return fmt::format("profile={} spacing={} depth={}", raised ? "raised" : "grooved", spacing,
                           depth);
    }
};

/// The surface as a height over y, with no knowledge of what is seen: ground truth by looking.
struct HeightField {
    Cylinders c;

    /// From the axis nearest to y.
    double offset(double y) const { return y - c.spacing * std::round(y / c.spacing); }
    bool on_arc(double y) const {
        const double o = offset(y);
        return std::abs(o) < 1. && std::sqrt(1. - o * o) > 1. - c.depth;
    }
    double height(double y) const {
        const double o = offset(y);
        const double h = on_arc(y) ? std::sqrt(1. - o * o) : 1. - c.depth;
        return c.raised ? h : -h;
    }
    Vec2<double> normal(double y) const {  // y and z
        if (!on_arc(y)) return {0., 1.};
        const double o = offset(y);
        return {c.raised ? o : -o, std::sqrt(1. - o * o)};
    }
    /// Whether the ray from the surface at y towards (dy, dz) gets away: its height above the
    /// surface over steps that are finer at the start, and each minimum between them searched.
    bool sees(double y, double dy, double dz) const {
        const Vec2<double> n = normal(y);
        if (n.x * dy + n.y * dz <= 0.) return false;
        const double top = c.raised ? 1. : -(1. - c.depth), z0 = height(y);
        const auto clearance = [&](double s) { return z0 + s * dz - height(y + s * dy); };
        const double end = 1.3 * (top - z0) / dz + 1e-3;
        constexpr int steps = 300;
        const auto at = [&](int i) { return end * (double(i) / steps) * (double(i) / steps); };
        double before = 0., here = clearance(at(1));
        for (int i = 1; i < steps; ++i) {
            const double next = clearance(at(i + 1));
            if (here < -1e-12) return false;
            if (here <= before && here <= next) {
                double low = at(i - 1), high = at(i + 1);
                for (int k = 0; k < 90; ++k) {
                    const double a = low + (high - low) / 3., b = high - (high - low) / 3.;
                    (clearance(a) < clearance(b) ? high : low) =
                        clearance(a) < clearance(b) ? b : a;
                }
                if (clearance(0.5 * (low + high)) < -1e-12) return false;
            }
            before = here;
            here = next;
        }
        return true;
    }
};

/// f_matt pi / kd, and f_glossy / ks for each exponent, as integrals over what both directions are
/// found to see: on a grid whose transitions are then bisected.
struct Truth {
    double matt = 0., glossy[2] = {};
};
constexpr double exponents[2] = {3., 60.};

Truth cast(const Cylinders& c, const Vec3d& wi, const Vec3d& wo) {
    static const GaussLegendre nodes(64);
    const HeightField field{c};
    const Vec3d h = normalize(wi + wo);
    const double area = c.spacing * wi.z * wo.z;
    Truth sum;
    const auto add = [&](double y, double length) {
        const Vec2<double> m = field.normal(y);
        const double cosines = (m.x * wi.y + m.y * wi.z) * (m.x * wo.y + m.y * wo.z) / area;
        sum.matt += cosines * length;
        for (int k = 0; k < 2; ++k) {
            const double n = exponents[k];
            const double norm =
                (n + 2.) * (n + 4.) / (8. * std::numbers::pi * (std::pow(2., -0.5 * n) + n));
            sum.glossy[k] +=
                norm * std::pow(std::max(0., m.x * h.y + m.y * h.z), n) * cosines * length;
        }
    };
    // `y_of` maps equal lengths of (low, high) to equal lengths of the surface.
    const auto over = [&](double low, double high, auto&& y_of) {
        constexpr int cells = 100;  // dense at the ends, near which shadows may be short
        const auto seen = [&](double x) {
            return field.sees(y_of(x), wi.y, wi.z) && field.sees(y_of(x), wo.y, wo.z);
        };
        const auto at = [&](int k) {
            return low + (high - low) * 0.5 * (1. - std::cos(std::numbers::pi * (k + 0.5) / cells));
        };
        double from = low;
        bool before = seen(at(0));
        for (int k = 1; k <= cells; ++k) {
            const bool now = k < cells && seen(at(k));
            if (now == before) continue;
            double a = at(k - 1), b = k < cells ? at(k) : high;
            for (int step = 0; k < cells && step < 40; ++step) {
                const double middle = 0.5 * (a + b);
                (seen(middle) == before ? a : b) = middle;
            }
            for (int i = 0; before && i < 64; ++i)
                add(y_of(0.5 * (from + b) + 0.5 * (b - from) * nodes.node[i]),
                    0.5 * (b - from) * nodes.weight[i]);
            from = b;
            before = now;
        }
    };
    const double w = std::min(std::sqrt(c.depth * (2. - c.depth)), 0.5 * c.spacing);
    const double end = std::asin(w);
    over(-end, end, [](double t) { return std::sin(t); });
    if (0.5 * c.spacing > w) over(w, c.spacing - w, [](double y) { return y; });
    return sum;
}

std::vector<Cylinders> several() {
    std::vector<Cylinders> all;
    for (bool raised : {true, false})
        for (double spacing : {0.7, 2., 2.6, 9.})
            for (double depth : {0.15, 0.6, 1.}) all.push_back({raised, spacing, depth});
    return all;
}

double value(const std::string& settings, const Vec3d& wi, const Vec3d& wo) {
    return make_model("poulin_fournier", parse_settings(settings)).eval(wi, wo);
}

const std::pair<Vec3d, Vec3d> looks[] = {{at_degrees(0.), at_degrees(0.)},
                                         {at_degrees(0.), at_degrees(50., 90.)},
                                         {at_degrees(40., 70.), at_degrees(55., 80.)},
                                         {at_degrees(40., 70.), at_degrees(55., -100.)},
                                         {at_degrees(75., 90.), at_degrees(75., -90.)},
                                         {at_degrees(75., 90.), at_degrees(70., 60.)},
                                         {at_degrees(86., 100.), at_degrees(30., -20.)},
                                         {at_degrees(86., 95.), at_degrees(85., 85.)},
                                         {at_degrees(80., 5.), at_degrees(80., 185.)},
                                         {at_degrees(88., 90.), at_degrees(88., -60.)}};

}  // namespace

// What limits the truth is the rays' steps near tangents and the midpoint rule.
TEST(PoulinFournier, AgreesWithRaysCastAtTheCrossSection) {
    for (const Cylinders& c : several())
        for (const auto& [wi, wo] : looks) {
            const Truth truth = cast(c, wi, wo);
            const auto is = [&](const char* part, double f, double expected) {
                EXPECT_NEAR(f, expected, 2e-6 * expected + 1e-8)
                    << part << " of " << c.text() << " wi " << wi.y << " " << wi.z << " wo " << wo.y
                    << " " << wo.z;
            };
            is("kd", std::numbers::pi * value(c.text() + " kd=1 ks=0", wi, wo), truth.matt);
            for (int k = 0; k < 2; ++k)
                is("ks", value(fmt::format("{} kd=0 ks=1 n={}", c.text(), exponents[k]), wi, wo),
                   truth.glossy[k]);
        }
}

// The error that cylinder_profile.h states, from broad lobes to those of a thousandth of a radian.
TEST(PoulinFournier, TheQuadratureIsAsExactAsItSays) {
    constexpr int pieces = 1000;
    const GaussLegendre fine(16);
    Random random(stream_key(3, 1));
    for (CylinderProfile profile : {CylinderProfile::raised, CylinderProfile::grooved})
        for (double power : {0., 1., 7.5, 200., 1e4, 1e6}) {
            const CylinderSection<double> section(profile, 2.2, 0.9);
            int seen = 0;
            for (int i = 0; i < 24; ++i) {
                const auto somewhere = [&] {
                    return at_degrees(85. * std::sqrt(random.next()), 360. * random.next());
                };
                const Vec3d wi = somewhere();
                Vec3d wo = somewhere();
                if (i % 2) {  // on the cone of mirror directions, or a little beside
                    const double x = -wi.x * (1. + 1e-4 * random.next());
                    const double scale = std::sqrt((1. - x * x) / (1. - wo.x * wo.x));
                    wo = {x, wo.y * scale, wo.z * scale};
                }
                const auto common = section.common(wi, wo);
                const Vec3d h = normalize(wi + wo);
                const double low = common.middle - common.half, step = 2. * common.half / pieces;
                double exact = 0.;
                for (int k = 0; k < pieces; ++k)
                    exact += fine.integrate(low + k * step, low + (k + 1) * step, [&](double t) {
                        const double s = std::sin(t), c = std::cos(t);
                        const auto facing = [&](const Vec3d& w) {
                            return section.facing(w, s, c).x;
                        };
                        return std::pow(facing(h), power) * facing(wi) * facing(wo);
                    });
                if (!(exact > 1e-200)) continue;
                ++seen;
                EXPECT_NEAR(section.glossy(wi, wo, power, common.middle, common.half), exact,
                            1e-6 * exact)
                    << power << " " << i;
            }
            EXPECT_GT(seen, 8) << power;
        }
}

// Without depth nothing is left of the cylinders.
TEST(PoulinFournier, IsBlinnPhongWithoutDepth) {
    for (const char* profile : {"raised", "grooved"})
        for (const auto& [wi, wo] : looks) {
            const char* rest = "kd=0.3 ks=0.6 n=40";
            const double flat = make_model("blinn_phong", parse_settings(rest)).eval(wi, wo);
            EXPECT_NEAR(value(fmt::format("profile={} depth=0 {}", profile, rest), wi, wo), flat,
                        1e-9 * flat);
        }
}

// A matt half cylinder against its neighbours, lit and seen from above: 1/(2 cos^2) of the
// integral of cos^2 over the half circle, pi/2, over the spacing 2.
TEST(PoulinFournier, ClosedFormsOfHalfCircles) {
    const Vec3d up{0., 0., 1.};
    for (const char* profile : {"raised", "grooved"}) {
        const std::string text = fmt::format("profile={} depth=1 kd=0.8 ks=0", profile);
        EXPECT_NEAR(value(text + " spacing=2", up, up), 0.8 * inv_pi * std::numbers::pi / 4., 1e-9);
        // Half of the period flat.
        EXPECT_NEAR(value(text + " spacing=4", up, up),
                    0.8 * inv_pi * (0.5 + std::numbers::pi / 8.), 1e-9);
        // Along the cylinders everything is seen, however flat: the same, by projection.
        const Vec3d low{std::sqrt(1. - 0.01), 0., 0.1};
        EXPECT_NEAR(value(text + " spacing=2", low, up), 0.8 * inv_pi * std::numbers::pi / 4.,
                    1e-9);
    }
    // Raised, from opposite sides at 45 degrees: seen and lit between -45 and 45 degrees, where the
    // product of cosines is cos(2t)/2; its integral is 1/2, over 2 cos^2 = 1.
    EXPECT_NEAR(value("profile=raised depth=1 kd=1 ks=0 spacing=2", at_degrees(45., 90.),
                      at_degrees(45., -90.)),
                inv_pi * 0.5, 1e-9);
    // Grooves from opposite sides beyond 45 degrees: each sees less than the half opposite.
    EXPECT_NEAR(value("profile=grooved depth=1 kd=1 ks=0 spacing=2", at_degrees(46., 90.),
                      at_degrees(46., -90.)),
                0., 1e-12);
}

// The paper's picture: a highlight along the cylinders is as narrow as that of a flat surface,
// across them it spreads.
TEST(PoulinFournier, HighlightsSpreadAcrossTheCylinders) {
    const Vec3d wi = at_degrees(30., 0.);
    const char* text = "kd=0 ks=1 n=2000 spacing=1.7 depth=0.5";
    const double peak = value(text, wi, at_degrees(30., 180.));
    EXPECT_LT(value(text, wi, at_degrees(50., 180.)), 1e-4 * peak);
    // 20 degrees away across: the normal turned by some ten degrees.
    const Vec3d across{-std::sin(0.5236), std::sin(0.35) * std::cos(0.5236),
                       std::cos(0.35) * std::cos(0.5236)};
    EXPECT_GT(value(text, wi, across), 0.5 * peak);
}

// Single precision and packs against double precision, towards the rim.
TEST(PoulinFournier, SinglePrecisionKeepsItsDigits) {
    Random random(stream_key(7, 1));
    for (const Cylinders& c : several())
        for (double n : {2., 100., 1e4}) {
            const AnyModel model =
                make_model("poulin_fournier",
                           parse_settings(fmt::format("{} kd=0.4 ks=0.6 n={}", c.text(), n)));
            std::vector<Vec3f> in, out;
            for (int i = 0; i < 64; ++i) {
                const auto somewhere = [&] {
                    const double z = 0.02 + 0.97 * random.next();
                    return Vec3f(at_degrees(std::acos(z) * 180. * inv_pi, 360. * random.next()));
                };
                in.push_back(somewhere());
                out.push_back(somewhere());
            }
            std::vector<float> many(in.size());
            model.eval_many(in, out, many);
            for (std::size_t i = 0; i < in.size(); ++i) {
                const double exact = model.eval(normalize(Vec3d(in[i])), normalize(Vec3d(out[i])));
                // Exponents above 1e3 turn the rounding of a direction, 6e-8, into 1e-3 in the
                // tails of the lobe.
                EXPECT_NEAR(many[i], exact, (1e-4 + 2e-7 * n) * exact + 1e-5)
                    << c.text() << " n=" << n << " " << in[i].y << " " << in[i].z << " " << out[i].y
                    << " " << out[i].z;
            }
        }
}

TEST(PoulinFournier, WrongParameters) {
    const std::pair<const char*, const char*> wrong[] = {
        {"spacing=0", "poulin_fournier: spacing = 0 is out of range: must lie within [0.1, 1000]"},
        {"depth=1.5", "poulin_fournier: depth = 1.5 is out of range: must lie within [0, 1]"},
        {"profile=standing",
         "poulin_fournier: unknown profile 'standing'; known are: raised, grooved"},
        {"kd=0.5 ks=0.6",
         "poulin_fournier: kd + ks = 1.1 is out of range: must lie within [0, 1], lest energy "
         "appear from nowhere"}};
    for (const auto& [settings, expected] : wrong) try {
            make_model("poulin_fournier", parse_settings(settings));
            ADD_FAILURE() << settings;
        } catch (const InputError& e) {
            EXPECT_STREQ(e.what(), expected);
        }
}

}  // namespace nacre
