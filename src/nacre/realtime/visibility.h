#pragma once
// Which triangle is seen at each pixel, by a rasteriser in compute shaders. On devices with many
// compute units and few raster units it is the faster, in software too.
#include "nacre/realtime/gpu_scene.h"
#include "nacre/realtime/view.h"

namespace nacre {

enum class VisibilityMethod { compute, raster };

/// Depth and triangle of each pixel of a view.
class Visibility {
  public:
    Visibility();
    ~Visibility();
    Visibility(Visibility&&) noexcept;
    Visibility& operator=(Visibility&&) noexcept;

    /// Of the first `triangles` of the scene. Both sides of triangles are seen; where two are
    /// equally near, the one with the smaller number.
    void see(Gpu& gpu, const GpuScene& scene, std::uint32_t triangles, const View& view,
             VisibilityMethod method, std::string_view pass);

    const Texture& depth() const { return depth_; }  ///< r32ui: bits of z/w; 0: nothing
    const Texture& ids() const { return ids_; }      ///< r32ui: triangle + 1; 0: nothing
    std::size_t bytes() const;

  private:
    void see_by_compute(Gpu& gpu, const GpuScene& scene, std::uint32_t triangles, const View& view,
                        std::string_view pass);

    Texture depth_, ids_;
    Buffer tiles_;  // what of large triangles is to be drawn by whole workgroups
};

}  // namespace nacre
