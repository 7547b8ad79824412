// Fibres that stand on a floor, as of velvet.
#include <cmath>
#include <numbers>

#include "nacre/goniometer/microgeometry.h"
#include "nacre/math/frame.h"
#include "nacre/math/random.h"

namespace nacre {
namespace {

constexpr double pi = std::numbers::pi;

/// A prism about the axis from `foot` to `tip`, closed at the tip.
void add_fibre(Mesh& mesh, const Vec3d& foot, const Vec3d& tip, double radius, int sides) {
    const auto frame = Frame<double>::around(normalize(tip - foot));
    const auto first = std::uint32_t(mesh.positions.size());
    for (const Vec3d& end : {foot, tip})
        for (int k = 0; k < sides; ++k) {
            const double phi = 2. * pi * k / sides;
            mesh.positions.push_back(Point3f(end + frame.s * (radius * std::cos(phi)) +
                                             frame.t * (radius * std::sin(phi))));
        }
    mesh.positions.push_back(Point3f(tip));
    const auto n = std::uint32_t(sides), top = first + 2 * n;
    for (std::uint32_t k = 0; k < n; ++k) {
        const std::uint32_t a = first + k, b = first + (k + 1) % n;
        mesh.triangles.push_back({a, b, b + n});
        mesh.triangles.push_back({a, b + n, a + n});
        mesh.triangles.push_back({a + n, b + n, top});
    }
}

Microgeometry make_fibres(const ParameterValues& v) {
    const double spacing = v.number("spacing"), length = v.number("length"),
                 lean = std::tan(v.number("lean") * pi / 180.),
                 spread = std::tan(v.number("spread") * pi / 180.);
    const int side = v.whole("fibres"), sides = v.whole("sides");
    const double period = side * spacing;
    Microgeometry g{.mesh = {}, .width = period, .height = period};
    g.mesh.name = "fibres";
    Random random(stream_key(std::uint64_t(v.whole("seed")), 0x66696272));
    // How far a fibre may reach beyond its foot: there it stands in the neighbouring tile too.
    const double reach = length + 2.;
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) {
            const Vec2f place = random.next2(), u = random.next2();
            const Vec3d foot{(i + double(place.x)) * spacing, (j + double(place.y)) * spacing, -1.};
            const double r = spread * std::sqrt(-2. * std::log(1. - double(u.x)));
            const Vec3d axis = normalize(Vec3d{lean + r * std::cos(2. * pi * double(u.y)),
                                               r * std::sin(2. * pi * double(u.y)), 1.});
            const double long_enough = length * (1. - v.number("uneven") * double(random.next()));
            const Vec3d whole = axis * (long_enough + 1. / axis.z);
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx) {
                    const Vec3d at = foot + Vec3d{dx * period, dy * period, 0.};
                    if (at.x > -reach && at.x < period + reach && at.y > -reach &&
                        at.y < period + reach)
                        add_fibre(g.mesh, at, at + whole, 1., sides);
                }
        }
    const auto first = std::uint32_t(g.mesh.positions.size());
    for (double y : {-0.1 * period, 1.1 * period})
        for (double x : {-0.1 * period, 1.1 * period})
            g.mesh.positions.push_back({float(x), float(y), 0.f});
    g.mesh.triangles.push_back({first, first + 1, first + 3});
    g.mesh.triangles.push_back({first, first + 3, first + 2});
    g.mesh.positions.reserve(g.mesh.positions.size() + 1);
    return g;
}

}  // namespace

const MicrogeometryDescription fibre_geometry{
    .name = "fibres",
    .title = "Standing fibres",
    .meaning = "thin cylinders that stand on a floor, as of velvet; lengths in their radii",
    .parameters = {{.name = "spacing",
                    .meaning = "so many square radii, squared, have one fibre",
                    .unit = "radii",
                    .low = 2.,
                    .high = 1000.,
                    .otherwise = 8.},
                   {.name = "length",
                    .meaning = "of a fibre above the floor",
                    .unit = "radii",
                    .low = 0.1,
                    .high = 1000.,
                    .otherwise = 40.},
                   {.name = "uneven", .meaning = "the shortest are shorter by this share"},
                   {.name = "lean",
                    .meaning = "of all fibres towards x, from upright",
                    .unit = "degrees",
                    .high = 80.},
                   {.name = "spread",
                    .meaning = "of the directions, a standard deviation along one axis",
                    .unit = "degrees",
                    .high = 60.,
                    .otherwise = 10.},
                   {.name = "fibres",
                    .meaning = "of a period, along one side",
                    .kind = ParameterKind::integer,
                    .low = 1.,
                    .high = 1000.,
                    .otherwise = 24.},
                   {.name = "sides",
                    .meaning = "of a fibre",
                    .kind = ParameterKind::integer,
                    .low = 3.,
                    .high = 1000.,
                    .otherwise = 12.},
                   {.name = "seed",
                    .meaning = "of its random numbers",
                    .kind = ParameterKind::integer,
                    .high = 1e9}},
    .references = {"S. H. Westin, J. R. Arvo, K. E. Torrance 1992, Predicting Reflectance "
                   "Functions from Complex Surfaces, SIGGRAPH 92"},
    .make = make_fibres,
};

}  // namespace nacre
