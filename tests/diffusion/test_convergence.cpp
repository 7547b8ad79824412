// The error falls with the square of the cell, in the largest norm, against closed forms.
#include <gtest/gtest.h>

#include "nacre/math/quadrature.h"
#include "tests/diffusion/solids.h"
#include "tests/support/constants.h"

namespace nacre {
namespace {

using namespace test;

/// The slope of log error over log h between the first and the last of grids that halve.
double order(const std::vector<double>& errors) {
    return std::log2(errors.front() / errors.back()) / double(errors.size() - 1);
}

TEST(DiffusionConvergence, EvenBallIsOfSecondOrder) {
    const EvenBall exact;
    const Mesh mesh = ball_mesh(exact.R, 3e-5);
    std::vector<double> errors;
    for (const double n : {16., 32., 64.}) {
        const Solved s = solved(mesh, GridFrame::around(mesh.bounds(), n),
                                {.diffusion = [&](const Vec3d&) { return exact.D; },
                                 .absorption = [&](const Vec3d&) { return exact.sigma_a; },
                                 .source = [&](const Vec3d&) { return exact.Q; },
                                 .q = {},
                                 .boundary = exact.A});
        errors.push_back(largest_error(s, [&](const Vec3d& p) { return exact(length(p)); }));
        // And on the surface itself, between the cells.
        const Vec3d n_ = normalize(Vec3d(0.3, -0.5, 0.7));
        EXPECT_NEAR(surface_fluence(s.grid, s.matter, s.phi, n_ * exact.R, n_)[0], exact(exact.R),
                    3. * errors.back());
    }
    EXPECT_GT(order(errors), 1.8);
    EXPECT_LT(errors.back(), 2e-4);
}

// phi = 2 + sin(a x) cos(b y) exp(c z) in a ball, D = D0 (1 + u x), sigma_a = s0 (1 + v y).
TEST(DiffusionConvergence, VariableMatterIsOfSecondOrder) {
    const double a = 1.1, b = 0.7, c = 0.4, D0 = 0.3, u = 0.25, s0 = 0.2, v = 0.3, A = 2.6;
    const auto phi = [&](const Vec3d& p) {
        return 2. + std::sin(a * p.x) * std::cos(b * p.y) * std::exp(c * p.z);
    };
    const auto D = [&](const Vec3d& p) { return D0 * (1. + u * p.x); };
    const auto absorption = [&](const Vec3d& p) { return s0 * (1. + v * p.y); };
    const auto gradient = [&](const Vec3d& p) {
        const double e = std::exp(c * p.z);
        return Vec3d(a * std::cos(a * p.x) * std::cos(b * p.y) * e,
                     -b * std::sin(a * p.x) * std::sin(b * p.y) * e,
                     c * std::sin(a * p.x) * std::cos(b * p.y) * e);
    };
    const auto source = [&](const Vec3d& p) {
        const double laplacian = (c * c - a * a - b * b) * (phi(p) - 2.);
        return -D(p) * laplacian - D0 * u * gradient(p).x + absorption(p) * phi(p);
    };
    const auto q = [&](const Vec3d& p, const Vec3d& n) {
        return phi(p) + 2. * A * D(p) * dot(gradient(p), n);
    };
    const Mesh mesh = ball_mesh(1., 3e-5);
    std::vector<double> errors;
    for (const double n : {16., 32., 64.})
        errors.push_back(largest_error(
            solved(mesh, GridFrame::around(mesh.bounds(), n), {D, absorption, source, q, A}), phi));
    EXPECT_GT(order(errors), 1.8) << errors[0] << ' ' << errors[1] << ' ' << errors[2];
    EXPECT_LT(errors.back(), 4e-4);
}

// Two layers, D from 0.3 to 0.05 at the middle of a ball whose surface sees what the layers' own
// solution has there. The jump lies between cells, as a grid that follows matter would put it.
TEST(DiffusionConvergence, AJumpOfMatterIsOfSecondOrder) {
    const double D1 = 0.3, D2 = 0.05, s = 0.1, A = 1.3;
    // cosh(k1 (x + 1)) below the jump; above, what goes on with the same value and flux.
    const double k1 = std::sqrt(s / D1), k2 = std::sqrt(s / D2);
    const double value = std::cosh(k1), slope = k1 * std::sinh(k1) * D1 / D2;
    const auto phi = [&](const Vec3d& p) {
        return p.x < 0. ? std::cosh(k1 * (p.x + 1.))
                        : value * std::cosh(k2 * p.x) + slope / k2 * std::sinh(k2 * p.x);
    };
    const auto D = [&](const Vec3d& p) { return p.x < 0. ? D1 : D2; };
    const auto q = [&](const Vec3d& p, const Vec3d& n) {
        const double d = p.x < 0. ? k1 * std::sinh(k1 * (p.x + 1.))
                                  : k2 * value * std::sinh(k2 * p.x) + slope * std::cosh(k2 * p.x);
        return phi(p) + 2. * A * D(p) * d * n.x;
    };
    const Mesh mesh = ball_mesh(1., 3e-5);
    std::vector<double> errors;
    for (const int cells : {16, 32, 64}) {
        GridFrame f = GridFrame::around(mesh.bounds(), cells);
        f.origin.x = -f.h * double(cells / 2 + 1);
        const Solved solution = solved(mesh, f, {D, [&](const Vec3d&) { return s; }, {}, q, A});
        errors.push_back(largest_error(solution, phi) / phi({1, 0, 0}));
    }
    EXPECT_GT(order(errors), 1.8) << errors[0] << ' ' << errors[1] << ' ' << errors[2];
    EXPECT_LT(errors.back(), 1e-3);
}

// A point source below the plane z = 0 of a half space: the free field is taken off, the rest is
// smooth. Exact by the method of images with a line of sinks (compendium, section 5).
TEST(DiffusionConvergence, HalfSpaceIsOfSecondOrder) {
    const double D = 0.33003300330033003, s = 0.03, A = 2.6, z0 = 0.9900990099;
    const double k = std::sqrt(s / D), sink = 1. / (2. * A * D);
    const auto G = [&](double r) { return std::exp(-k * r) / (4. * pi * D * r); };
    const GaussLegendre quadrature(48);
    // What the boundary adds to the free field, at depth -z.
    const auto added = [&](const Vec3d& p) {
        const double rho2 = p.x * p.x + p.y * p.y, z = -p.z;
        const double line = quadrature.integrate(0., 1., [&](double t) {
            const double at = t / (1. - t), d = z + z0 + at;  // the line, mapped to [0, 1)
            return std::exp(-sink * at) * G(std::sqrt(rho2 + d * d)) / ((1. - t) * (1. - t));
        });
        return G(std::sqrt(rho2 + (z + z0) * (z + z0))) - 2. * sink * line;
    };
    const auto q = [&](const Vec3d& p, const Vec3d& n) {
        const double e = 1e-4;
        if (n.z > 0.99) {  // the boundary itself: q = 0 of the whole field
            const Vec3d from = p - Vec3d(0, 0, -z0);
            const double r = length(from);
            return -G(r) * (1. - 2. * A * D * (k + 1. / r) * dot(from, n) / r);
        }
        const double slope = (added(p + n * e) - added(p - n * e)) / (2. * e);
        return added(p) + 2. * A * D * slope;
    };
    const Mesh mesh = box_mesh({-3, -3, -3.2f}, {3, 3, 0});
    std::vector<double> errors;
    for (const double n : {12., 24., 48.}) {
        const Solved f =
            solved(mesh, GridFrame::around(mesh.bounds(), n),
                   {[&](const Vec3d&) { return D; }, [&](const Vec3d&) { return s; }, {}, q, A});
        double most = 0.;
        for (const Vec3d& p : {Vec3d(0, 0, 0), Vec3d(0.5, 0, 0), Vec3d(2, 0, 0)})
            most = std::max(
                most,
                std::abs(surface_fluence(f.grid, f.matter, f.phi, p, {0, 0, 1})[0] - added(p)));
        for (std::size_t c = 0; c < f.grid.size(); ++c) {
            const Vec3d p = f.grid.center(c);
            const CutCell* cut = f.grid.cut(c);
            if (cut && length(cut->area_vector) < 0.99 * cut->area) continue;
            if (p.z < 0.) most = std::max(most, std::abs(f.phi[c][0] - added(p)));
        }
        errors.push_back(most);
    }
    EXPECT_GT(order(errors), 1.8) << errors[0] << ' ' << errors[1] << ' ' << errors[2];
    // The published value on the axis, of the whole field.
    EXPECT_NEAR(added({0, 0, 0}) + G(z0), 0.22548448079321376, 1e-6);
}

// The same ball elsewhere on the grid and turned: the same field, within what the order allows.
TEST(DiffusionConvergence, AShiftedAndTurnedObjectGivesTheSame) {
    const Mesh box = box_mesh({-1, -0.7f, -0.5f}, {1, 0.7f, 0.5f});
    std::vector<double> differences;
    for (const double n : {16., 32.}) {
        double phi[2];
        for (const int i : {0, 1}) {
            const Mesh mesh = turned(box, i * 0.6);
            const Solved s =
                solved(mesh, GridFrame::around(mesh.bounds(), i ? 1.13 * n : n, {0.3, 0.4, 0.2}),
                       {[](const Vec3d&) { return 0.3; },
                        [](const Vec3d&) { return 0.1; },
                        [](const Vec3d&) { return 1.; },
                        {},
                        1.});
            Mesh place;
            place.positions = {{0.5f, 0.3f, -0.2f}};
            place = turned(std::move(place), i * 0.6);
            phi[i] = fluence(s.grid, s.phi, Vec3d(place.positions[0]))[0];
        }
        differences.push_back(std::abs(phi[0] / phi[1] - 1.));
    }
    EXPECT_LT(differences[0], 1e-2);
    EXPECT_LT(differences[1], 3e-3);
}

}  // namespace
}  // namespace nacre
