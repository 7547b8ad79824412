#pragma once
// Closed meshes of the diffusion tests, and problems on them.
#include <functional>
#include <numbers>

#include "nacre/diffusion/field.h"
#include "nacre/diffusion/solver.h"
#include "nacre/geometry/tessellate.h"

namespace nacre::test {

/// `error`: how far facets may be from the sphere, in radii.
inline Mesh ball_mesh(double radius, double error = 1e-4, Point3f center = {}) {
    return tessellate(Sphere{.center = center, .radius = float(radius)}, error);
}

inline Mesh box_mesh(const Point3f& lower, const Point3f& upper) {
    Mesh m;
    for (int i = 0; i < 8; ++i)
        m.positions.push_back(
            {i & 1 ? upper.x : lower.x, i & 2 ? upper.y : lower.y, i & 4 ? upper.z : lower.z});
    m.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                   {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return m;
}

/// Turned about an axis that is none of the grid's.
inline Mesh turned(Mesh mesh, double angle) {
    const Vec3d k = normalize(Vec3d(1, 2, 3));
    for (Point3f& p : mesh.positions) {
        const Vec3d v(p);
        p = Point3f(v * std::cos(angle) + cross(k, v) * std::sin(angle) +
                    k * (dot(k, v) * (1. - std::cos(angle))));
    }
    mesh.normals.clear();
    return mesh;
}

inline Mesh joined(Mesh a, const Mesh& b) {
    const std::uint32_t n = std::uint32_t(a.positions.size());
    a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
    for (const Mesh::Triangle& t : b.triangles)
        a.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
    a.normals.clear();
    return a;
}

/// A problem whose matter and light are functions of the place.
struct Posed {
    std::function<double(const Vec3d&)> diffusion, absorption, source;
    std::function<double(const Vec3d& p, const Vec3d& n)> q;
    double boundary = 1.;
};

struct Solved {
    CellGrid grid;
    DiffusionMatter matter;
    DiffusionProblem problem;  // its matrix lives in `multigrid`
    Multigrid multigrid;
    std::vector<BandDoubles> power, q, phi;
    SolveReport report;
};

inline DiffusionMatter matter_of(const CellGrid& grid, const Posed& posed) {
    DiffusionMatter m;
    m.boundary = posed.boundary;
    for (std::size_t c = 0; c < grid.size(); ++c) {
        m.diffusion.push_back(BandFloats(float(posed.diffusion(grid.center(c)))));
        m.absorption.push_back(BandFloats(float(posed.absorption(grid.center(c)))));
    }
    return m;
}

inline Solved solved(const Mesh& mesh, const GridFrame& frame, const Posed& posed,
                     const SolveOptions& options = {}) {
    CellGrid grid(mesh, frame);
    DiffusionMatter matter = matter_of(grid, posed);
    DiffusionProblem problem = make_problem(grid, matter);
    std::vector<CellPlace> places;
    std::vector<BandDoubles> power, q;
    const double h = frame.h;
    for (std::size_t c = 0; c < grid.size(); ++c) {
        places.push_back(grid.place(c));
        power.push_back(BandDoubles(
            posed.source ? posed.source(grid.center(c)) * grid.volume(c) * h * h * h : 0.));
    }
    if (posed.q)
        for (const CutCell& c : grid.cuts()) {
            const Vec3d n = normalize(c.area_vector);
            q.push_back(BandDoubles(posed.q(grid.foot(c), n)));
        }
    const std::vector<BandDoubles> b = right_side(grid, problem, power, q);
    Multigrid multigrid(std::move(problem.matrix), places);
    std::vector<BandDoubles> phi;
    SolveReport report = solve(multigrid, b, phi, options);
    return {std::move(grid),  std::move(matter), std::move(problem), std::move(multigrid),
            std::move(power), std::move(q),      std::move(phi),     std::move(report)};
}

/// The largest |phi - exact| over the cells.
inline double largest_error(const Solved& s, const std::function<double(const Vec3d&)>& exact) {
    double most = 0.;
    for (std::size_t c = 0; c < s.grid.size(); ++c)
        most = std::max(most, std::abs(s.phi[c][0] - exact(s.grid.center(c))));
    return most;
}

/// phi in a ball of radius R about the origin with an even source Q and q = 0:
/// Q / sigma_a + C sinh(kappa r) / r.
struct EvenBall {
    double R = 1., D = 0.3, sigma_a = 0.1, A = 1., Q = 1.;

    double operator()(double r) const {
        const double k = std::sqrt(sigma_a / D);
        const double at = std::sinh(k * R) / R,
                     slope = (k * R * std::cosh(k * R) - std::sinh(k * R)) / (R * R);
        const double c = -Q / sigma_a / (at + 2. * A * D * slope);
        return Q / sigma_a + c * (r > 1e-9 ? std::sinh(k * r) / r : k);
    }
};

}  // namespace nacre::test
