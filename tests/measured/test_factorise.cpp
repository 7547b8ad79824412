// BRDFs as sums of products: when few terms are enough, and that more never harm.
#include <gtest/gtest.h>

#include <filesystem>

#include "nacre/measured/factor/factorise.h"
#include "tests/measured/factor_targets.h"
#include "tests/support/error_of.h"

namespace nacre {
namespace {

using test::error_of;
using test::MadeTarget;

std::vector<int> up_to(int terms) {
    std::vector<int> r(terms);
    for (int j = 0; j < terms; ++j) r[j] = j + 1;
    return r;
}

FactorOptions options_of(FactorParameters parameters, int side, std::vector<int> terms) {
    FactorOptions o;
    o.grid = {parameters, side};
    o.terms = std::move(terms);
    return o;
}

constexpr FactorParameters io = FactorParameters::in_out, half = FactorParameters::half_difference;

}  // namespace

TEST(Factorise, AProductNeedsOneTerm) {
    const struct {
        const char* name;
        FactorParameters parameters;
        std::unique_ptr<Target> target;
    } cases[] = {
        {"lambert", io, make_target("lambert reflectance=0.7,0.31,0.05")},
        {"lambert", half, make_target("lambert reflectance=0.7,0.31,0.05")},
        {"product", io, std::make_unique<MadeTarget>(test::product_in_out)},
        {"product", half, std::make_unique<MadeTarget>(test::product_half_difference)},
    };
    for (const auto& c : cases)
        for (const bool weighted : {false, true})
            for (const FactorMethod method : {FactorMethod::svd, FactorMethod::nonnegative}) {
                FactorOptions o = options_of(c.parameters, 8, {1});
                o.weighted = weighted;
                o.method = method;
                const Factorisation f = factorise(*c.target, o);
                EXPECT_LT(f.errors[0].matrix, 1e-6) << c.name << name_of(c.parameters);
                EXPECT_LT(f.errors[0].largest, 1e-6) << c.name << name_of(c.parameters);
                EXPECT_LT(f.errors[0].weighted, 1e-6) << c.name << name_of(c.parameters);
            }
    // In the other coordinates neither product is one.
    for (const auto& [target, parameters] :
         {std::pair{&cases[2].target, half}, {&cases[3].target, io}})
        EXPECT_GT(factorise(**target, options_of(parameters, 8, {1})).errors[0].matrix, 0.05);
}

TEST(Factorise, TheErrorNeverRises) {
    for (const char* model : {"lambert", "phong n=12", "ward alpha_u=0.2 alpha_v=0.5 kd=0.1 ks=0.4",
                              "ggx alpha=0.3 kd=0.2,0.1,0.05 ks=0.5", "he_torrance"}) {
        const auto target = make_target(model);
        for (const FactorParameters parameters : {io, half})
            for (const int kind : {0, 1, 2, 3}) {
                // The others by the plain decomposition alone: they take longer.
                if (kind > 0 && target->name()[0] != 'w') continue;
                FactorOptions o = options_of(parameters, 6, up_to(16));
                o.logarithmic = kind == 1;
                if (kind == 2) o.method = FactorMethod::nonnegative;
                o.weighted = kind == 3;
                const Factorisation f = factorise(*target, o);
                ASSERT_EQ(f.errors.size(), 16u);
                for (std::size_t i = 1; i < f.errors.size(); ++i)
                    EXPECT_LE(f.errors[i].matrix, f.errors[i - 1].matrix * (1. + 1e-9) + 1e-9)
                        << model << " " << name_of(parameters) << " " << kind << " J " << i + 1;
                EXPECT_EQ(f.below > 0, parameters == half);
                EXPECT_EQ(f.missing, 0u);
            }
    }
}

// What the singular values say is what the textures leave.
TEST(Factorise, ErrorsAreTheSingularValuesLeftOut) {
    const auto target = make_target("phong kd=0.2 ks=0.3 n=6");
    const Factorisation all = factorise(*target, options_of(io, 5, up_to(25)));
    double sum = 0.;
    for (double s : all.sigma[0]) sum += s * s;
    ASSERT_EQ(all.channels, 1);
    double left = sum;
    for (std::size_t j = 0; j < 24; ++j) {
        left -= all.sigma[0][j] * all.sigma[0][j];
        EXPECT_NEAR(all.errors[j].matrix, std::sqrt(std::max(left, 0.) / sum), 1e-7) << j;
    }
}

// With as many terms as there are directions, the BRDF itself stands at the middles of texels.
TEST(Factorise, AllTermsAreTheBrdf) {
    const auto target = make_target("ward alpha_u=0.3 alpha_v=0.6 kd=0.3,0.2,0.1 ks=0.4");
    for (const FactorParameters parameters : {io, half}) {
        FactorOptions o = options_of(parameters, 4, {16});
        const Factorisation f = factorise(*target, o);
        EXPECT_LT(f.errors[0].largest, parameters == io ? 1e-6 : 1e-3);
        for (int k = 0; k < 16; ++k)
            for (int l = 0; l < 16; ++l) {
                const DirectionPair w = o.grid.pair(o.grid.row(k), o.grid.column(l));
                const auto want = target->value(w.wi, w.wo), got = f.brdfs[0].value(w.wi, w.wo);
                ASSERT_EQ(want.has_value(), got.has_value());
                if (!want || parameters == half) continue;
                for (int c = 0; c < 3; ++c) EXPECT_NEAR((*got)[c], (*want)[c], 1e-4 * (*want)[c]);
            }
    }
}

// Between the middles of texels values are interpolated, around in phi, held at the ends of theta,
// never negative.
TEST(Factorise, Lookups) {
    const FactorGrid grid{io, 2};
    const auto texture = [](float a, float b, float c, float d) {
        return FactorTexture{{a, a, a}, {b, b, b}, {c, c, c}, {d, d, d}};
    };
    // theta at 22.5 and 67.5 degrees, phi at 90 and 270.
    const FactoredBrdf brdf(grid, {{texture(1, 3, 5, -7), texture(1, 1, 1, 1)}}, false, "made",
                            true);
    const auto at = [&](double theta, double phi) {
        const double t = theta * std::acos(-1.) / 180., p = phi * std::acos(-1.) / 180.;
        const Vec3d wi{std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t)};
        return brdf.value(wi, {0., 0., 1.})->x;
    };
    EXPECT_NEAR(at(22.5, 90.), 1., 1e-6);
    EXPECT_NEAR(at(67.5, 90.), 3., 1e-6);
    EXPECT_NEAR(at(45., 90.), 2., 1e-6);
    EXPECT_NEAR(at(10., 90.), 1., 1e-6);
    EXPECT_NEAR(at(85., 90.), 3., 1e-6);
    EXPECT_NEAR(at(22.5, 180.), 3., 1e-6);
    EXPECT_NEAR(at(22.5, 0.), 3., 1e-6);
    EXPECT_NEAR(at(22.5, 315.), 4., 1e-6);
    EXPECT_NEAR(at(67.5, 270.), 0., 1e-6);
    EXPECT_FALSE(brdf.value({0.6, 0., -0.8}, {0., 0., 1.}));
    const FactoredBrdf exponential(grid, {{texture(1, 1, 1, 1), texture(2, 2, 2, 2)}}, true, "made",
                                   true);
    EXPECT_NEAR(exponential.value({0., 0., 1.}, {0., 0., 1.})->x, std::exp(2.), 1e-5);
}

