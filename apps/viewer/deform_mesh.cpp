// The bends of realtime/shaders/deform.glsl, for who shows or saves the bent object without the
// device: the truth beside it, scene files.
#include <cmath>
#include <numbers>

#include "apps/viewer/scene_edits.h"
#include "nacre/scene/subsurface.h"

namespace nacre::viewer {
namespace {

struct Bend {
    Deformation d;
    Vec3f low, size;

    Point3f operator()(const Point3f& p) const {
        using Kind = Deformation::Kind;
        const Vec3f middle = low + size * 0.5f, from = p - middle;
        const float height = (p.y - low.y) / size.y;  // 0 at the foot, 1 at the top
        switch (d.kind) {
            case Kind::none:
                break;
            case Kind::twist: {
                const float a = d.amount * (height - 0.5f) * std::cos(d.phase), c = std::cos(a),
                            s = std::sin(a);
                return middle + Vec3f{c * from.x + s * from.z, from.y, -s * from.x + c * from.z};
            }
            case Kind::bend: {
                const float a = d.amount * std::cos(d.phase);
                if (std::abs(a) < 1e-4f) break;
                const float radius = size.y / a, angle = a * height;
                return {middle.x + radius - (radius - from.x) * std::cos(angle),
                        low.y + (radius - from.x) * std::sin(angle), p.z};
            }
            case Kind::breathe: {
                const float swell =
                    d.amount * std::sin(d.phase) *
                    std::sin(std::numbers::pi_v<float> * std::min(std::max(height, 0.f), 1.f));
                return middle + Vec3f{from.x * (1 + swell), from.y, from.z * (1 + swell)};
            }
        }
        return p;
    }
};

std::shared_ptr<Mesh> bent(const Mesh& rest, const Bend& bend) {
    auto mesh = std::make_shared<Mesh>(rest);
    mesh->positions.reserve(mesh->positions.size() + 1);  // for Embree
    const float h = 1e-3f * std::max({bend.size.x, bend.size.y, bend.size.z});
    for (std::size_t i = 0; i < rest.normals.size(); ++i) {
        // Two tangents, carried along by differences.
        const Point3f& p = rest.positions[i];
        const Vec3f& n = rest.normals[i];
        const Vec3f t = normalize(std::abs(n.x) > 0.5f ? Vec3f{n.y, -n.x, 0.f}
                                                       : Vec3f{0.f, n.z, -n.y}),
                    b = cross(n, t);
        mesh->normals[i] =
            normalize(cross(bend(p + t * h) - bend(p - t * h), bend(p + b * h) - bend(p - b * h)));
    }
    for (Point3f& p : mesh->positions) p = bend(p);
    return mesh;
}

}  // namespace

SceneMeshes deformed(const Scene& scene, const SceneMeshes& meshes, const Deformation& deformation,
                     int* left_out) {
    if (left_out) *left_out = 0;
    SceneMeshes result = meshes;
    if (deformation.kind == Deformation::Kind::none) return result;
    Box3f box;
    for (std::uint32_t i = 0; i < scene.shapes.size(); ++i)
        if (is_translucent(scene.shapes[i]))
            box.extend(meshes[i] ? meshes[i]->bounds() : scene.rays.bounds(i));
    const Bend bend{deformation, box.lower, box.diagonal()};
    for (std::uint32_t i = 0; i < scene.shapes.size(); ++i) {
        if (!is_translucent(scene.shapes[i])) continue;
        if (meshes[i])
            result[i] = bent(*meshes[i], bend);
        else if (left_out)
            ++*left_out;
    }
    return result;
}

}  // namespace nacre::viewer
