// Random walks in a medium of given surface albedo: half spaces in closed form, a sphere against
// complete simulation.
#include "nacre/subsurface/random_walk.h"

#include "nacre/bssrdf/dipole.h"
#include "nacre/layers/adding_doubling.h"
#include "nacre/math/quadrature.h"
#include "tests/techniques/technique_fixture.h"

namespace nacre {

namespace {

/// What a half space of isotropic albedo W below a boundary of equal indices returns of even light:
/// 1 - 2 sqrt(1 - W) int H(mu) mu dmu, with Chandrasekhar's H (1950, Radiative Transfer) by
///   ln H = -mu/pi int_0^(pi/2) ln(1 - W t cot t) / (cos^2 t + mu^2 sin^2 t) dt.
double closed_form(double albedo) {
    static const GaussLegendre rule(96);
    const auto h = [&](double mu) {
        // Towards t = 0 the logarithm of a nearly white medium falls steeply: t = x^4.
        return std::exp(-mu / pi * rule.integrate(0., std::pow(0.5 * pi, 0.25), [&](double x) {
            const double t = x * x * x * x, s = std::sin(t), c = std::cos(t);
            return 4. * x * x * x * std::log(1. - albedo * t * c / s) / (c * c + mu * mu * s * s);
        }));
    };
    return 1. - 2. * std::sqrt(1. - albedo) *
                    rule.integrate(0., 1., [&](double mu) { return mu * h(mu); });
}
/// The single-scattering albedo whose half space returns `a`.
double albedo_for(double a) {
    double low = 0., high = 1.;
    for (int i = 0; i < 50; ++i) {
        const double middle = 0.5 * (low + high);
        (closed_form(middle) < a ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

std::string matter(const Vec3d& sigma_s, const Vec3d& sigma_a, double index,
                   const std::string& more = "") {
    return "<subsurface type=\"dipole\">" + xml::rgb("sigma_s", sigma_s) +
           xml::rgb("sigma_a", sigma_a) + xml::number("int_ior", index) +
           xml::number("ext_ior", 1) + word("method", "random_walk") + more + "</subsurface>";
}

const Vec3d targets{0.2, 0.5, 0.8};
const Vec3d extinction{4., 9., 6.};

}  // namespace

TEST(RandomWalkMedium, HasTheSurfaceAlbedoOfTheObjectsHalfSpace) {
    for (const double a : {0.05, 0.2, 0.5, 0.8, 0.95}) {
        const double w = albedo_for(a);
        EXPECT_NEAR(half_space_albedo({w, 1. - w, 0., 1.}), a, 2e-4) << a;
        // Without a boundary the fit gives back the medium that one had: its accuracy.
        const RandomWalkMedium<double> walk =
            random_walk_medium({3. * w, 3. * (1. - w), 0., 1.}, FreePath::transport);
        EXPECT_NEAR(walk.sigma_t, 3., 1e-12);
        EXPECT_NEAR(closed_form(walk.sigma_s / walk.sigma_t), a,
                    (a < 0.2   ? 0.04
                     : a > 0.9 ? 0.06
                               : 0.01) *
                        a);
    }
    // Behind any boundary a white medium returns all light.
    EXPECT_NEAR(half_space_albedo({1., 0., 0., 1.5}), 1., 1e-6);
    EXPECT_NEAR(half_space_albedo({1., 0., 0.8, 1.3}), 1., 1e-6);
    EXPECT_EQ(half_space_albedo({0., 1., 0., 1.3}), 0.);
    // Its transport mean free path is the object's.
    EXPECT_NEAR(random_walk_medium({10., 1., 0.8, 1.3}, FreePath::transport).sigma_t, 3., 1e-12);
}

TEST(RandomWalkMedium, KeepsTheDiffuseFreePathIfAsked) {
    // Where light fades as e^(-sigma_tr r), sigma_tr^2 = 3 sigma_a sigma_t', and in a white medium
    // as far as two dipoles of the same total say.
    for (const double a : {0.05, 0.3, 0.7}) {
        const ProfileMedium m{20. * (1. - a), 4. * a, 0.8, 1.4};
        const auto walk = random_walk_medium(m, FreePath::diffuse);
        EXPECT_NEAR(std::sqrt(3. * (walk.sigma_t - walk.sigma_s) * walk.sigma_t),
                    std::sqrt(3. * m.sigma_a * m.sigma_t_prime()), 1e-9)
            << a;
    }
    const Dipole<double> behind_a_boundary(1., 1e-10, 1.5), without(1., 1e-10, 1.);
    const double fades = (1. - behind_a_boundary.total()) / (1. - without.total());
    EXPECT_NEAR(random_walk_medium({1., 0., 0., 1.5}, FreePath::diffuse).sigma_t, 1. / fades, 2e-3);
    EXPECT_NEAR(random_walk_medium({1., 0., 0., 1.}, FreePath::diffuse).sigma_t, 1., 1e-9);
}

TEST_F(Techniques, RandomWalksInAHalfSpaceReturnTheSurfaceAlbedo) {
    // Bands of different colour and density at once, so that walks of one are weighted for others.
    for (const double index : {1., 1.3}) {
        Vec3d sigma_s, expected;
        for (int c = 0; c < 3; ++c) sigma_s[c] = extinction[c] * albedo_for(targets[c]);
        const double f = fresnel_dielectric(1., index);
        for (int c = 0; c < 3; ++c) {
            const RandomWalkMedium<double> walk = random_walk_medium(
                {sigma_s[c], extinction[c] - sigma_s[c], 0., index}, FreePath::transport);
            expected[c] = f + (1. - f) * closed_form(walk.sigma_s / walk.sigma_t);
        }
        const Scene s = scene(xml::integrator("path") + xml::constant_light() +
                              slab(30, matter(sigma_s, extinction - sigma_s, index)));
        expect_radiance(look(s, onto_the_middle({0, 0, 1}, 10), {.pixels = 1000, .samples = 64}),
                        expected, 4e-3, fmt::format("index {}", index), 4.5);
    }
}

TEST_F(Techniques, RandomWalksInAWhiteHalfSpaceLoseWhatTheFitDoes) {
    // The fit ends at a single-scattering albedo of 0.99888: 7 % are lost.
    const Scene s = scene(xml::integrator("path") + xml::constant_light() +
                          slab(30, matter({30, 30, 30}, {}, 1.3)));
    const double f = fresnel_dielectric(1., 1.3),
                 expected = f + (1. - f) * closed_form(chiang2016_single_albedo(1.));
    const RadianceEstimate e =
        look(s, onto_the_middle({0, 0, 1}, 5), {.pixels = 1000, .samples = 128});
    expect_radiance(e, {expected, expected, expected}, 1e-3, "white", 4.5);
}

TEST_F(Techniques, RandomWalksInASphereAreACompleteSimulationOfTheirMedium) {
    // Without a boundary, in even light: what is simulated along parallel rays that fill the disk
    // of the sphere is met at all angles in proportion to their cosine, which is how walks start.
    // Where and how light enters makes no difference.
    const Vec3d sigma_s{1., 0.7, 2.}, sigma_a{0.1, 0.2, 0.01};
    Vec3d walk_s, walk_a;
    for (int c = 0; c < 3; ++c) {
        const auto walk = random_walk_medium({sigma_s[c], sigma_a[c], 0., 1.}, FreePath::transport);
        walk_s[c] = walk.sigma_s, walk_a[c] = walk.sigma_t - walk.sigma_s;
    }
    const RayMaker rays = ray_bundle({0, 0, 9}, {0, 0, -1}, 1.5f);
    const EstimateOptions options{.pixels = 1000, .samples = 128};
    const Scene walks = scene(xml::integrator("path") + xml::constant_light() +
                              xml::sphere({}, 1.5, matter(sigma_s, sigma_a, 1.)));
    const Scene whole = scene(
        xml::integrator("volpath") + xml::constant_light() +
        xml::sphere({}, 1.5,
                    xml::bsdf("null") + xml::medium("interior", xml::rgb("sigma_s", walk_s) +
                                                                    xml::rgb("sigma_a", walk_a))));
    const RadianceEstimate a = look(walks, rays, options), b = look(whole, rays, options);
    for (int c = 0; c < 3; ++c) EXPECT_LT(std::hypot(a.error[c], b.error[c]), 3e-3);
    expect_agreement(a, b, sidak_deviations(3, 1e-4), "sphere");
}

TEST_F(Techniques, WalksThatKeepTheDiffuseFreePathPassASlabAsLightDoes) {
    // Lit from behind, seen from the front: complete simulation, and walks of both kinds. Ones that
    // keep the transport mean free path let less than half of the light through.
    const std::string light = xml::shape("rectangle",
                                         "<transform name=\"to_world\"><scale value=\"40\"/>"
                                         "<translate z=\"-8\"/></transform>" +
                                             xml::area_light({1, 1, 1}));
    const auto by = [&](const char* integrator, const char* free_path) {
        const Scene s = scene(
            xml::integrator(integrator) + light +
            slab(6, matter({1, 1, 1}, {0.004, 0.004, 0.004}, 1.5, word("free_path", free_path))));
        return look(s, onto_the_middle({0, 0, 1}, 4), {.pixels = 1000, .samples = 128});
    };
    const RadianceEstimate whole = by("volpath", "diffuse"), diffuse = by("path", "diffuse"),
                           transport = by("path", "transport");
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(diffuse.mean[c], whole.mean[c], 0.05 * whole.mean[c]) << c;
        EXPECT_LT(transport.mean[c], 0.5 * whole.mean[c]) << c;
        EXPECT_LT(std::hypot(whole.error[c], diffuse.error[c]), 0.01 * whole.mean[c]);
    }
}

TEST_F(Techniques, RandomWalksIgnoreOtherShapesInside) {
    const auto with = [&](const std::string& more) {
        const Scene s = scene(xml::integrator("path") + xml::constant_light() +
                              xml::sphere({}, 1.5, matter({1, 2, 3}, {0.1, 0.1, 0.1}, 1.3)) + more);
        return look(s, ray_bundle({0, 0, 9}, {0, 0, -1}, 1.5f), {.pixels = 400, .samples = 64});
    };
    const std::string black = xml::bsdf("diffuse", xml::rgb("reflectance", {0, 0, 0}));
    expect_agreement(with(""),
                     with(xml::sphere({0, 0, 0.5}, 0.8, black) + xml::sphere({}, 0.6, black)),
                     sidak_deviations(3, 1e-4), "spheres inside");
}

TEST_F(Techniques, WhatFallsOutOfAHoleIsLost) {
    // A wide box without a bottom is a slab that is lit from above alone.
    const auto box = [](int first, double top, double bottom, bool closed) {
        std::string text;
        for (double z : {top, bottom})
            text += fmt::format("v -40 -40 {0}\nv 40 -40 {0}\nv 40 40 {0}\nv -40 40 {0}\n", z);
        const std::vector<std::array<int, 4>> faces{{0, 1, 2, 3}, {0, 4, 5, 1}, {1, 5, 6, 2},
                                                    {2, 6, 7, 3}, {3, 7, 4, 0}, {7, 6, 5, 4}};
        for (std::size_t i = 0; i < (closed ? 6u : 5u); ++i)
            text += fmt::format("f {} {} {} {}\n", first + faces[i][0], first + faces[i][1],
                                first + faces[i][2], first + faces[i][3]);
        return text;
    };
    write("open.obj", box(1, 0, -1, false));
    write("above_another.obj", box(1, 0, -1, false) + box(9, -11, -12, true));
    const auto by = [&](const std::string& file, const std::string& inside) {
        const Scene s = scene(
            xml::integrator("path") + xml::constant_light() +
            xml::shape("obj", word("filename", file) + xml::flag("face_normals", true) + inside));
        return look(s, onto_the_middle({0, 0, 1}, 5), {.pixels = 1000, .samples = 64});
    };
    Vec3d sigma_s{1., 2., 0.5}, sigma_a{0.1, 0.1, 0.1}, expected;
    for (int c = 0; c < 3; ++c) {
        const auto walk = random_walk_medium({sigma_s[c], sigma_a[c], 0., 1.}, FreePath::transport);
        const double cosine[] = {1.};
        expected[c] =
            adding_doubling({{{walk.sigma_s, walk.sigma_t - walk.sigma_s, 0., 1., 1.}}}, cosine)
                .diffuse.reflectance;
    }
    expect_radiance(by("open.obj", matter(sigma_s, sigma_a, 1.)), expected, 4e-3, "open", 4.5);
    // Nothing is scattered, and what is met from outside is no place where light could have come
    // in: the boundary's reflection is seen, and a thousandth of the light through the sides.
    EXPECT_NEAR(by("above_another.obj", matter({}, {0.01, 0.01, 0.01}, 1.3)).mean.x,
                fresnel_dielectric(1., 1.3), 1e-3);
}

}  // namespace nacre
