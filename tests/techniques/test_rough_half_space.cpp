// What half spaces behind rough boundaries return, beside quadrature and complete simulation.
#include "nacre/technique/rough_half_space.h"

#include "nacre/math/quadrature.h"
#include "nacre/math/sampling.h"
#include "nacre/optics/fresnel_moments.h"
#include "nacre/reflectance/ggx.h"
#include "nacre/subsurface/random_walk.h"
#include "tests/techniques/technique_fixture.h"

namespace nacre {
namespace {

std::string boundary(double alpha, double index = 1.5, const std::string& distribution = "ggx") {
    return alpha == 0.
               ? xml::bsdf("dielectric", xml::number("int_ior", index) + xml::number("ext_ior", 1))
               : xml::bsdf("roughdielectric",
                           word("distribution", distribution) + xml::number("alpha", alpha) +
                               xml::number("int_ior", index) + xml::number("ext_ior", 1));
}
std::string scattering_matter(double albedo, double g = 0.) {
    return xml::medium("interior", xml::number("sigma_t", 2. / (1. - g)) +
                                       xml::number("albedo", albedo) + "<phase type=\"hg\">" +
                                       xml::number("g", g) + "</phase>");
}

class RoughHalfSpaces : public Techniques {
  protected:
    /// A ball's boundary.
    std::shared_ptr<const Material> material(double alpha, double index = 1.5,
                                             const std::string& distribution = "ggx") {
        return scene(
                   xml::integrator("path") + xml::constant_light() +
                   xml::sphere({}, 1, boundary(alpha, index, distribution) + scattering_matter(1)))
            .shapes[0]
            .material;
    }
    /// What a slab returns of the even light that has entered it, and the standard error: all that
    /// comes back but for what the boundary reflects.
    std::pair<double, double> returned(const std::string& technique, double alpha,
                                       const std::string& inside, const EstimateOptions& options) {
        const RayMaker from_everywhere = [](Vec2f u) {
            const Vec3f d = square_to_cosine_hemisphere(u);
            return Ray{Point3f{} + d * 40.f, -d};
        };
        const Scene s = scene(xml::integrator("path") + xml::constant_light() +
                              slab(12, boundary(alpha) + inside));
        const RadianceEstimate e = look(s, {technique}, from_everywhere, options);
        const ObjectBoundary b = ObjectBoundary::of(s.shapes[0]);
        const double enters = b.mean_transmittance();
        return {(e.mean[1] - b.mean_reflectance()) / enters, e.error[1] / enters};
    }
};

/// Light between a half space that scatters isotropically, by Chandrasekhar's H, and facets, by
/// midpoints over those that are seen: the share that leaves of what has entered.
class Quadrature {
  public:
    Quadrature(double alpha, double index) : facets_{alpha, alpha}, index_(index), r_(n * n) {
        const GaussLegendre rule(n);
        double end = 0.;
        for (std::size_t i = 0; i < n; ++i) {
            mu_.push_back(0.5 + 0.5 * rule.node[i]);
            w_.push_back(0.5 * rule.weight[i]);
            ends_.push_back(end += w_[i]);
        }
        for (std::size_t i = 0; i < n; ++i) {
            meet(mu_[i], 1. / index_, [&](double mu, double share, bool back) {
                (back ? r_[at(mu) * n + i] : t_[i]) += share;
            });
            meet(mu_[i], index_, [&](double mu, double share, bool back) {
                if (!back) e_[at(mu)] += 2. * mu_[i] * w_[i] * share;
            });
        }
    }
    double albedo(double single) const {
        // 1 / H(mu) = sqrt(1 - a) + a / 2 int m H(m) / (mu + m) dm
        std::vector<double> h(n, 1.);
        for (int k = 0; k < 2000; ++k)
            for (std::size_t i = 0; i < n; ++i) {
                double sum = std::sqrt(1. - single);
                for (std::size_t j = 0; j < n; ++j)
                    sum += 0.5 * single * mu_[j] * h[j] / (mu_[i] + mu_[j]) * w_[j];
                h[i] = 0.5 * (h[i] + 1. / sum);
            }
        double left = 0.;
        std::array<double, n> down = e_;
        for (int k = 0; k < 400; ++k) {
            std::array<double, n> up{}, next{};
            for (std::size_t i = 0; i < n; ++i)
                for (std::size_t j = 0; j < n; ++j)
                    up[j] +=
                        0.5 * single * h[i] * h[j] / (mu_[i] + mu_[j]) * mu_[j] * w_[j] * down[i];
            for (std::size_t i = 0; i < n; ++i) {
                left += t_[i] * up[i];
                for (std::size_t j = 0; j < n; ++j) next[j] += r_[j * n + i] * up[i];
            }
            down = next;
        }
        double entered = 0.;
        for (const double e : e_) entered += e;
        return left / entered;
    }

