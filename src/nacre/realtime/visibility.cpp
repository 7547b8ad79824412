#include "nacre/realtime/visibility.h"

namespace nacre {
namespace {

/// Numbers before the entries (triangle, tile of 64 x 64 pixels): count, workgroups, ...
constexpr std::size_t tile_header = 8;

}  // namespace

void Visibility::see(Gpu& gpu, const GpuScene& scene, std::uint32_t triangles, const View& view,
                     VisibilityMethod method, std::string_view pass) {
    if (!depth_.is(view.width, view.height)) {
        depth_ = Texture(TexelFormat::r32ui, view.width, view.height);
        ids_ = Texture(TexelFormat::r32ui, view.width, view.height);
        drop_target();
    }
    if (method == VisibilityMethod::raster) return see_by_raster(gpu, scene, triangles, view, pass);
    see_by_compute(gpu, scene, triangles, view, pass);
}

void Visibility::see_by_compute(Gpu& gpu, const GpuScene& scene, std::uint32_t triangles,
                                const View& view, std::string_view pass) {
    if (!tiles_.bytes())
        tiles_ = Buffer((tile_header + 2 * tile_capacity_) * sizeof(std::uint32_t), nullptr);
    gpu.compute(pass, gpu.program("visibility_clear.glsl"))
        .writes(0, depth_)
        .writes(1, ids_)
        .writes(2, tiles_)
        .threads(view.width, view.height);
    for (const char* step : {"STEP=0", "STEP=1"}) {
        const auto with = [&](ComputePass p) {
            p.reads(0, scene.positions())
                .reads(1, scene.indices())
                .writes(2, tiles_)
                .writes(0, depth_)
                .writes(1, ids_)
                .set("clip", view.clip)
                .set("capacity", tile_capacity_)
                .set("triangles", triangles);
            return p;
        };
        with(gpu.compute(pass, gpu.program("visibility.glsl", step))).threads(int(triangles));
        with(gpu.compute(pass, gpu.program("visibility_tiles.glsl", step)))
            .groups_of(tiles_, sizeof(std::uint32_t));
    }
}

std::size_t Visibility::bytes() const { return depth_.bytes() + ids_.bytes() + tiles_.bytes(); }

}  // namespace nacre
