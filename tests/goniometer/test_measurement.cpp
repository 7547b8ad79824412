// The virtual gonioreflectometer where what it must find is known: flat surfaces, V-shaped grooves,
// cylinders, random heights; and that its errors are what it says.
#include "nacre/goniometer/measurement.h"

#include "nacre/goniometer/patch_material.h"
#include "nacre/math/error.h"
#include "nacre/math/quadrature.h"
#include "nacre/math/statistics.h"
#include "nacre/reflectance/microfacet.h"
#include "nacre/reflectance/registry.h"

namespace nacre {
namespace {

constexpr double degree = std::numbers::pi / 180.;

Patch patch_of(const char* geometry, const char* material) {
    return make_patch(make_microgeometry(geometry),
                      surface_bsdf(material, Wavelengths::rgb_bands()));
}
DirectionCell from(double theta, double phi = 0.) {
    return DirectionCell::at(theta * degree, phi * degree);
}
Vec3d direction(const DirectionCell& c) { return c.draw(0.5, 0.5); }

IncidenceMeasurement measured(const Patch& patch, const DirectionCell& incidence,
                              MeasureOptions options, std::uint64_t rays) {
    options.least_rays = options.most_rays = rays;
    IncidenceMeasurement m(incidence, options.bins);
    measure(patch, options, m);
    return m;
}

/// Mean of a BRDF over a bin by the measure of the measurement, the cosine.
template <class F>
double mean_over(const DirectionCell& cell, F&& f) {
    static const GaussLegendre nodes(6);
    return nodes.integrate(0., 1., [&](double u) {
        return nodes.integrate(0., 1., [&](double v) { return f(cell.draw(u, v)); });
    });
}

/// Probability that the bins are as far from `expected(cell)` as they are by chance: chi-square
/// over bins in which at least `least` rays are expected, by the expected variance where all rays
/// weigh `weight`, else by the measured one.
template <class F>
double fit(const IncidenceMeasurement& m, F&& expected, double least, double weight = 0.) {
    double statistic = 0.;
    int cells = 0;
    for (std::size_t i = 0; i < m.bins.size(); ++i) {
        const DirectionCell cell = m.bins.cell(i);
        const double f = expected(cell), cosine = cell.projected_solid_angle();
        const MeasuredValue v = m.brdf(i, 0);
        double error = v.error;
        if (weight > 0.) {
            const double share = f * cosine / weight;
            if (share * double(m.rays) < least) continue;
            error = weight * std::sqrt(share * (1. - share) / double(m.rays)) / cosine;
        } else if (v.value * cosine * double(m.rays) < least)
            continue;
        const double z = (v.value - f) / error;
        statistic += z * z;
        ++cells;
    }
    EXPECT_GT(cells, 20);
    return chi_square_probability(statistic, cells);
}

}  // namespace

TEST(HemisphereBins, CellsFillTheHemisphere) {
    const HemisphereBins bins{7, 10};
    double sum = 0.;
    for (std::size_t i = 0; i < bins.size(); ++i) {
        const DirectionCell c = bins.cell(i);
        sum += c.projected_solid_angle();
        for (double u : {0.02, 0.5, 0.98})
            for (double v : {0.02, 0.5, 0.98}) {
                EXPECT_EQ(bins.index(c.draw(u, v)), i);
                const Vec3d w = c.draw(u, v);
                EXPECT_EQ(bins.index({w.x, w.y, -w.z}), i);
            }
    }
    EXPECT_NEAR(sum, std::numbers::pi, 1e-12);
}

TEST(Measurement, FlatLambertIsLambert) {
    const Patch patch = patch_of("flat", "lambert reflectance=0.7");
    const auto m = measured(patch, from(50., 20.), {.bins = {9, 18}}, 400'000);
    EXPECT_GT(fit(
                  m, [](const DirectionCell&) { return 0.7 * std::numbers::inv_pi; }, 20., 0.7),
              1e-4);
    EXPECT_NEAR(m.reflected(0).value, 0.7, 1e-6);
    EXPECT_EQ(m.transmitted(0).value, 0.);
    EXPECT_EQ(m.lost(0).value, 0.);
    // A wrong albedo would have been seen.
    EXPECT_LT(fit(
                  m, [](const DirectionCell&) { return 0.72 * std::numbers::inv_pi; }, 20., 0.72),
              1e-6);
}

// Any model on a flat surface comes back, highlights and anisotropy too.
TEST(Measurement, FlatMaterialsAreThemselves) {
    for (const char* text :
         {"ward kd=0.2 ks=0.6 alpha_u=0.2 alpha_v=0.5", "phong variant=classic kd=0.2 ks=0.3 n=5",
          "poulin_fournier kd=0.3 ks=0.6 n=10 depth=0.8"}) {
        const std::string_view all = text;
        const AnyModel model =
            make_model(all.substr(0, all.find(' ')), parse_settings(all.substr(all.find(' '))));
        const auto m = measured(patch_of("flat", text), from(40., 65.), {.bins = {9, 18}}, 200'000);
        const Vec3d wi = direction(m.incidence);
        EXPECT_GT(fit(
                      m,
                      [&](const DirectionCell& c) {
                          return mean_over(c, [&](const Vec3d& w) { return model.eval(wi, w); });
                      },
                      50.),
                  1e-4)
            << text;
    }
}

TEST(Measurement, AMirrorReflectsToItsBinAlone) {
    const auto m = measured(patch_of("flat", "mirror"), from(33., 31.), {}, 10'000);
    const Vec3d wi = direction(m.incidence);
    const std::size_t there = m.bins.index({-wi.x, -wi.y, wi.z});
    for (std::size_t i = 0; i < m.bins.size(); ++i) {
        EXPECT_EQ(m.brdf(i, 0).value > 0., i == there) << i;
    }
    EXPECT_EQ(m.reflected(0).value, 1.);
}

// White surfaces lose nothing, whatever their shape.
TEST(Measurement, WhiteFurnaces) {
    for (const char* geometry :
         {"cylinders depth=1", "cylinders profile=grooved depth=1", "v_grooves angle=60",
          "gaussian alpha=0.6 points=64 lengths=8", "brushed points=256 lengths=20",
          "fibres fibres=6 length=10", "weave pieces=12 warp=0.7"}) {
        const auto m = measured(patch_of(geometry, "lambert reflectance=1"), from(60., 40.),
                                {.bins = {6, 6}}, 8192);
        EXPECT_NEAR(m.reflected(0).value + m.transmitted(0).value, 1., 1e-3) << geometry;
        if (std::string_view(geometry).starts_with("weave"))
            EXPECT_GT(m.transmitted(0).value, 0.005);
        else
            EXPECT_EQ(m.transmitted(0).value, 0.) << geometry;
    }
}

/// A mirror that keeps a share of the light.
class DimMirror final : public DeltaBsdf {
  public:
    explicit DimMirror(float share) : share_(share) {}
    std::optional<BsdfSample> sample(const Vec3f& wo, float, Vec2f) const override {
        return BsdfSample{
            .wi = {-wo.x, -wo.y, wo.z}, .weight = Spectral(share_), .pdf = 1.f, .delta = true};
    }

  private:
    float share_;
};

// Mirrors that enclose 12 degrees, with light along their middle, send it back after 15 reflections:
// a straight line past fifteen of them, once they are unfolded. Roulette ends some rays before.
TEST(Measurement, ManyReflectionsLoseWhatTheyMust) {
    const DimMirror mirror(0.9f);
    const Patch patch = make_patch(make_microgeometry("v_grooves angle=84"),
                                   [&](const SurfacePoint&, const Wavelengths&,
                                       BsdfScratch&) -> const Bsdf& { return mirror; });
    const auto m = measured(patch, from(0.), {.bins = {4, 4}}, 60'000);
    EXPECT_GT(m.reflected(0).error, 0.);
    EXPECT_NEAR(m.reflected(0).value, std::pow(0.9, 15), 4. * m.reflected(0).error);
    EXPECT_LT(m.reflected(0).error, 0.01 * m.reflected(0).value);
}

// Torrance and Sparrow's factor G for each side of alike grooves, in the plane across and beside.
TEST(Measurement, VGroovesMaskAsTorranceAndSparrowSay) {
    for (double angle : {20., 45., 65.})
        for (const auto& [theta, phi] :
             {std::pair(10.3, 91.), {50.4, 90.3}, {70.2, 60.4}, {60.3, 20.7}}) {
            const std::string geometry = fmt::format("v_grooves angle={}", angle);
            const auto m = measured(patch_of(geometry.c_str(), "mirror"), from(theta, phi),
                                    {.bins = {90, 360}, .orders = 1}, 50'000);
            const Vec3d wi = direction(m.incidence);
            double all = 0.;
            for (double side : {-1., 1.}) {
                const double a = angle * degree;
                const Vec3d h{0., side * std::sin(a), std::cos(a)};
                const double u = dot(wi, h);
                const Vec3d wo = reflect(wi, h);
                if (u <= 0. || wo.z <= 0.) continue;
                const double masked = std::min({1., 2. * h.z * wi.z / u, 2. * h.z * wo.z / u});
                const double share = masked * u / (2. * std::cos(a) * wi.z);
                const std::size_t bin = m.bins.index(wo);
                const double cosine = m.bins.cell(bin).projected_solid_angle();
                EXPECT_NEAR(m.brdf(bin, 0).value * cosine, share,
                            4. * m.brdf(bin, 0).error * cosine + 1e-6)
                    << angle << " " << theta << " " << phi << " " << side;
                all += share;
            }
            EXPECT_NEAR(m.reflected(0).value, all, 4. * m.reflected(0).error + 1e-6)
                << angle << " " << theta << " " << phi;
        }
}

// Grooves of Torrance and Sparrow's distribution in all directions are their model.
TEST(Measurement, ManyVGroovesAreTheModelOfTorranceAndSparrow) {
    const Patch patch = patch_of("v_grooves m=0.3 grooves=1000", "mirror");
    const AnyModel model =
        make_model("torrance_sparrow", parse_settings("kd=0 ks=1 m=0.3 fresnel=one"));
    for (double theta : {20., 65.}) {
        const auto m =
            measured(patch, from(theta), {.bins = {9, 12}, .orders = 1, .turned = true}, 250'000);
        const Vec3d wi = direction(m.incidence);
        EXPECT_GT(fit(
                      m,
                      [&](const DirectionCell& c) {
                          return mean_over(c, [&](const Vec3d& w) { return model.eval(wi, w); });
                      },
                      100., 1.),
                  1e-4)
            << theta;
    }
}

// Mirrors on random heights against Beckmann's distribution with Smith's masking: sixteen periods of
// 16 correlation lengths, whose scatter is the error. Smith takes heights and slopes as independent;
// up to 40 degrees and for this roughness that is less than the error.
TEST(Measurement, GaussianHeightsAreSmithAndBeckmann) {
    constexpr double alpha = 0.3;
    constexpr int periods = 16;
    const auto shadow = [&](const Vec3d& w) {
        const double tangent = std::sqrt(std::max(1e-12, 1. - w.z * w.z)) / w.z;
        return 1. / (1. + smith_beckmann_lambda(1. / (alpha * tangent)));
    };
    for (double theta : {0., 40.}) {
        const MeasureOptions options{.bins = {6, 6}, .orders = 1, .turned = true};
        std::vector<IncidenceMeasurement> all;
        for (int i = 0; i < periods; ++i)
            all.push_back(measured(
                patch_of(fmt::format("gaussian alpha=0.3 points=96 lengths=16 seed={}", i).c_str(),
                         "mirror"),
                from(theta), options, 12'288));
        const Vec3d wi = direction(all[0].incidence);
        double statistic = 0., reflected = 0.;
        int cells = 0;
        for (std::size_t b = 0; b < options.bins.size(); ++b) {
            const DirectionCell cell = options.bins.cell(b);
            const double f = mean_over(cell, [&](const Vec3d& w) {
                const Vec3d h = normalize(wi + w);
                const double tangent2 = (1. - h.z * h.z) / (h.z * h.z), z4 = std::pow(h.z, 4);
                const double d =
                    std::exp(-tangent2 / (alpha * alpha)) / (std::numbers::pi * alpha * alpha * z4);
                return d * shadow(wi) * shadow(w) / (4. * wi.z * w.z);
            });
            reflected += f * cell.projected_solid_angle();
            double sum = 0., square = 0.;
            for (const IncidenceMeasurement& m : all) {
                const double v = m.brdf(b, 0).value;
                sum += v / periods;
                square += v * v / periods;
            }
            if (f * cell.projected_solid_angle() < 0.003) continue;
            const double z = (sum - f) / std::sqrt((square - sum * sum) / (periods - 1));
            // The square of Student's t with 15 degrees of freedom has the mean 15/13.
            statistic += z * z * 13. / 15.;
            ++cells;
        }
        EXPECT_GT(cells, 12) << theta;
        // Heavier tails than chi-square's: one in a million stands for one in ten thousand.
        EXPECT_GT(chi_square_probability(statistic, cells), 1e-6) << theta << " " << statistic;
        double found = 0.;
        for (const IncidenceMeasurement& m : all) found += m.reflected(0).value / periods;
        EXPECT_NEAR(found, reflected, 0.01);
    }
}

// The same cylinders as triangles and by formula.
TEST(Measurement, CylindersLitOnceAreThoseOfPoulinAndFournier) {
    for (const char* shape :
         {"profile=raised spacing=2.5 depth=0.8", "profile=grooved spacing=2.2 depth=1"}) {
        const std::string geometry = fmt::format("cylinders {} pieces=400", shape);
        const Patch patch = patch_of(geometry.c_str(), "blinn_phong kd=0.3 ks=0.6 n=12");
        const AnyModel model = make_model(
            "poulin_fournier", parse_settings(fmt::format("{} kd=0.3 ks=0.6 n=12", shape)));
        for (const auto& [theta, phi] : {std::pair(20., 40.), {70., 80.}}) {
            const auto m =
                measured(patch, from(theta, phi), {.bins = {9, 18}, .orders = 1}, 100'000);
            const Vec3d wi = direction(m.incidence);
            EXPECT_GT(fit(
                          m,
                          [&](const DirectionCell& c) {
                              return mean_over(c,
                                               [&](const Vec3d& w) { return model.eval(wi, w); });
                          },
                          50.),
                      1e-4)
                << shape << " " << theta << " " << phi;
            EXPECT_GT(m.blocked(0).value, 0.001);
        }
    }
}

TEST(Measurement, ExchangedDirectionsGiveTheSame) {
    const Patch patch =
        patch_of("fibres fibres=8 length=12 lean=30", "blinn_phong kd=0.5 ks=0.4 n=5");
    const HemisphereBins bins{6, 8};
    const std::pair<std::size_t, std::size_t> pairs[] = {{1, 37}, {10, 29}, {33, 12}};
    for (const auto& [a, b] : pairs) {
        const auto there = measured(patch, bins.cell(a), {.bins = bins}, 40'000);
        const auto back = measured(patch, bins.cell(b), {.bins = bins}, 40'000);
        const MeasuredValue f = there.brdf(b, 0), g = back.brdf(a, 0);
        EXPECT_NEAR(f.value, g.value, 4. * std::hypot(f.error, g.error)) << a << " " << b;
        EXPECT_LT(f.error, 0.15 * f.value);
    }
}

// The scatter of repeated measurements is the standard error that each of them states.
TEST(Measurement, ErrorsAreWhatTheySay) {
    const Patch patch = patch_of("v_grooves angle=50", "lambert reflectance=0.6");
    constexpr int repeats = 40;
    double sum = 0., square = 0., stated = 0.;
    for (int i = 0; i < repeats; ++i) {
        const auto m =
            measured(patch, from(30., 70.), {.bins = {4, 4}, .seed = std::uint64_t(i)}, 4096);
        const MeasuredValue v = m.brdf(6, 1);
        sum += v.value / repeats;
        square += v.value * v.value / repeats;
        stated += v.error * v.error / repeats;
    }
    // Chi-square with 39 degrees of freedom, two-sided 1e-4.
    const double ratio = repeats * (square - sum * sum) / stated;
    EXPECT_GT(ratio, 12.);
    EXPECT_LT(ratio, 87.);
}

TEST(Measurement, GoesOnAsIfItHadNotStopped) {
    const Patch patch = patch_of("cylinders", "lambert reflectance=0.5");
    MeasureOptions options{.bins = {4, 4}, .least_rays = 4096, .most_rays = 8192};
    IncidenceMeasurement once(from(30.), options.bins), twice = once;
    options.noise = 0.;
    measure(patch, options, once);
    options.most_rays = 4096;
    measure(patch, options, twice);
    options.most_rays = 8192;
    measure(patch, options, twice);
    EXPECT_EQ(once.rays, 8192u);
    EXPECT_EQ(twice.rays, 8192u);
    for (std::size_t i = 0; i < once.of_bin.size(); ++i)
        EXPECT_EQ(once.of_bin[i].sum, twice.of_bin[i].sum);
}

TEST(Measurement, StopsWhenItIsExactEnough) {
    const Patch patch = patch_of("flat", "lambert reflectance=0.5");
    const MeasureOptions options{.bins = {4, 4}, .noise = 0.02, .least_rays = 4096};
    IncidenceMeasurement m(from(30.), options.bins);
    measure(patch, options, m);
    EXPECT_LE(m.noise(options.wavelengths), 0.02);
    EXPECT_GT(m.noise(options.wavelengths), 0.005);
    EXPECT_LT(m.rays, 200'000u);
}

TEST(Measurement, RefusesWhatMeansNothing) {
    const Patch patch = patch_of("flat", "mirror");
    const auto message = [&](const DirectionCell& c, const MeasureOptions& o) -> std::string {
        try {
            IncidenceMeasurement m(c, {1, 1});
            measure(patch, o, m);
        } catch (const InputError& e) {
            return e.what();
        }
        return "";
    };
    EXPECT_EQ(message(from(90.), {}), "light from 90 degrees does not meet the surface from above");
    EXPECT_EQ(message(from(0.), {.bins = {0, 4}}),
              "0 by 4 bins: from 1 to a million of them are possible");
    EXPECT_EQ(message(from(0.), {.bins = {}, .noise = -1.}), "noise must not be negative");
    EXPECT_EQ(message(from(0.), {.bins = {}, .orders = -1}), "orders must not be negative");
}

}  // namespace nacre
