// Which triangle is seen where: by rays, by the compute rasteriser and by the raster unit.
#include "tests/realtime/frames.h"

namespace nacre {
namespace {

class VisibilityTest : public Frames {
  protected:
    /// A floor that goes on behind the camera, a ball, and a cube whose faces are large triangles.
    std::string things() const {
        return xml::shape("rectangle",
                          "<transform name=\"to_world\"><rotate x=\"1\" angle=\"-90\"/>"
                          "<scale value=\"400\"/></transform>") +
               xml::sphere({0, 2, 0}, 2, "") +
               xml::shape("cube",
                          "<transform name=\"to_world\"><rotate y=\"1\" angle=\"30\"/>"
                          "<translate x=\"-3\" y=\"1\" z=\"2\"/></transform>" +
                              xml::flag("face_normals", true));
    }
    struct Seen {
        std::vector<std::uint32_t> depth, ids;
    };
    Seen seen(const GpuScene& on_device, const View& view, VisibilityMethod method,
              std::uint32_t tiles = 1u << 20) {
        Visibility v(tiles);
        v.see(gpu(), on_device, on_device.triangles(), view, method, "test");
        return {v.depth().read_integers(), v.ids().read_integers()};
    }
    static std::uint32_t part_at(const GpuScene& s, std::uint32_t id) {
        const std::uint32_t triangle = ~id;
        for (std::uint32_t i = 0; i < s.shapes().size(); ++i)
            if (triangle - s.shapes()[i].first_triangle < s.shapes()[i].triangles)
                return s.shapes()[i].shape;
        return ~0u;
    }
    /// Pixels at which what is seen differs from what a ray through their middle meets.
    int wrong(const Scene& s, VisibilityMethod method) {
        const GpuScene on_device(gpu(), s, {});
        const View view = camera_of(s, on_device);
        const Seen v = seen(on_device, view, method);
        int count = 0;
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x) {
                const Ray ray = s.camera->ray({(float(x + s.film.crop_x) + 0.5f) / s.film.width,
                                               (float(y + s.film.crop_y) + 0.5f) / s.film.height},
                                              {0.5f, 0.5f});
                const auto hit = s.rays.intersect(ray);
                const std::size_t i = std::size_t(y) * view.width + x;
                bool same = hit.has_value() == (v.ids[i] != 0);
                if (same && hit) {
                    same = part_at(on_device, v.ids[i]) == hit->shape;
                    // Of a perspective camera z/w is near over the distance along the axis.
                    const Vec3f p = ray.o + ray.d * hit->t;
                    const Mat4& m = view.clip;
                    const float z = m[2] * p.x + m[6] * p.y + m[10] * p.z + m[14],
                                w = m[3] * p.x + m[7] * p.y + m[11] * p.z + m[15];
                    // The ball is tessellated, within a thousandth of its radius.
                    same = same && std::abs(std::bit_cast<float>(v.depth[i]) / (z / w) - 1) < 0.01f;
                }
                count += !same;
            }
        return count;
    }
};

/// But for pixels on outlines, whose number the ball's tessellation bounds: an outline of some 400
/// pixels, each shifted by at most a thousandth of a radius of 60 pixels.
TEST_F(VisibilityTest, IsThatOfRays) {
    for (const std::string& camera :
         {sensor({3, 5, 12}, {0, 1, 0}, 240, 180),
          sensor({3, 5, 12}, {0, 1, 0}, 240, 180, 60,
                 "<float name=\"principal_point_offset_x\" value=\"0.2\"/>"),
          sensor({-3, 1.2, 4.5}, {0, 1, 0}, 200, 200, 70)}) {
        const Scene s = scene(camera + things());
        for (const auto method : {VisibilityMethod::compute, VisibilityMethod::raster})
            EXPECT_LE(wrong(s, method), 45) << camera;
    }
}

TEST_F(VisibilityTest, OfCropWindowsAndParallelRays) {
    Scene s = scene(sensor({3, 5, 12}, {0, 1, 0}, 240, 180) + things());
    s.film.crop_x = 70;
    s.film.crop_y = 31;
    s.film.crop_width = 97;
    s.film.crop_height = 60;
    for (const auto method : {VisibilityMethod::compute, VisibilityMethod::raster})
        EXPECT_LE(wrong(s, method), 25);
    const Scene parallel = scene(
        "<sensor type=\"orthographic\"><transform name=\"to_world\"><lookat origin=\"3, 5, 12\" "
        "target=\"0, 1, 0\" up=\"0, 1, 0\"/><scale value=\"5\"/></transform>"
        "<film type=\"hdrfilm\"><integer name=\"width\" value=\"200\"/>"
        "<integer name=\"height\" value=\"200\"/></film></sensor>" +
        things());
    const GpuScene on_device(gpu(), parallel, {});
    const View view = camera_of(parallel, on_device);
    EXPECT_TRUE(view.parallel);
    const Seen v = seen(on_device, view, VisibilityMethod::compute);
    int differ = 0;
    for (int y = 0; y < 200; ++y)
        for (int x = 0; x < 200; ++x) {
            const Ray ray =
                parallel.camera->ray({(x + 0.5f) / 200, (y + 0.5f) / 200}, {0.5f, 0.5f});
            const auto hit = parallel.rays.intersect(ray);
            const std::uint32_t id = v.ids[std::size_t(y) * 200 + x];
            differ += hit.has_value() != (id != 0) || (hit && part_at(on_device, id) != hit->shape);
        }
    EXPECT_LE(differ, 45);
}

/// The two paths: the same triangles but where a pixel's middle lies on an edge, the same depths.
TEST_F(VisibilityTest, ByComputeAndByTheRasterUnit) {
    const Scene s = scene(sensor({3, 5, 12}, {0, 1, 0}, 256, 256) + things());
    const GpuScene on_device(gpu(), s, {});
    const View view = camera_of(s, on_device);
    const Seen a = seen(on_device, view, VisibilityMethod::compute),
               b = seen(on_device, view, VisibilityMethod::raster);
    int ids = 0, depths = 0;
    for (std::size_t i = 0; i < a.ids.size(); ++i) {
        ids += a.ids[i] != b.ids[i];
        const float p = std::bit_cast<float>(a.depth[i]), q = std::bit_cast<float>(b.depth[i]);
        depths += std::abs(p - q) > 1e-4f * std::max(p, q) + 1e-6f;
    }
    EXPECT_LE(ids, 256 * 256 / 200);
    EXPECT_LE(depths, 30);
}

/// An edge that two triangles share: no pixel falls between them, and none is left out of a closed
/// surface, however it is turned.
TEST_F(VisibilityTest, LeavesNoCracks) {
    for (int turn = 0; turn < 8; ++turn) {
        const Scene s =
            scene(sensor({0, 0, 10}, {0, 0, 0}, 300, 300, 40) + xml::sphere({0, 0, 0}, 3.3, "") +
                  xml::shape("cube", fmt::format("<transform name=\"to_world\"><rotate x=\"1\" "
                                                 "y=\"0.3\" z=\"0.7\" angle=\"{}\"/><scale "
                                                 "value=\"1.5\"/></transform>",
                                                 11 + 40 * turn)));
        const GpuScene on_device(gpu(), s, {});
        const View view = camera_of(s, on_device);
        const Seen v = seen(on_device, view, VisibilityMethod::compute);
        for (int y = 70; y < 230; ++y)
            for (int x = 70; x < 230; ++x) {
                const float dx = float(x) - 149.5f, dy = float(y) - 149.5f;
                if (dx * dx + dy * dy > 70 * 70) continue;
                ASSERT_NE(v.ids[std::size_t(y) * 300 + x], 0u) << x << ", " << y;
                // The near side: 3.3 before the middle at most, never the far wall.
                const float distance =
                    view.depth_range / std::bit_cast<float>(v.depth[std::size_t(y) * 300 + x]);
                ASSERT_LT(distance, 10.f) << x << ", " << y;
            }
    }
}

/// More tiles of large triangles than there is room for are drawn all the same.
TEST_F(VisibilityTest, LargeTrianglesInPlenty) {
    // Two triangles each of 40 squares, in a view of 4 x 4 tiles.
    auto mesh = std::make_shared<Mesh>();
    for (std::uint32_t i = 0; i < 40; ++i) {
        const float z = -1.f - 0.1f * float(i);
        for (const auto& [x, y] : {std::pair{-9.f, -9.f}, {9.f, -9.f}, {9.f, 9.f}, {-9.f, 9.f}})
            mesh->positions.push_back({x, y, z});
        mesh->triangles.push_back({4 * i, 4 * i + 1, 4 * i + 2});
        mesh->triangles.push_back({4 * i, 4 * i + 2, 4 * i + 3});
    }
    mesh->positions.reserve(mesh->positions.size() + 1);
    Scene s = scene(sensor({0, 0, 5}, {0, 0, 0}, 240, 240) + xml::sphere({0, 0, 0}, 1, ""));
    s.rays = RayScene();
    s.rays.add(mesh);
    s.rays.build();
    const GpuScene on_device(gpu(), s, {});
    const View view = camera_of(s, on_device);
    for (const std::uint32_t tiles : {1u << 20, 100u, 1u}) {
        const Seen v = seen(on_device, view, VisibilityMethod::compute, tiles);
        EXPECT_EQ(std::ranges::count_if(v.ids, [](std::uint32_t id) { return ~id > 1u; }), 0)
            << "the nearest square is the first; room for " << tiles << " tiles";
    }
}

}  // namespace
}  // namespace nacre
