// Scattering vectors of the diffusion equation: solved on grids, so compared to what those reach.
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "nacre/diffusion/system.h"
#include "nacre/geometry/tessellate.h"
#include "nacre/vectors/scattering.h"

namespace nacre {
namespace {

using nlohmann::json;

constexpr double pi = std::numbers::pi;
using Place = std::function<double(const Vec3d&)>;

Vec3d vector_of(const json& v) { return {v.at(0), v.at(1), v.at(2)}; }

/// What is asked for, as functions of the place; `q` of the surface and its normal.
struct Posed {
    Place diffusion, absorption, source;
    std::function<double(const Vec3d& p, const Vec3d& n)> q;
    double boundary;
};

struct Field {
    DiffusionSystem system;
    std::vector<BandDoubles> phi;

    double inside(const Vec3d& p) const { return fluence(system.grid(), phi, p)[0]; }
    double surface(const Vec3d& p, const Vec3d& n, double q) const {
        return surface_fluence(system.grid(), system.matter(), phi, p, n, BandDoubles(q))[0];
    }
};

Field solved(const Mesh& mesh, double cells, const Posed& posed) {
    CellGrid grid(mesh, GridFrame::around(mesh.bounds(), cells));
    const double h = grid.frame().h;
    DiffusionMatter matter;
    matter.boundary = posed.boundary;
    std::vector<BandDoubles> power, q;
    for (std::size_t c = 0; c < grid.size(); ++c) {
        const Vec3d p = grid.center(c);
        matter.diffusion.push_back(BandFloats(float(posed.diffusion(p))));
        matter.absorption.push_back(BandFloats(float(posed.absorption(p))));
        power.push_back(
            BandDoubles(posed.source ? posed.source(p) * grid.volume(c) * h * h * h : 0.));
    }
    for (const CutCell& cut : grid.cuts())
        q.push_back(BandDoubles(posed.q(grid.foot(cut), normalize(cut.area_vector))));
    Field field{{std::move(grid), std::move(matter)}, {}};
    field.system.solve(power, q, field.phi);
    return field;
}

Mesh ball(double radius) { return tessellate(Sphere{.center = {}, .radius = float(radius)}, 3e-5); }

Place constant(double value) {
    return [value](const Vec3d&) { return value; };
}

constexpr double ball_cells = 64.;

// One that is none of the grid's.
const Vec3d along = normalize(Vec3d(0.48, -0.6, 0.64));

void sphere_uniform(const json& rows, Comparison& result) {
    for (const json& row : rows) {
        const double R = row.at("R"), D = row.at("D"), A = row.at("A"), q = row.at("q"),
                     s = row.at("sa"), Q = row.at("Q");
        const Field f = solved(ball(R), ball_cells,
                               {constant(D), constant(s), constant(Q),
                                [&](const Vec3d&, const Vec3d&) { return q; }, A});
        const std::string where = fmt::format("sphere R {:g} D {:g}", R, D);
        const std::vector<BandDoubles> qs(f.system.grid().cuts().size(), BandDoubles(q));
        const EnergyBalance e = f.system.balance(f.phi, qs);
        for (std::size_t i = 0; i < row.at("r").size(); ++i) {
            const double r = row["r"][i];
            const double phi = r < R ? f.inside(along * r) : f.surface(along * R, along, q);
            result.add(fmt::format("{} r {:g}", where, r), phi, row.at("phi")[i], 3e-3);
        }
        result.add(where + " outflow", e.out[0], row.at("total_net_outflow"));
        result.add(where + " absorbed", e.absorbed[0], row.at("absorbed"));
    }
}

/// exp(-k r) / (4 pi D r) and its derivative.
struct FreeField {
    double D, k, power;

