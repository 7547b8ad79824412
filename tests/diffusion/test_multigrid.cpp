// Multigrid: how quickly it solves, what it keeps, and that no shape stops it.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <set>

#include "nacre/math/error.h"
#include "tests/diffusion/solids.h"
#include "tests/support/constants.h"
#include "tests/support/error_of.h"

namespace nacre {
namespace {

using namespace test;

Posed even(double D, double absorption, double A) {
    return {[=](const Vec3d&) { return D; },
            [=](const Vec3d&) { return absorption; },
            [](const Vec3d&) { return 1.; },
            {},
            A};
}

Solved even_ball(double n, const Posed& posed, const SolveOptions& options = {}) {
    const Mesh mesh = ball_mesh(1., 1e-3);
    return solved(mesh, GridFrame::around(mesh.bounds(), n), posed, options);
}

TEST(Multigrid, ResidualFallsTenfoldACycleAtEverySize) {
    for (const double D : {0.3, 0.03, 3.})
        for (const double n : {16., 32., 64.})
            EXPECT_LT(even_ball(n, even(D, 0.01, 2.6)).report.factor(), 0.1) << D << ' ' << n;
}

TEST(Multigrid, AJumpOfTenKeepsItQuick) {
    Posed jump = even(0.3, 0.01, 2.6);
    jump.diffusion = [](const Vec3d& p) { return p.x + 0.5 * p.y + 0.3 * p.z > 0. ? 3. : 0.3; };
    Posed pieces = even(0.3, 0.01, 2.6);  // veins
    pieces.diffusion = [](const Vec3d& p) {
        return std::sin(9. * p.x) * std::sin(9. * p.y) * std::sin(9. * p.z) > 0.2 ? 3. : 0.3;
    };
    for (const double n : {16., 32., 64.}) {
        EXPECT_LT(even_ball(n, jump).report.factor(), 0.2) << n;
        EXPECT_LT(even_ball(n, pieces).report.factor(), 0.2) << n;
    }
}

// Cycles alone, without conjugate gradients, take more of them and end at the same.
TEST(Multigrid, CyclesAloneSolveTheSame) {
    SolveOptions alone;
    alone.method = SolveOptions::Method::v_cycles;
    alone.tolerance = 1e-10;
    SolveOptions both;
    both.tolerance = 1e-10;
    const Solved a = even_ball(32., even(0.3, 0.1, 1.), alone),
                 b = even_ball(32., even(0.3, 0.1, 1.), both);
    EXPECT_LT(a.report.factor(), 0.2);
    for (std::size_t c = 0; c < a.grid.size(); ++c) ASSERT_NEAR(a.phi[c][0], b.phi[c][0], 1e-8);
}

TEST(Multigrid, EnergyIsKept) {
    for (const double n : {12., 40.}) {
        SolveOptions options;
        options.tolerance = 1e-11;
        const Solved s = even_ball(n, even(0.15, 0.02, 2.6), options);
        double in = 0.;
        for (const BandDoubles& p : s.power) in += p[0];
        const EnergyBalance e = energy_balance(s.grid, s.matter, s.problem, s.phi);
        EXPECT_NEAR((e.out[0] + e.absorbed[0]) / in, 1., 1e-8);
        EXPECT_NEAR(in, 4. / 3. * pi, 0.01);
    }
}

// Two sheets with a gap between them of less than a cell, so that blocks of cells hold pieces of
// both, which have nothing to do with each other. Light in one must not reach the other.
TEST(Multigrid, PartsBesideEachOtherStayApart) {
    const Mesh two = joined(box_mesh({-1, -1, -0.08f}, {1, 1, -0.01f}),
                            box_mesh({-1, -1, 0.01f}, {1, 1, 0.08f}));
    Posed posed = even(0.3, 0.001, 100.);  // hardly anything leaves
    posed.source = [](const Vec3d& p) { return p.z < 0. ? 1. : 0.; };
    GridFrame f = GridFrame::around(two.bounds(), 31.);
    f.origin.z = -3. * f.h;  // z = 0 lies between the cells 2 and 3, which are of one block
    f.n[2] = 7;
    SolveOptions options;
    options.most_cycles = 15;
    const Solved s = solved(two, f, posed, options);
    std::vector<CellPlace> places;
    for (std::size_t c = 0; c < s.grid.size(); ++c) {
        ASSERT_LT(s.grid.center(c).z > 0. ? std::abs(s.phi[c][0]) : 0., 1e-6);
        places.push_back(s.grid.place(c));
    }
    const Aggregates a = aggregates_of(s.multigrid.matrix(), places);
    EXPECT_LT(a.size(), s.grid.size() / 3);
    for (std::size_t c = 0; c < s.grid.size(); ++c)
        ASSERT_EQ(s.grid.center(c).z > 0., s.grid.center(a.member[a.first[a.of[c]]]).z > 0.);
    // Blocks that hold both were broken up.
    const std::set<CellPlace> blocks(a.place.begin(), a.place.end());
    EXPECT_LT(blocks.size(), a.size());
}

// A long thin rod across the grid, less than a cell thick.
TEST(Multigrid, AThinRodIsSolved) {
    const Mesh rod = turned(box_mesh({-3, -0.04f, -0.03f}, {3, 0.04f, 0.03f}), 0.9);
    SolveOptions options;
    options.most_cycles = 25;
    EXPECT_NO_THROW(
        solved(rod, GridFrame::around(rod.bounds(), 60.), even(0.3, 0.001, 10.), options));
}

TEST(Multigrid, ASolutionIsAGoodStart) {
    const Mesh mesh = ball_mesh(1., 1e-3);
    Solved s = solved(mesh, GridFrame::around(mesh.bounds(), 32.), even(0.3, 0.1, 1.));
    std::vector<BandDoubles> b;
    for (const BandDoubles& p : s.power) b.push_back(p * BandDoubles(1.001));
    const int fresh = s.report.cycles;
    EXPECT_LT(solve(s.multigrid, b, s.phi).cycles, fresh);
    EXPECT_EQ(solve(s.multigrid, b, s.phi).cycles, 0);
}

TEST(Multigrid, BitsDoNotDependOnThreads) {
    const auto bits = [] { return even_ball(24., even(0.3, 0.1, 1.)).phi; };
    const std::vector<BandDoubles> many = bits();
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const std::vector<BandDoubles> few = bits();
    for (std::size_t c = 0; c < many.size(); ++c)
        for (int b = 0; b < 4; ++b) ASSERT_EQ(many[c][b], few[c][b]);
}

// Bands have matter and light of their own; one without light stays dark.
TEST(Multigrid, BandsAreSolvedApart) {
    const Mesh mesh = ball_mesh(1., 1e-4);
    const CellGrid grid(mesh, GridFrame::around(mesh.bounds(), 32.));
    const float D[] = {0.3f, 0.1f, 0.9f, 0.3f}, absorption[] = {0.1f, 0.02f, 0.5f, 0.1f};
    DiffusionMatter matter;
    matter.diffusion = {BandFloats::load(D)};
    matter.absorption = {BandFloats::load(absorption)};
    DiffusionProblem problem = make_problem(grid, matter);
    std::vector<CellPlace> places;
    std::vector<BandDoubles> b;
    for (std::size_t c = 0; c < grid.size(); ++c) {
        places.push_back(grid.place(c));
        const double v = grid.volume(c) * std::pow(grid.frame().h, 3.);
        b.push_back({v, v, v, 0.});
    }
    Multigrid multigrid(std::move(problem.matrix), places);
    std::vector<BandDoubles> phi;
    solve(multigrid, b, phi);
    for (int band = 0; band < 3; ++band) {
        const EvenBall exact{.D = double(D[band]), .sigma_a = double(absorption[band])};
        EXPECT_NEAR(fluence(grid, phi, {0.2, 0.1, 0.3})[band] / exact(std::sqrt(0.14)), 1., 3e-3);
    }
    EXPECT_EQ(fluence(grid, phi, {0.2, 0.1, 0.3})[3], 0.);
}

TEST(DiffusionProblem, WrongMatterIsRefused) {
    const Mesh mesh = box_mesh({0, 0, 0}, {1, 1, 1});
    const CellGrid grid(mesh, GridFrame::around(mesh.bounds(), 4.));
    const struct {
        DiffusionMatter matter;
        std::string message;
    } cases[] = {
        {{{BandFloats(0.f)}, {BandFloats(0.f)}, 1.},
         "the diffusion coefficient, which must be positive, is 0"},
        {{{BandFloats(float(nan))}, {BandFloats(0.f)}, 1.},
         "the diffusion coefficient, which must be positive, is nan"},
        {{{BandFloats(1.f)}, {BandFloats(-0.1f)}, 1.},
         "absorption, which must not be negative, is -0.1"},
        {{{BandFloats(1.f)}, {BandFloats(0.f)}, 0.},
         "boundary parameter A = 0: it must be positive"},
        {{{BandFloats(1.f), BandFloats(1.f)}, {BandFloats(0.f)}, 1.},
         "2 diffusion and 1 absorption coefficients for "},
    };
    for (const auto& c : cases)
        EXPECT_EQ(error_of([&] { make_problem(grid, c.matter); }).substr(0, c.message.size()),
                  c.message);
    // Cells of more than 1.15 z_b: the distance from the surface is clamped, and that is said.
    DiffusionMatter coarse{{BandFloats(0.01f)}, {BandFloats(0.f)}, 1.};
    EXPECT_GT(make_problem(grid, coarse).clamped, 0u);
    coarse.diffusion = {BandFloats(1.f)};
    EXPECT_EQ(make_problem(grid, coarse).clamped, 0u);
}

TEST(DiffusionSolver, WhatIsNotReachedIsSaid) {
    SolveOptions options;
    options.most_cycles = 2;
    std::string message;
    try {
        even_ball(16., even(0.3, 0.1, 1.), options);
    } catch (const RunError& error) {
        message = error.what();
    }
    EXPECT_TRUE(
        message.starts_with("the diffusion equation was not solved to 1e-08 within 2 cycles: "))
        << message;
    EXPECT_TRUE(message.ends_with(" is left; set a larger tolerance")) << message;
}

}  // namespace
}  // namespace nacre
