// Cut cells against closed forms: what they hold is exact to the mesh.
#include <gtest/gtest.h>

#include "nacre/diffusion/cell_grid.h"
#include "nacre/diffusion/memory.h"
#include "nacre/math/error.h"
#include "tests/diffusion/solids.h"
#include "tests/support/constants.h"
#include "tests/support/error_of.h"

namespace nacre {
namespace {

using namespace test;

double mesh_volume(const Mesh& m) {
    double v = 0.;
    for (const auto& t : m.triangles)
        v += dot(Vec3d(m.positions[t[0]]),
                 cross(Vec3d(m.positions[t[1]]), Vec3d(m.positions[t[2]]))) /
             6.;
    return v;
}

double mesh_area(const Mesh& m) {
    double a = 0.;
    for (const auto& t : m.triangles)
        a += 0.5 * length(cross(Vec3d(m.positions[t[1]]) - Vec3d(m.positions[t[0]]),
                                Vec3d(m.positions[t[2]]) - Vec3d(m.positions[t[0]])));
    return a;
}

/// A bowl: a ball with a ball taken out of it, a cavity that nothing leads into.
Mesh hollow_ball() {
    Mesh inner = ball_mesh(0.6, 1e-3, {0.1f, 0.f, 0.f});
    for (auto& t : inner.triangles) std::swap(t[1], t[2]);
    return joined(ball_mesh(1., 1e-3), inner);
}

TEST(CutCells, AreasOfEachCellCloseAndVolumesAreTheMeshes) {
    const Mesh meshes[] = {ball_mesh(1., 1e-3),
                           turned(box_mesh({-1, -0.5f, -0.2f}, {1, 0.5f, 0.3f}), 0.4),
                           box_mesh({0, 0, 0}, {1, 1, 1}), hollow_ball()};
    for (const Mesh& mesh : meshes) {
        for (const double n : {7., 40.}) {
            const CellGrid grid(mesh, GridFrame::around(mesh.bounds(), n));
            const double h = grid.frame().h;
            EXPECT_NEAR(grid.volume(), mesh_volume(mesh), 1e-11 * mesh_volume(mesh));
            EXPECT_NEAR(grid.area(), mesh_area(mesh), 1e-11 * mesh_area(mesh));
            EXPECT_EQ(grid.overlaps(), 0u);
            Vec3d all;
            for (const CutCell& c : grid.cuts()) {
                all += c.area_vector;
                for (std::size_t d = 0; d < 3; ++d)
                    EXPECT_NEAR(c.area_vector[d],
                                h * h * (c.aperture[2 * d] - c.aperture[2 * d + 1]), 2e-9 * h * h);
            }
            EXPECT_LT(length(all), 1e-12 * mesh_area(mesh));
        }
    }
}

// The volume of a cut cell comes from its faces in x; the two other directions must agree. A face
// is seen from both of its cells.
TEST(CutCells, FacesAndVolumesAgreeFromEveryDirection) {
    Mesh mesh = turned(box_mesh({-1, -0.5f, -0.2f}, {1, 0.5f, 0.3f}), 0.7);
    const CellGrid grid(mesh, GridFrame::around(mesh.bounds(), 23.));
    // The same mesh with its axes exchanged.
    for (Point3f& p : mesh.positions) p = {p.y, p.z, p.x};
    GridFrame f = grid.frame();
    f.origin = {f.origin.y, f.origin.z, f.origin.x};
    f.n = {f.n[1], f.n[2], f.n[0]};
    const CellGrid other(mesh, f);
    ASSERT_EQ(grid.size(), other.size());
    for (std::size_t c = 0; c < grid.size(); ++c) {
        const CellPlace p = grid.place(c);
        const std::uint32_t twin = other.at({p[1], p[2], p[0]});
        ASSERT_NE(twin, CellGrid::none);
        EXPECT_NEAR(grid.volume(c), other.volume(twin), 1e-10);
        for (std::size_t face = 0; face < 6; ++face) {
            EXPECT_NEAR(grid.aperture(c, face), other.aperture(twin, (face + 4) % 6), 1e-9);
            const std::uint32_t n = grid.neighbour(c, face);
            if (n == CellGrid::none) continue;
            EXPECT_NEAR(grid.aperture(c, face), grid.aperture(n, face ^ 1), 2e-9);
        }
    }
}

TEST(CutCells, APlaneThroughACellIsKnownExactly) {
    // A box of 1 on cells of 0.5 whose planes lie 0.1 before its faces: cells of 0.4, 0.5 and 0.1.
    GridFrame f{.origin = {-0.6, -0.6, -0.6}, .h = 0.5, .n = {5, 5, 5}};
    const CellGrid grid(box_mesh({0, 0, 0}, {1, 1, 1}), f);
    EXPECT_EQ(grid.size(), 27u);
    const auto width = [](int i) { return i == 1 ? 0.8 : i == 2 ? 1. : 0.2; };
    for (std::size_t c = 0; c < grid.size(); ++c) {
        const CellPlace p = grid.place(c);
        EXPECT_NEAR(grid.volume(c), width(p[0]) * width(p[1]) * width(p[2]), 1e-6);
        if (p[0] == 1 && p[1] == 2 && p[2] == 2) {
            EXPECT_NEAR(grid.cut(c)->offset, 0.15, 1e-6);
            EXPECT_NEAR(grid.cut(c)->area, 0.25, 1e-6);
            EXPECT_NEAR(grid.cut(c)->centroid.x, 0., 1e-6);
        }
    }
}

TEST(CutCells, PartsThinnerThanTwoCellsAreCounted) {
    const Mesh ball = ball_mesh(1., 1e-3);
    EXPECT_EQ(CellGrid(ball, GridFrame::around(ball.bounds(), 24.)).thin_cells(), 0u);
    const Mesh plate = box_mesh({-1, -1, -0.03f}, {1, 1, 0.03f});
    const CellGrid thin(plate, GridFrame::around(plate.bounds(), 20.));  // 0.6 cells
    EXPECT_EQ(thin.thin_cells(), thin.cuts().size());
    EXPECT_NEAR(thin.thin_area(), thin.area(), 1e-9);
    EXPECT_EQ(CellGrid(plate, GridFrame::around(plate.bounds(), 120.)).thin_cells(), 0u);
}

TEST(CutCells, WhatIsNoSolidIsRefused) {
    Mesh open = box_mesh({0, 0, 0}, {1, 1, 1});
    open.triangles.pop_back();
    Mesh inverted = box_mesh({0, 0, 0}, {1, 1, 1});
    for (auto& t : inverted.triangles) std::swap(t[1], t[2]);
    struct {
        Mesh mesh;
        const char* message;
    } cases[] = {
        {open,
         "the mesh 'thing' has no closed interior: 3 of its 33 triangle sides have no other "
         "triangle beside them; close its holes (`nacre info` lists them)"},
        {inverted,
         "the mesh 'thing' encloses nothing: its triangles face inwards; turn them round "
         "(flip_normals)"},
    };
    for (auto& c : cases) {
        c.mesh.name = "thing";
        EXPECT_EQ(error_of([&] { CellGrid(c.mesh, GridFrame::around(c.mesh.bounds(), 8.)); }),
                  c.message);
    }
}

TEST(DiffusionMemory, IsEstimatedBeforeItIsTaken) {
    const Mesh ball = ball_mesh(1., 1e-3);
    const GridFrame f = GridFrame::around(ball.bounds(), 64.);
    const DiffusionMemory m = diffusion_memory(ball, f);
    const CellGrid grid(ball, f);
    EXPECT_NEAR(m.cells, double(grid.size()), 0.05 * double(grid.size()));
    EXPECT_GT(m.bytes, double(grid.bytes()));
    EXPECT_NO_THROW(check_memory(ball, 64., 1e9, "cells"));
    // 4/3 pi (N/2)^3 cells and half of those cut, of 620 bytes; 500 for each that is cut.
    EXPECT_EQ(
        error_of([&] { check_memory(ball, 2048., 4e9, "cells"); }),
        "cells = 2048 takes a grid of 4.51e+09 cells and 2.87e+03 GB, and there are 4 GB: set "
        "cells to 225 or less");
}

}  // namespace
}  // namespace nacre