// The logarithm of a product is a sum of one function each: two terms.
TEST(Factorise, LogarithmsOfProducts) {
    FactorOptions o = options_of(io, 8, {1, 2});
    o.logarithmic = true;
    const Factorisation f = factorise(MadeTarget(test::product_in_out), o);
    EXPECT_GT(f.errors[0].weighted, 0.01);
    EXPECT_LT(f.errors[1].weighted, 2e-3);  // what a thousandth of the mean adds to f
}

// Rows' and columns' means of a product are its factors; of what is none, one term of the singular
// value decomposition is nearer.
TEST(Factorise, NormalisedDecomposition) {
    FactorOptions o = options_of(io, 8, {1});
    o.method = FactorMethod::normalised;
    EXPECT_LT(factorise(MadeTarget(test::product_in_out), o).errors[0].largest, 1e-6);
    const auto phong = make_target("phong n=8");
    const double normalised = factorise(*phong, o).errors[0].matrix;
    const double best = factorise(*phong, options_of(io, 8, {1})).errors[0].matrix;
    EXPECT_GT(normalised, best);
    EXPECT_LT(normalised, 2. * best);
}

// The weighted decomposition is the best by the weighted error, the other by the other.
TEST(Factorise, EachIsBestByItself) {
    const auto target = make_target("ggx alpha=0.4 kd=0.3 ks=0.6");
    FactorOptions o = options_of(io, 8, {1, 4});
    const Factorisation plain = factorise(*target, o);
    o.weighted = true;
    const Factorisation weighted = factorise(*target, o);
    for (int i : {0, 1}) {
        EXPECT_LT(weighted.errors[i].weighted, plain.errors[i].weighted);
        EXPECT_LT(plain.errors[i].matrix, 1.);
        // Sums below 0 become 0, which only betters them.
        EXPECT_LE(weighted.errors[i].weighted, weighted.errors[i].matrix);
        EXPECT_GE(weighted.errors[i].weighted, 0.8 * weighted.errors[i].matrix);
    }
}