    double operator()(double r) const { return power * std::exp(-k * r) / (4. * pi * D * r); }
    double slope(double r) const { return -(k + 1. / r) * (*this)(r); }
};

void sphere_point(const json& rows, Comparison& result) {
    for (const json& row : rows) {
        const double R = row.at("R"), D = row.at("D"), A = row.at("A"), s = row.at("sa");
        const FreeField free{D, std::sqrt(s / D), row.at("P")};
        // The rest is smooth: the free field is taken off.
        const auto q = [&](const Vec3d& p, const Vec3d& n) {
            const double r = length(p);
            return -free(r) - 2. * A * D * free.slope(r) * dot(p, n) / r;
        };
        const Field f = solved(ball(R), ball_cells, {constant(D), constant(s), {}, q, A});
        for (std::size_t i = 0; i < row.at("r").size(); ++i) {
            const double r = row["r"][i];
            const Vec3d p = along * r;
            const double rest = r < R ? f.inside(p) : f.surface(p, along, q(p, along));
            // Close to a boundary that returns nearly nothing the two cancel.
            result.add(fmt::format("point in sphere R {:g} r {:g}", R, r), free(r) + rest,
                       row.at("phi")[i], 1e-2);
        }
    }
}

/// The stencils in one dimension: a row of cells, whose ends are its surface.
void slab(const json& rows, Comparison& result) {
    constexpr std::size_t n = 1000;
    for (const json& row : rows) {
        const double L1 = row.at("L1"), L2 = row.at("L2"), h = L2 / double(n);
        BandMatrix m;
        std::vector<CellPlace> places;
        std::vector<BandDoubles> b(n);
        const auto at = [&](std::size_t i, const char* first, const char* second) -> double {
            return (double(i) + 0.5) * h < L1 ? row.at(first) : row.at(second);
        };
        // Even cells first.
        const auto number = [](std::size_t i) { return i % 2 ? n / 2 + i / 2 : i / 2; };
        m.even = n / 2;
        m.first.push_back(0);
        for (std::size_t k = 0; k < n; ++k) {
            const std::size_t i = k < n / 2 ? 2 * k : 2 * (k - n / 2) + 1;
            const double D = at(i, "D1", "D2");
            double reaction = at(i, "s1", "s2") * h;
            b[k] = BandDoubles(at(i, "Q1", "Q2") * h);
            places.push_back({std::int32_t(i), 0, 0});
            for (const int side : {-1, 1}) {
                if ((i == 0 && side < 0) || (i + 1 == n && side > 0)) {
                    const double A = row.at(side < 0 ? "A0" : "A1");
                    reaction += 1. / boundary_resistance(A, 0.5 * h, BandFloats(float(D))).value[0];
                    continue;
                }
                const double there = at(i + std::size_t(side), "D1", "D2");
                m.neighbour.push_back(std::uint32_t(number(i + std::size_t(side))));
                m.weight.push_back(BandFloats(float(2. * D * there / (D + there) / h)));
            }
            m.reaction.push_back(BandFloats(float(reaction)));
            m.first.push_back(std::uint32_t(m.neighbour.size()));
        }
        Multigrid multigrid(std::move(m), places);
        std::vector<BandDoubles> phi;
        solve(multigrid, b, phi);
        // The ends by the boundary's resistance, as on a grid.
        const auto end = [&](const char* boundary, std::size_t i) {
            const double A = row.at(boundary);
            const BandFloats D(float(at(i, "D1", "D2")));
            return phi[number(i)][0] * 2. * A / boundary_resistance(A, 0.5 * h, D).value[0];
        };
        const double left = end("A0", 0), right = end("A1", n - 1);
        const std::string where = fmt::format("slab {:g} + {:g}", L1, L2 - L1);
        for (std::size_t k = 0; k < row.at("x").size(); ++k) {
            const double x = row["x"][k], cell = x / h - 0.5;
            double value = x <= 0. ? left : right;
            if (x > 0. && x < L2) {
                // Straight on both sides of the face, with the same flux.
                const std::size_t i = std::size_t(cell);
                const double low = phi[number(i)][0], high = phi[number(i + 1)][0],
                             below = at(i, "D1", "D2"), above = at(i + 1, "D1", "D2"),
                             face = (below * low + above * high) / (below + above),
                             share = 2. * (cell - double(i));
                value =
                    share < 1. ? low + share * (face - low) : face + (share - 1.) * (high - face);
            }
            result.add(fmt::format("{} x {:g}", where, x), value, row.at("phi")[k]);
        }
        result.add(where + " left", 0.5 * left / row.at("A0").get<double>(),
                   row.at("outward_current_left"));
        result.add(where + " right", 0.5 * right / row.at("A1").get<double>(),
                   row.at("outward_current_right"));
    }
}

Mesh box(const Point3f& low, const Point3f& high) {
    Mesh m;
    for (int i = 0; i < 8; ++i)
        m.positions.push_back(
            {i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
    m.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                   {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return m;
}

/// A box so wide that its other sides are dark; a cell is a third of the source's depth.
void half_space(const json& rows, Comparison& result) {
    for (const json& row : rows) {
        const double D = row.at("D"), s = row.at("sa"), A = row.at("A"), z0 = row.at("z0");
        const FreeField free{D, std::sqrt(s / D), 1.};
        const Vec3d source(0., 0., -z0);
        const auto q = [&](const Vec3d& p, const Vec3d& n) {
            const Vec3d d = p - source;
            const double r = length(d);
            return -free(r) - 2. * A * D * free.slope(r) * dot(d, n) / r;
        };
        const Field f =
            solved(box({-20, -20, -20}, {20, 20, 0}), 120., {constant(D), constant(s), {}, q, A});
        const Vec3d up(0, 0, 1);
        for (const json& v : row.at("values")) {
            const double rho = v.at("rho"), z = v.at("z");
            const Vec3d p(rho * 0.8, rho * 0.6, -z);
            const double rest = z > 0. ? f.inside(p) : f.surface(p, up, q(p, up));
            const double phi = free(length(p - source)) + rest;
            const std::string where = fmt::format("half space rho {:g} z {:g}", rho, z);
            result.add(where, phi, v.at("phi_robin"), 2e-2);
            if (v.contains("exitance_robin"))
                result.add(where + " exitance", exitance(A, BandDoubles(phi))[0],
                           v["exitance_robin"], 2e-2);
        }
    }
}

/// A disc as the middle layer of a cylinder, whose cells lose their neighbours above and below.
void disc(const json& rows, Comparison& result) {
    for (const json& row : rows) {
        const double R = row.at("R"), D = row.at("D"), A = row.at("A"), s = row.at("sa"),
                     Q = row.at("Q"), q = row.at("q");
        constexpr std::uint32_t n = 720;
        Mesh rod;
        for (std::uint32_t i = 0; i < n; ++i)
            for (const double z : {-0.1, 0.1})
                rod.positions.push_back({float(R * std::cos(2. * pi * i / n)),
                                         float(R * std::sin(2. * pi * i / n)), float(R * z)});
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % n);
            rod.triangles.insert(rod.triangles.end(), {{a, b, a + 1}, {b, b + 1, a + 1}});
            if (i > 0 && i + 1 < n)
                rod.triangles.insert(rod.triangles.end(), {{0, b, a}, {1, a + 1, b + 1}});
        }
        CellGrid grid(rod, GridFrame::around(rod.bounds(), 100.));
        DiffusionMatter matter{{BandFloats(float(D))}, {BandFloats(float(s))}, A};
        DiffusionProblem problem = make_problem(grid, matter);
        const std::int32_t middle = grid.frame().n[2] / 2;
        const double h = grid.frame().h;
        BandMatrix layer;
        std::vector<CellPlace> places;
        std::vector<std::uint32_t> of(grid.size(), CellGrid::none), cells;
        for (std::uint32_t c = 0; c < grid.size(); ++c) {
            if (grid.place(c)[2] != middle) continue;
            of[c] = std::uint32_t(cells.size());
            cells.push_back(c);
            if (c < grid.even()) layer.even = cells.size();
        }
        std::vector<BandDoubles> b, phi, all(grid.size());
        layer.first.push_back(0);
        for (const std::uint32_t c : cells) {
            places.push_back(grid.place(c));
            const CutCell* cut = grid.cut(c);
            b.push_back(BandDoubles(Q * grid.volume(c) * h * h * h));
            if (cut)
                b.back() += BandDoubles(q) *
                            to_double(problem.conductance[std::size_t(grid.cut_number(c))]);
            layer.reaction.push_back(problem.matrix.reaction[c]);
            for (std::uint32_t e = problem.matrix.first[c]; e < problem.matrix.first[c + 1]; ++e) {
                if (of[problem.matrix.neighbour[e]] == CellGrid::none) continue;
                layer.neighbour.push_back(of[problem.matrix.neighbour[e]]);
                layer.weight.push_back(problem.matrix.weight[e]);
            }
            layer.first.push_back(std::uint32_t(layer.neighbour.size()));
        }
        Multigrid multigrid(std::move(layer), places);
        solve(multigrid, b, phi);
        for (std::size_t i = 0; i < cells.size(); ++i) all[cells[i]] = phi[i];
        const double z = grid.center(cells[0]).z;
        for (std::size_t i = 0; i < row.at("r").size(); ++i) {
            const double r = row["r"][i];
            const Vec3d n_(0.6, 0.8, 0.), p = n_ * r + Vec3d(0., 0., z);
            const double value = r < R
                                     ? fluence(grid, all, p)[0]
                                     : surface_fluence(grid, matter, all, p, n_, BandDoubles(q))[0];
            result.add(fmt::format("disc r {:g}", r), value, row.at("phi")[i]);
        }
    }
}

void manufactured(const json& all, Comparison& result) {
    const json& p = all.at("parameters");
    const double a = p.at("a"), b = p.at("b"), c = p.at("c"), D0 = p.at("D0"), u = p.at("u"),
                 s0 = p.at("s0"), v = p.at("v"), A = p.at("A"), R = p.at("R");
    const Place rest = [&](const Vec3d& x) {
        return std::sin(a * x.x) * std::cos(b * x.y) * std::exp(c * x.z);
    };
    const auto gradient = [&](const Vec3d& x) {
        const double e = std::exp(c * x.z);
        return Vec3d(a * std::cos(a * x.x) * std::cos(b * x.y) * e,
                     -b * std::sin(a * x.x) * std::sin(b * x.y) * e, c * rest(x));
    };
    const Place D = [&](const Vec3d& x) { return D0 * (1. + u * x.x); };
    const Place absorption = [&](const Vec3d& x) { return s0 * (1. + v * x.y); };
    const Place source = [&](const Vec3d& x) {
        return (a * a + b * b - c * c) * D(x) * rest(x) - D0 * u * gradient(x).x +
               absorption(x) * (2. + rest(x));
    };
    const auto q = [&](const Vec3d& x, const Vec3d& n) {
        return 2. + rest(x) + 2. * A * D(x) * dot(gradient(x), n);
    };
    const Field f = solved(ball(R), ball_cells, {D, absorption, source, q, A});
    for (const json& row : all.at("interior")) {
        const Vec3d x = vector_of(row.at("x"));
        const std::string where = fmt::format("manufactured {}", row["x"].dump());
        result.add(where, f.inside(x), row.at("phi"));
        result.add(where + " Q", source(x), row.at("Q"), 1e-9);
    }
    for (const json& row : all.at("surface")) {
        const Vec3d n = vector_of(row.at("normal")), x = vector_of(row.at("x"));
        const std::string where = fmt::format("manufactured surface {}", row["normal"].dump());
        result.add(where, f.surface(x, n, q(x, n)), row.at("phi"));
        result.add(where + " q", q(x, n), row.at("q"), 1e-9);
    }
}

}  // namespace

void compare_diffusion(const json& group, Comparison& result) {
    const auto rows = [&](const char* name) { return group.value(name, json::array()); };
    sphere_uniform(rows("sphere_uniform"), result);
    sphere_point(rows("sphere_point"), result);
    slab(rows("slab_two_layer"), result);
    half_space(rows("halfspace_point"), result);
    disc(rows("disc_2d"), result);
    if (group.contains("manufactured_variable_coefficients"))
        manufactured(group["manufactured_variable_coefficients"], result);
}

}  // namespace nacre
