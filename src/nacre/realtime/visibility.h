#pragma once
// Which triangle is seen at each pixel, by a rasteriser in compute shaders. On devices with many
// compute units and few raster units it is the faster, in software too; the raster unit is there for
// others, and to check it.
#include <memory>

#include "nacre/realtime/gpu_scene.h"
#include "nacre/realtime/view.h"

namespace nacre {

enum class VisibilityMethod { compute, raster };

struct RasterTarget;  ///< what the raster unit draws into

/// Depth and triangle of each pixel of a view.
class Visibility {
  public:
    /// `tiles`: room for so many tiles of 64 x 64 pixels of large triangles: 4096 triangles that fill
    /// 1024 x 1024 pixels. What finds none is drawn by a thread of its own, but slower (and software
    /// ends loops after 65,535 steps, so that no more pixels than that of it are).
    explicit Visibility(std::uint32_t tiles = 1u << 20);
    ~Visibility();
    Visibility(Visibility&&) noexcept;
    Visibility& operator=(Visibility&&) noexcept;

    /// Of the first `triangles` of the scene. Both sides of triangles are seen; where two are
    /// equally near, the one with the smaller number.
    void see(Gpu& gpu, const GpuScene& scene, std::uint32_t triangles, const View& view,
             VisibilityMethod method, std::string_view pass);

    const Texture& depth() const { return depth_; }  ///< r32ui: bits of z/w; 0: nothing
    const Texture& ids() const {
        return ids_;
    }  ///< r32ui: complement of the triangle's number; 0: nothing
    std::size_t bytes() const;

  private:
    void see_by_raster(Gpu& gpu, const GpuScene& scene, std::uint32_t triangles, const View& view,
                       std::string_view pass);
    void see_by_compute(Gpu& gpu, const GpuScene& scene, std::uint32_t triangles, const View& view,
                        std::string_view pass);

    Texture depth_, ids_;
    void drop_target();

    std::unique_ptr<RasterTarget> target_;
    std::uint32_t tile_capacity_;
    Buffer tiles_;  // what of large triangles is to be drawn by whole workgroups
};

}  // namespace nacre