// A sphere's J = 1 of measured felt is far, J = 8 near.
TEST(Factorise, Felt) {
    const std::filesystem::path file =
        std::filesystem::path(NACRE_SHARED_DIR) / "data/brdf/merl/pink-felt.nbrdf.binary";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "no reference data at " << file;
    const auto felt = make_target(file.string());
    for (const FactorParameters parameters : {io, half}) {
        const Factorisation f = factorise(*felt, options_of(parameters, 12, up_to(16)));
        EXPECT_EQ(f.channels, 3);
        for (std::size_t i = 1; i < f.errors.size(); ++i)
            EXPECT_LE(f.errors[i].matrix, f.errors[i - 1].matrix * (1. + 1e-9));
        EXPECT_LT(f.errors[15].matrix, 0.3 * f.errors[0].matrix) << name_of(parameters);
    }
}

TEST(Factorise, WrongOptionsAndTargets) {
    const auto message = [](FactorOptions o, const Target& target) {
        return error_of([&] { factorise(target, o); });
    };
    const MadeTarget product(test::product_in_out);
    FactorOptions o = options_of(io, 4, {1});
    const auto with = [&](auto&& change) {
        FactorOptions r = o;
        change(r);
        return message(r, product);
    };
    EXPECT_EQ(with([](auto& r) { r.terms = {}; }),
              "numbers of terms must be whole, above 0 and ascend");
    EXPECT_EQ(with([](auto& r) {
                  r.terms = {0, 1};
              }),
              "numbers of terms must be whole, above 0 and ascend");
    EXPECT_EQ(with([](auto& r) {
                  r.terms = {2, 2};
              }),
              "numbers of terms must be whole, above 0 and ascend");
    EXPECT_EQ(with([](auto& r) { r.terms = {17}; }),
              "a matrix of 16 x 16 has at most 16 terms, not 17");
    EXPECT_EQ(with([](auto& r) { r.grid.side = 1; }),
              "textures of 1 x 1 texels: the side must lie within 2 to 64");
    EXPECT_EQ(with([](auto& r) { r.grid.side = 65; }),
              "textures of 65 x 65 texels: the side must lie within 2 to 64");
    EXPECT_EQ(with([](auto& r) {
                  r.logarithmic = true;
                  r.method = FactorMethod::nonnegative;
              }),
              "logarithms are negative where f is small: they have no non-negative factors");
    EXPECT_EQ(with([](auto& r) {
                  r.logarithmic = true;
                  r.method = FactorMethod::normalised;
              }),
              "the normalised decomposition is one of f, not of its logarithm");
    EXPECT_EQ(with([](auto& r) {
                  r.terms = {1, 2};
                  r.method = FactorMethod::normalised;
              }),
              "the normalised decomposition has one term: J = 1");
    using Directions = const Vec3d&;
    EXPECT_EQ(message(o, MadeTarget([](Directions, Directions) { return std::nullopt; })),
              "made: has no value at any of the directions");
    EXPECT_EQ(message(o, MadeTarget([](Directions, Directions) { return 0.; })),
              "made: has no value above 0; there is nothing to factor");
    EXPECT_EQ(message(o, MadeTarget([](Directions, Directions) { return std::nan(""); })),
              "made: has values that are not finite; it cannot be factored");
}

}  // namespace nacre
