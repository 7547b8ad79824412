// The hierarchy against the sum over all points.
#include "nacre/subsurface/irradiance_tree.h"

#include <gtest/gtest.h>

#include "nacre/bssrdf/better_dipole.h"
#include "nacre/bssrdf/dipole.h"
#include "nacre/math/random.h"
#include "nacre/math/sampling.h"
#include "nacre/subsurface/two_pass.h"

namespace nacre {
namespace {

struct Cloud {
    std::vector<Point3f> p;
    std::vector<float> area, power;

    /// Points on a sphere of radius 10 about `centre`, bright on one side.
    explicit Cloud(int n, const Vec3f& centre = {}) {
        Random random(stream_key(7, std::uint64_t(n)));
        for (int i = 0; i < n; ++i) {
            const Vec3f d = square_to_sphere(random.next2());
            p.push_back(centre + d * 10.f);
            area.push_back(400.f * std::numbers::pi_v<float> / float(n));
            for (int b = 0; b < 3; ++b) power.push_back(area.back() * (b + 1.f) * (1.1f + d.x));
        }
    }
    IrradianceTree tree(float epsilon) const { return {p, area, power, 3, epsilon}; }
};

const ProfileMedium media[] = {ProfileMedium::reduced(1., 0.01, 1.3),
                               ProfileMedium::reduced(2., 0.2, 1.3),
                               ProfileMedium::reduced(0.5, 0., 1.3)};

std::vector<DipoleKernel> kernels(const char* profile = "dipole") {
    std::vector<DipoleKernel> k;
    for (const ProfileMedium& m : media) k.push_back(make_kernel(profile, m));
    return k;
}

double brute_force(const Cloud& cloud, const Point3f& at, int band) {
    const Dipole<double> dipole(media[band].sigma_s, media[band].sigma_a, 1.3);
    double sum = 0.;
    for (std::size_t i = 0; i < cloud.p.size(); ++i)
        sum += dipole.eval(length_squared(Vec3d(cloud.p[i]) - Vec3d(at))) *
               double(cloud.power[3 * i + std::size_t(band)]);
    return sum;
}

}  // namespace

TEST(IrradianceTree, WithoutGroupsItIsTheSumOverAllPoints) {
    // Numbers of points around full and nearly empty nodes of 8 and 16 lanes.
    for (int n : {1, 2, 7, 8, 9, 15, 16, 17, 64, 65, 255, 256, 257, 1000, 5000}) {
        const Cloud cloud(n);
        const IrradianceTree tree = cloud.tree(0.f);
        for (const Point3f& at : {Point3f{10, 0, 0}, {0, -9, 2}, {3, 4, 30}}) {
            float m[3];
            tree.gather(at, kernels(), m);
            for (int b = 0; b < 3; ++b) {
                const double expected = brute_force(cloud, at, b);
                // fast_rsqrt is off by 4e-4 at most; each term depends on it about thrice.
                EXPECT_NEAR(m[b], expected, 1.5e-3 * expected) << n << " " << b;
            }
        }
    }
}

TEST(IrradianceTree, TheErrorFallsWithTheSolidAngle) {
    const Cloud cloud(30000);
    double before = 1.;
    for (const float epsilon : {0.8f, 0.2f, 0.05f, 0.0125f}) {
        const IrradianceTree tree = cloud.tree(epsilon);
        Random random(stream_key(3, 3));
        double error = 0.;
        for (int i = 0; i < 50; ++i) {
            const Vec3f d = square_to_sphere(random.next2());
            float m[3];
            tree.gather(d * 10.f, kernels(), m);
            for (int b = 0; b < 3; ++b)
                error += std::abs(m[b] / brute_force(cloud, d * 10.f, b) - 1.) / 150.;
        }
        EXPECT_LT(error, 0.7 * before) << epsilon;
        EXPECT_LT(error, 0.1 * epsilon + 3e-4);
        before = error;
    }
}

TEST(IrradianceTree, EverythingIsKeptInTheGroups) {
    // From far away all points are one group: its power, at its centre.
    const Cloud cloud(12345);
    const IrradianceTree tree = cloud.tree(4.f);
    double power = 0.;
    for (std::size_t i = 0; i < cloud.p.size(); ++i) power += cloud.power[3 * i + 2];
    const DipoleKernel flat{0.f, {1e12f, 0.f, 1e18f}, {1e12f, 0.f, 0.f}};
    const DipoleKernel kernel[] = {flat, flat, flat};
    float m[3];
    tree.gather({0, 0, 50}, kernel, m);
    EXPECT_NEAR(m[2], power, 1e-3 * power);
}

TEST(IrradianceTree, PointsWithoutAreaOrPowerChangeNothing) {
    // Points that coincide with others get no share of the surface: whole groups of them, too.
    Cloud cloud(500);
    for (int i = 0; i < 300; ++i) {
        cloud.p.push_back({0.f, 10.f, 0.f});
        cloud.area.push_back(0.f);
        cloud.power.insert(cloud.power.end(), {0.f, 0.f, 0.f});
    }
    for (const float epsilon : {0.f, 0.2f, 4.f})
        for (const Point3f& at : {Point3f(0, 10, 0), Point3f(0, -10, 0), Point3f(10, 0, 0)}) {
            float m[3];
            cloud.tree(epsilon).gather(at, kernels(), m);
            for (int b = 0; b < 3; ++b) {
                const double expected = brute_force(cloud, at, b);
                EXPECT_NEAR(m[b], expected, (0.1 * epsilon + 3e-4) * expected) << epsilon;
            }
        }
}

TEST(IrradianceTree, DoesNotDependOnWhereItIs) {
    const Cloud here(4000), there(4000, {512, -256, 1024});
    float a[3], b[3];
    here.tree(0.05f).gather({0, 10, 0}, kernels(), a);
    there.tree(0.05f).gather({512, -246, 1024}, kernels(), b);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], 2e-3 * a[k]);
}

TEST(IrradianceTree, KernelsAreTheProfiles) {
    // One point of power 1 at distance r.
    const std::vector<Point3f> p{{0, 0, 0}};
    const std::vector<float> area{1.f}, power{1.f, 1.f, 1.f};
    const IrradianceTree tree(p, area, power, 3, 0.f);
    for (float r : {0.f, 0.3f, 1.f, 5.f, 12.f})
        for (int b = 0; b < 3; ++b) {
            const ProfileMedium& medium = media[b];
            float m[3];
            tree.gather({r, 0, 0}, kernels("better_dipole"), m);
            const double better =
                BetterDipole<double>(medium.sigma_s, medium.sigma_a, 1.3).eval(double(r) * r);
            EXPECT_NEAR(m[b], better, 2e-3 * better) << r;
            tree.gather({r, 0, 0}, kernels(), m);
            const double classical =
                Dipole<double>(medium.sigma_s, medium.sigma_a, 1.3).eval(double(r) * r);
            EXPECT_NEAR(m[b], classical, 1.5e-3 * classical) << r;
        }
}

TEST(IrradianceTree, AnEmptyOrDarkSurfaceIsDark) {
    float m[3] = {1, 1, 1};
    IrradianceTree({}, {}, {}, 3, 0.1f).gather({}, kernels(), m);
    EXPECT_EQ(m[1], 0.f);
    Cloud dark(100);
    std::fill(dark.power.begin(), dark.power.end(), 0.f);
    dark.tree(0.1f).gather({}, kernels(), m);
    EXPECT_EQ(m[0], 0.f);
}

}  // namespace nacre
