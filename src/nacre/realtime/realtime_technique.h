#pragma once
// What a real-time technique is: what it makes of the passes that all share, on the device. A frame
// is made of (frame_renderer.h)
//
//   camera visibility -> position and normal of each pixel
//   for each translucent shape, each light: light view -> what enters, at its texels and at the
//       camera's pixels -> the technique's share of that light
//   the technique's share of all lights together -> composed with reflections, other shapes and
//       the background
//
// A technique fills `below`: the radiance that emerges at each of its shape's pixels, over the
// boundary's transmittance towards the viewer, as Translucency::emerge does on the processor.
#include <memory>
#include <string_view>

#include "nacre/realtime/gpu_scene.h"
#include "nacre/realtime/light_points.h"
#include "nacre/realtime/view.h"
#include "nacre/render/object_boundary.h"

namespace nacre {

/// What a technique is made for: one translucent shape.
struct RealtimeInput {
    Gpu& gpu;
    const GpuScene& scene;
    std::uint32_t part;  ///< of GpuScene::shapes
    const ParameterValues& options;
    std::string_view profile;
    const ObjectBoundary& boundary;
    const Work& work;

    const Scene& of() const { return scene.scene(); }
    const ShapeBinding& shape() const { return of().shapes[scene.shapes()[part].shape]; }
    const Medium& medium() const { return *shape().interior; }
    /// 1 over the boundary's mean transmittance (or 1, where the option `exit_fresnel` says
    /// `paper`), over pi: from radiant exitance to what `below` holds.
    float exit_scale() const;
};

/// The camera's picture: what is seen at each pixel.
struct CameraSurface {
    const View& view;
    const Texture&
        position;           ///< rgba32f: xyz, w = part of GpuScene::shapes + 1; 0 where nothing is
    const Texture& normal;  ///< rgba32f: xyz, unit; w unused
    /// rgba32f: rgb = irradiance that passed the boundary (translucent pixels) from all lights so
    /// far; opaque pixels: their radiance.
    const Texture& lit;
    std::uint32_t frame = 0;  ///< number of the frame: whoever draws numbers may shift them by it
};

/// One light's picture of one shape. Textures have all levels down to one texel, each a plain mean
/// of four texels of the level before.
struct LightSurface {
    const View& view;
    const LightPoint& light;
    const Texture& position;  ///< rgba32f: xyz times coverage; w = coverage by the shape
    /// rgba32f: xyz = unit normal times coverage; w = power that passes the boundary within the
    /// texel (a mean over levels, so 4^level times that is within a texel of a level), for a light
    /// that gives an irradiance of 1 at the object's middle: times light.color.
    const Texture& entered;
    const Texture& depth;  ///< r32ui: bits of z/w of all that can stand in the way
};

class RealtimeTechnique {
  public:
    virtual ~RealtimeTechnique() = default;
    /// Adds one light's share to `below` (rgba32f, an image of the camera's size, zero at first).
    virtual void add_light(const CameraSurface&, const LightSurface&, const Texture& below) {
        (void)below;
    }
    /// Adds what comes of all lights together, after the last.
    virtual void finish(const CameraSurface&, const Texture& below) { (void)below; }
    /// Device memory beyond the shared passes'.
    virtual std::size_t bytes() const { return 0; }
};

}  // namespace nacre
