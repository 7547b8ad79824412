// The drape: a cloth over a ball, which hangs from it in folds to the floor.
#include <cmath>
#include <numbers>

#include "nacre/geometry/figure.h"

namespace nacre {
namespace {

// mm: the ball, its middle above the floor, and where the cloth leaves it.
constexpr double pi = std::numbers::pi, ball = 60., middle = 97., leaves = 78. * pi / 180.,
                 on_ball = ball * leaves;

double smooth_step(double x) {
    x = std::clamp(x, 0., 1.);
    return x * x * (3. - 2. * x);
}

/// Where the cloth's point lies that is `s` from its middle towards `phi`.
Vec3d place(double s, double phi) {
    const double angle = std::min(s / ball, leaves), hangs = std::max(0., s - on_ball);
    const double r = ball * std::sin(angle) + hangs * std::cos(leaves);
    const double y = middle + ball * std::cos(angle) - hangs * std::sin(leaves);
    // Uneven folds, from where the ball is steep on, ever deeper.
    const double fold = 0.7 * std::cos(8. * phi + 0.9 * std::sin(2. * phi + 0.6)) +
                        0.3 * std::cos(5. * phi + 1.3 + 0.7 * std::sin(phi));
    const double deep = 0.2 * smooth_step((s - 0.55 * on_ball) / (1.45 * on_ball));
    const double around = r * (1. + deep * fold);
    return {around * std::sin(phi), y, around * std::cos(phi)};
}

double length_to_floor() { return on_ball + (middle + ball * std::cos(leaves)) / std::sin(leaves); }

}  // namespace

Mesh make_drape(float resolution_mm) {
    const double end = length_to_floor();
    const int rings = std::max(2, int(std::ceil(end / resolution_mm)));
    const int around = std::max(16, int(std::ceil(2. * pi * ball * 1.3 / resolution_mm)));
    Mesh mesh;
    mesh.name = "drape";
    const auto add = [&](double s, double phi) {
        // Differences across a hundredth of a millimetre; the middle is a pole of s and phi only.
        const double h = 0.01, from = std::max(s, h);
        const Vec3d along = place(from + h, phi) - place(from - h, phi);
        const Vec3d beside = place(from, phi + h / from) - place(from, phi - h / from);
        mesh.positions.push_back(Point3f(place(s, phi)));
        mesh.normals.push_back(s > 0. ? Vec3f(normalize(cross(along, beside)))
                                      : Vec3f{0.f, 1.f, 0.f});
        // Threads of the flat cloth run along u and v.
        mesh.uvs.push_back({float(0.5 + 0.5 * s / end * std::sin(phi)),
                            float(0.5 - 0.5 * s / end * std::cos(phi))});
    };
    mesh.positions.reserve(std::size_t(rings) * around + 2);
    add(0., 0.);
    for (int i = 1; i <= rings; ++i)
        for (int k = 0; k < around; ++k) add(end * i / rings, 2. * pi * k / around);
    const auto at = [&](int ring, int k) {
        return ring == 0 ? 0u : std::uint32_t(1 + (ring - 1) * around + k % around);
    };
    for (int i = 0; i < rings; ++i)
        for (int k = 0; k < around; ++k) {
            mesh.triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
            if (i > 0) mesh.triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
        }
    return mesh;
}

}  // namespace nacre