  private:
    static constexpr std::size_t n = 32;

    std::size_t at(double mu) const {
        return std::min(std::size_t(std::ranges::lower_bound(ends_, mu) - ends_.begin()), n - 1);
    }
    /// Light at a cosine on one side of the facets, `eta` the index of the other side over its own.
    template <class F>
    void meet(double mu, double eta, F&& f) const {
        constexpr int m = 64;
        const Vec3d w{std::sqrt(1. - mu * mu), 0., mu};
        for (int i = 0; i < m * m; ++i) {
            const Vec3d h = facets_.sample_visible(w, {(i / m + 0.5) / m, (i % m + 0.5) / m});
            const double c = dot(w, h), fresnel = fresnel_dielectric(c, eta);
            const auto seen = [&](const Vec3d& o) {
                return 1. / (1. + facets_.lambda(o)) / (m * m);
            };
            const Vec3d mirrored = reflect(w, h);
            if (mirrored.z > 0.) f(mirrored.z, fresnel * seen(mirrored), true);
            if (fresnel == 1.) continue;
            const Vec3d bent = refract(w, h, eta);
            if (bent.z < 0.) f(-bent.z, (1. - fresnel) * seen(bent), false);
        }
    }

    Ggx<double> facets_;
    double index_;
    std::vector<double> mu_, w_, ends_, r_;
    std::array<double, n> t_{}, e_{};
};

TEST_F(RoughHalfSpaces, ReturnWhatQuadratureSays) {
    for (const double index : {1.33, 1.5})
        for (const double alpha : {0.2, 0.4}) {
            const auto facets = material(alpha, index);
            const RoughHalfSpace rough(*facets);
            const Quadrature quadrature(alpha, index);
            for (const double a : {1., 0.98, 0.9, 0.6}) {
                const double expected = quadrature.albedo(a);
                EXPECT_NEAR(rough.albedo({a, 1. - a, 0., index}), expected, 0.004 * expected)
                    << "index " << index << " alpha " << alpha << " albedo " << a;
            }
        }
}

TEST_F(RoughHalfSpaces, AreLikeSmoothOnesWhereFacetsAreNearlyFlat) {
    for (const double index : {1.3, 1.8, 0.75}) {
        const auto facets = material(1e-3, index);
        const RoughHalfSpace rough(*facets);
        for (const ProfileMedium& m : {ProfileMedium{1., 0., 0., index},
                                       {1., 0.01, 0., index},
                                       {1., 0.5, 0., index},
                                       {5., 0.1, 0.8, index}}) {
            const double expected = half_space_albedo(m);
            EXPECT_NEAR(rough.albedo(m), expected, 0.01 * expected)
                << "index " << index << " sigma_a " << m.sigma_a << " g " << m.g;
        }
    }
}

TEST_F(RoughHalfSpaces, OfNarrowPhaseFunctionsAreQuickAndTheirNodesCancel) {
    const Scene s = scene(xml::integrator("path") + xml::constant_light() +
                          xml::sphere({}, 1, boundary(1e-3) + scattering_matter(1)));
    const ProfileMedium media[] = {{10., 0.01, 0.99, 1.5}, {10., 1., 0.99, 1.5}};
    for (const double factor : rough_return(ObjectBoundary::of(s.shapes[0]), media))
        EXPECT_NEAR(factor, 1., 0.01);
}

TEST_F(RoughHalfSpaces, StopWhenAsked) {
    const Scene s = scene(xml::integrator("path") + xml::constant_light() +
                          xml::sphere({}, 1, boundary(0.2) + scattering_matter(1)));
    const std::atomic<bool> stop = true;
    const ProfileMedium media[] = {{1., 0.01, 0., 1.5}};
    EXPECT_THROW(rough_return(ObjectBoundary::of(s.shapes[0]), media,
                              Work(&stop, Work::Clock::time_point::max(), {})),
                 Stopped);
}

TEST_F(RoughHalfSpaces, LoseMoreTheRougherTheyAreIfTheyAreWhite) {
    for (const char* distribution : {"ggx", "beckmann"}) {
        double before = 1.;
        for (const double alpha : {0.05, 0.3, 0.6}) {
            const auto facets = material(alpha, 1.5, distribution);
            const double a = RoughHalfSpace(*facets).albedo({1., 0., 0., 1.5});
            EXPECT_LT(a, before) << distribution << alpha;
            EXPECT_GT(a, 0.4) << distribution << alpha;
            before = a;
        }
    }
}

TEST_F(RoughHalfSpaces, OfNoMatterReturnNothing) {
    const auto facets = material(0.3);
    const RoughHalfSpace rough(*facets);
    EXPECT_EQ(rough.albedo({0., 1., 0., 1.5}), 0.);
    const ProfileMedium black[] = {{0., 1., 0., 1.5}};
    const Scene s = scene(xml::integrator("path") + xml::constant_light() +
                          xml::sphere({}, 1, boundary(0.3) + scattering_matter(1)));
    EXPECT_EQ(rough_return(ObjectBoundary::of(s.shapes[0]), black), std::vector{1.});
    EXPECT_TRUE(rough_return(ObjectBoundary(1.5f), black).empty());
}

TEST_F(RoughHalfSpaces, AreSimulatedAlike) {
    struct Case {
        double alpha, albedo, g;
    };
    for (const Case& c : {Case{0.2, 0.97, 0.}, {0.4, 0.97, 0.}, {0.4, 0.7, 0.}, {0.4, 0.97, 0.9}}) {
        const auto facets = material(c.alpha);
        const double a = c.albedo, expected = RoughHalfSpace(*facets).albedo({a, 1. - a, c.g, 1.5});
        const auto [simulated, error] =
            returned("volpath", c.alpha, scattering_matter(a, c.g), {.pixels = 400, .samples = 64});
        EXPECT_NEAR(simulated, expected, 4.5 * error + 0.002)
            << "alpha " << c.alpha << " albedo " << a << " g " << c.g;
        EXPECT_LT(error, 0.025 * expected);
    }
}

TEST_F(RoughHalfSpaces, AreOffByAsMuchAsSmoothOnesUnderTechniques) {
    for (const double a : {0.97, 0.7}) {
        const auto facets = material(0.4);
        const ProfileMedium m{a, 1. - a, 0., 1.5};
        const double expected = RoughHalfSpace(*facets).albedo(m) / half_space_albedo(m);
        for (const char* technique : {"brdf", "hanrahan_krueger", "random_walk"}) {
            const EstimateOptions options{.pixels = 400, .samples = 32};
            const auto [smooth, e0] = returned(technique, 0., scattering_matter(a), options);
            const auto [rough, e1] = returned(technique, 0.4, scattering_matter(a), options);
            EXPECT_NEAR(rough / smooth, expected, 4.5 * std::hypot(e0 / smooth, e1 / smooth) + 0.01)
                << technique << " albedo " << a;
        }
    }
}

}  // namespace
}  // namespace nacre
