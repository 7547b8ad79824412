// The directions of factored BRDFs and where they stand in textures.
#include <gtest/gtest.h>

#include "nacre/math/random.h"
#include "nacre/measured/factor/grid.h"
#include "tests/support/constants.h"

namespace nacre {
namespace {

constexpr FactorParameters both_parameters[] = {FactorParameters::in_out,
                                                FactorParameters::half_difference};

void expect_direction(const Vec3d& a, const Vec3d& b, double tolerance) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance);
}

}  // namespace

// k = R r1 + r2 counted from 0, phi by r1, theta by r2, at the middles of cells.
TEST(FactorGrid, Layout) {
    const FactorGrid grid{FactorParameters::in_out, 4};
    EXPECT_EQ(grid.count(), 16);
    const double phi = 2. * pi * 1.5 / 4., theta = 0.5 * pi * 2.5 / 4.;
    const Vec3d want{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                     std::cos(theta)};
    expect_direction(grid.row(4 * 1 + 2), want, 1e-15);
    expect_direction(grid.column(4 * 1 + 2), want, 1e-15);
    const FactorGrid half{FactorParameters::half_difference, 4};
    expect_direction(half.column(6), want, 1e-15);
    EXPECT_NEAR(half.row(6).z, std::cos(0.5 * pi * 0.625 * 0.625), 1e-15);
}

TEST(FactorGrid, PairsAreLookedUpWhereTheyCameFrom) {
    for (const FactorParameters parameters : both_parameters) {
        const FactorGrid grid{parameters, 6};
        int above = 0;
        for (int k = 0; k < grid.count(); ++k)
            for (int l = 0; l < grid.count(); ++l) {
                const DirectionPair w = grid.pair(grid.row(k), grid.column(l));
                EXPECT_NEAR(length(w.wi), 1., 1e-12);
                EXPECT_NEAR(length(w.wo), 1., 1e-12);
                if (!(w.wi.z > 0. && w.wo.z > 0.)) continue;
                ++above;
                const FactorPlaces p = factor_places(parameters, w.wi, w.wo);
                EXPECT_NEAR(p.row.x * 6, k / 6 + 0.5, 1e-9);
                EXPECT_NEAR(p.row.y * 6, k % 6 + 0.5, 1e-9);
                EXPECT_NEAR(p.column.x * 6, l / 6 + 0.5, 1e-9);
                EXPECT_NEAR(p.column.y * 6, l % 6 + 0.5, 1e-9);
            }
        EXPECT_GT(above, parameters == FactorParameters::in_out ? 1295 : 800);
    }
}

// Light from wo to wi has the same half vector; the difference vector turns by half a circle.
TEST(FactorGrid, TheOtherWayRoundIsHalfACircle) {
    Random random(stream_key(7, 1));
    for (int i = 0; i < 100; ++i) {
        const auto direction = [&] {
            const double z = 0.05 + 0.9 * random.next(), phi = 2. * pi * random.next();
            const double s = std::sqrt(1. - z * z);
            return Vec3d{s * std::cos(phi), s * std::sin(phi), z};
        };
        const Vec3d wi = direction(), wo = direction();
        const FactorPlaces a = factor_places(FactorParameters::half_difference, wi, wo);
        const FactorPlaces b = factor_places(FactorParameters::half_difference, wo, wi);
        EXPECT_NEAR(a.row.x, b.row.x, 1e-12);
        EXPECT_NEAR(a.row.y, b.row.y, 1e-12);
        EXPECT_NEAR(a.column.y, b.column.y, 1e-9);
        EXPECT_NEAR(std::abs(a.column.x - b.column.x), 0.5, 1e-9);
    }
}

// The integral of cos over the hemisphere is pi; over pairs of directions pi^2.
TEST(FactorGrid, WeightsAreSolidAngles) {
    for (const FactorParameters parameters : both_parameters) {
        const FactorGrid fine{parameters, 64};
        double rows = 0., columns = 0.;
        for (int k = 0; k < fine.count(); ++k) {
            rows += fine.row_weight(k);
            columns += fine.column_weight(k);
        }
        EXPECT_NEAR(rows, pi, 1e-3 * pi);
        EXPECT_NEAR(columns, pi, 1e-3 * pi);
        const FactorGrid grid{parameters, 20};
        double all = 0.;
        for (int k = 0; k < grid.count(); ++k)
            for (int l = 0; l < grid.count(); ++l) all += grid.measure(k, l);
        EXPECT_NEAR(all, pi * pi, 0.01 * pi * pi) << name_of(parameters);
    }
}

// Where the half vector lies along the tangent the frame is any.
TEST(FactorGrid, TheFrameHasNoHoles) {
    const FactorPlaces p =
        factor_places(FactorParameters::half_difference, normalize(Vec3d{1., 0.3, 1e-12}),
                      normalize(Vec3d{1., -0.3, 1e-12}));
    for (const double x : {p.row.x, p.row.y, p.column.x, p.column.y}) {
        EXPECT_GE(x, 0.);
        EXPECT_LE(x, 1.);
    }
    EXPECT_NEAR(p.column.y, std::atan(0.3) / (0.5 * pi), 1e-9);
}

}  // namespace nacre
