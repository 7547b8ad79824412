#include "nacre/geometry/mesh_build.h"

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "nacre/math/error.h"

namespace nacre {

Mesh make_rectangle() {
    Mesh mesh;
    mesh.name = "rectangle";
    mesh.positions.reserve(5);
    mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    mesh.normals.assign(4, {0, 0, 1});
    mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh.triangles = {{0, 1, 2}, {2, 3, 0}};
    return mesh;
}

Mesh make_cube() {
    // Right-handed frames s, t, normal give the corners; u and v grow along the axes that Mitsuba 3
    // gives them, which on some sides are mirrored.
    struct Side {
        Vec3f s, t, u, v;
    };
    constexpr Side kSides[] = {{{0, 1, 0}, {0, 0, 1}, {0, 1, 0}, {0, 0, -1}},
                               {{0, 0, 1}, {0, 1, 0}, {0, 1, 0}, {0, 0, 1}},
                               {{0, 0, 1}, {1, 0, 0}, {-1, 0, 0}, {0, 0, -1}},
                               {{1, 0, 0}, {0, 0, 1}, {0, 0, 1}, {1, 0, 0}},
                               {{1, 0, 0}, {0, 1, 0}, {0, 1, 0}, {1, 0, 0}},
                               {{0, 1, 0}, {1, 0, 0}, {0, -1, 0}, {1, 0, 0}}};
    Mesh mesh;
    mesh.name = "cube";
    mesh.positions.reserve(25);
    for (const auto& [s, t, u, v] : kSides) {
        const Vec3f n = cross(s, t);
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (const Vec2f at : {Vec2f{-1, -1}, Vec2f{1, -1}, Vec2f{1, 1}, Vec2f{-1, 1}}) {
            const Point3f p = n + s * at.x + t * at.y;
            mesh.positions.push_back(p);
            mesh.normals.push_back(n);
            mesh.uvs.push_back({(dot(p, u) + 1) / 2, (dot(p, v) + 1) / 2});
        }
        mesh.triangles.push_back({first, first + 1, first + 2});
        mesh.triangles.push_back({first + 2, first + 3, first});
    }
    return mesh;
}

Mesh make_icosphere(int subdivisions) {
    if (subdivisions < 0 || subdivisions > 9)
        throw InputError("icosphere subdivisions must lie between 0 and 9");
    // Twelve vertices (0, +-1, +-golden ratio) and cyclic permutations.
    const double g = std::numbers::phi;
    std::vector<Vec3d> p;
    for (const double a : {-1.0, 1.0})
        for (const double b : {-g, g}) {
            p.push_back({0, a, b});
            p.push_back({a, b, 0});
            p.push_back({b, 0, a});
        }
    for (Vec3d& v : p) v = normalize(v);
    std::vector<Mesh::Triangle> triangles;
    // Faces are the triples at mutual distance of one edge, turned outwards.
    const double edge = 2 / std::sqrt(1 + g * g) + 1e-6;
    for (std::uint32_t i = 0; i < 12; ++i)
        for (std::uint32_t j = i + 1; j < 12; ++j)
            for (std::uint32_t k = j + 1; k < 12; ++k) {
                if (length(p[i] - p[j]) > edge || length(p[j] - p[k]) > edge ||
                    length(p[k] - p[i]) > edge)
                    continue;
                const bool out = dot(cross(p[j] - p[i], p[k] - p[i]), p[i]) > 0;
                triangles.push_back(out ? Mesh::Triangle{i, j, k} : Mesh::Triangle{i, k, j});
            }
    for (int level = 0; level < subdivisions; ++level) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [at, fresh] = middles.try_emplace(std::minmax(a, b), p.size());
            if (fresh) p.push_back(normalize(p[a] + p[b]));
            return at->second;
        };
        std::vector<Mesh::Triangle> finer;
        finer.reserve(triangles.size() * 4);
        for (const auto& [a, b, c] : triangles) {
            const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        triangles = std::move(finer);
    }
    Mesh mesh;
    mesh.name = "icosphere";
    mesh.positions.reserve(p.size() + 1);
    for (const Vec3d& v : p) mesh.positions.emplace_back(v);
    mesh.normals = mesh.positions;
    mesh.triangles = std::move(triangles);
    return mesh;
}

Mesh make_torus(float major, float minor, int around, int across) {
    if (!(major > minor && minor > 0)) throw InputError("torus needs radii major > minor > 0");
    if (around < 3 || across < 3 || std::int64_t{around} * across > (std::int64_t{1} << 30))
        throw InputError("torus needs at least 3 steps each way and at most 2^30 quads");
    const std::size_t count = std::size_t(around) * across;
    Mesh mesh;
    mesh.name = "torus";
    mesh.positions.reserve(count + 1);
    mesh.normals.reserve(count);
    mesh.triangles.reserve(2 * count);
    for (int i = 0; i < around; ++i) {
        const double phi = 2 * std::numbers::pi * i / around;
        for (int j = 0; j < across; ++j) {
            const double psi = 2 * std::numbers::pi * j / across;
            const Vec3d n{std::cos(phi) * std::cos(psi), std::sin(phi) * std::cos(psi),
                          std::sin(psi)};
            const Vec3d middle{major * std::cos(phi), major * std::sin(phi), 0};
            mesh.positions.emplace_back(middle + n * double(minor));
            mesh.normals.emplace_back(n);
            const auto at = [&](int a, int b) {
                return static_cast<std::uint32_t>((a % around) * std::int64_t{across} + b % across);
            };
            mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    }
    return mesh;
}

}  // namespace nacre
