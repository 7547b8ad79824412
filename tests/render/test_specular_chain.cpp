// Ways of light over several smooth boundaries: a slab's mirror images, and the caustic of a ball.
#include "nacre/optics/fresnel.h"
#include "nacre/render/specular_chain.h"
#include "tests/render/render_fixture.h"

namespace nacre {
namespace {

class SpecularChainTest : public RenderTest {};

// Parallel light enters a slab and comes to y after k reflections inside. Each chain is found with
// its own irradiance; 1 / weight is, on average, the probability of finding it, so the mean of
// weight times irradiance is the sum over all.
TEST_F(SpecularChainTest, MirrorImagesInASlab) {
    const double eta = 1.5, cosine = 0.8, sine = 0.6;
    const Scene s = scene(
        "<emitter type=\"directional\"><vector name=\"direction\" x=\"0.6\" y=\"-0.8\" z=\"0\"/>"
        "<float name=\"irradiance\" value=\"1\"/></emitter>" +
        xml::shape(
            "cube",
            "<transform name=\"to_world\"><scale x=\"50\" y=\"0.5\" z=\"50\"/>"
            "<translate y=\"-0.5\"/></transform>" +
                xml::dielectric(eta) +
                xml::medium("interior", xml::number("sigma_t", 1) + xml::number("albedo", 0.5))));
    const SpecularChains chains(s);
    const double reflected = fresnel_dielectric(cosine, eta);
    const double cos_in = std::sqrt(1 - sine * sine / (eta * eta));
    const double entering = (1 - reflected) * cosine / cos_in;
    Random random(5);
    RayCounts counts;
    double sum = 0, sum2 = 0, expected = 0;
    int found = 0;
    constexpr int n = 3000;
    for (int i = 0; i < n; ++i) {
        const auto chain = chains.draw({0.1f, -0.3f, 0.2f}, true, random, counts);
        if (!chain) continue;
        ++found;
        ASSERT_FALSE(chain->vertex[0].reflects);
        const int k = chain->vertices - 1;
        ASSERT_NEAR(chain->gain, entering * std::pow(reflected, k),
                    1e-4 * entering * std::pow(reflected, k));
        ASSERT_NEAR(chain->vertex[0].chart.p.x,
                    0.1 - sine / eta / cos_in * (k % 2 ? k + 1 - 0.3 : k + 0.3), 1e-3);
        const double x = chain->gain * chain->weight;
        sum += x / n;
        sum2 += x * x / n;
    }
    for (int k = 1; k < SpecularChains::most_vertices; ++k)
        expected += entering * std::pow(reflected, k);
    EXPECT_GT(found, n / 50);
    EXPECT_NEAR(sum, expected, 4 * std::sqrt((sum2 - sum * sum) / n)) << found;
}

/// What a glass ball of radius 1 about the origin makes of light of intensity 1 at (0, 0, s): where
/// the ray that leaves the light under an angle meets the plane z = -d.
struct BallLens {
    double eta, s, d;
    struct At {
        double x, per_area, cosine, first;  // first: distance to the ball
    };
    double meets(double theta) const { return at(theta, 0).x; }
    At at(double theta, double step = 1e-6) const {
        const double i = std::asin(s * std::sin(theta)), r = std::asin(std::sin(i) / eta);
        const double out = theta - 2 * (i - r), exit = i - theta + pi - 2 * r;
        At at{};
        at.x = std::sin(exit) + std::tan(out) * (std::cos(exit) + d);
        if (step == 0) return at;
        const double dx = (meets(theta + step) - meets(theta - step)) / (2 * step);
        at.per_area = std::pow(1 - fresnel_dielectric(std::cos(i), eta), 2) * std::sin(theta) /
                      std::abs(at.x * dx);
        at.cosine = std::cos(out);
        at.first = std::sin(i - theta) / std::sin(theta);
        return at;
    }
};

TEST_F(SpecularChainTest, CausticOfABall) {
    const BallLens lens{1.5, 4, 2};
    const Scene s = scene(
        "<emitter type=\"point\"><point name=\"position\" x=\"0\" y=\"0\" z=\"4\"/></emitter>" +
        xml::sphere({}, 1, xml::dielectric(lens.eta)));
    const SpecularChains chains(s);
    for (const double x : {0.02, 0.1, 0.2}) {
        // All rays that come to x, on either side of the axis.
        std::vector<BallLens::At> rays;
        const double last = std::asin(1 / lens.s);
        constexpr int n = 2000;
        for (int k = 1; k + 1 < n; ++k)
            for (const double side : {1., -1.}) {
                double low = last * k / n, high = last * (k + 1) / n;
                const auto above = [&](double theta) { return lens.meets(theta) > side * x; };
                if (above(low) == above(high)) continue;
                for (int i = 0; i < 60; ++i) {
                    const double middle = 0.5 * (low + high);
                    (above(middle) == above(low) ? low : high) = middle;
                }
                rays.push_back(lens.at(low));
            }
        ASSERT_FALSE(rays.empty()) << x;
        double expected = 0;
        for (const BallLens::At& ray : rays) expected += ray.per_area;
        Random random(stream_key(9, std::uint64_t(x * 1000)));
        RayCounts counts;
        double sum = 0, sum2 = 0;
        constexpr int draws = 3000;
        for (int i = 0; i < draws; ++i) {
            const auto chain =
                chains.draw(Point3f(Vec3d{0.6 * x, 0.8 * x, -lens.d}), false, random, counts);
            if (!chain || chain->vertices != 2 || chain->vertex[0].reflects ||
                chain->vertex[1].reflects)
                continue;
            const double first = length(chain->vertex[0].chart.p - Vec3d{0, 0, lens.s});
            const Vec3d to = normalize(chain->vertex[1].chart.p - Vec3d{0.6 * x, 0.8 * x, -lens.d});
            const double irradiance = chain->gain * to.z / (first * first);
            const bool known = std::ranges::any_of(rays, [&](const BallLens::At& ray) {
                return std::abs(irradiance - ray.per_area) < 1e-3 * ray.per_area;
            });
            ASSERT_TRUE(known) << x << ": " << irradiance;
            sum += irradiance * chain->weight / draws;
            sum2 += std::pow(irradiance * chain->weight, 2) / draws;
        }
        const double error = std::sqrt((sum2 - sum * sum) / draws);
        EXPECT_NEAR(sum, expected, 3.5 * error) << x << ", " << rays.size() << " rays";
        EXPECT_LT(error, 0.1 * expected) << x;
    }
}

}  // namespace
}  // namespace nacre
