#include "nacre/realtime/visibility.h"

namespace nacre {
namespace {

/// Entries (triangle, tile of 64 x 64 pixels) of large triangles. A triangle that finds no room is
/// drawn by its own thread: slower, not wrong.
constexpr std::uint32_t tile_capacity = 1u << 18;
constexpr std::size_t tile_header = 8;  // numbers before the entries: count, workgroups, ...

}  // namespace

Visibility::Visibility() = default;
Visibility::~Visibility() = default;
Visibility::Visibility(Visibility&&) noexcept = default;
Visibility& Visibility::operator=(Visibility&&) noexcept = default;

void Visibility::see(Gpu& gpu, const GpuScene& scene, std::uint32_t triangles, const View& view,
                     VisibilityMethod, std::string_view pass) {
    if (!depth_.is(view.width, view.height)) {
        depth_ = Texture(TexelFormat::r32ui, view.width, view.height);
        ids_ = Texture(TexelFormat::r32ui, view.width, view.height);
    }
    see_by_compute(gpu, scene, triangles, view, pass);
}

void Visibility::see_by_compute(Gpu& gpu, const GpuScene& scene, std::uint32_t triangles,
                                const View& view, std::string_view pass) {
    if (!tiles_.bytes())
        tiles_ = Buffer((tile_header + 2 * tile_capacity) * sizeof(std::uint32_t), nullptr);
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
                .set("capacity", tile_capacity)
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
