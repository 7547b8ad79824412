#pragma once
// Frames of a scene in real time: the passes that all techniques share, and theirs in between.
#include <map>
#include <memory>
#include <vector>

#include "nacre/realtime/realtime_technique.h"
#include "nacre/realtime/visibility.h"

namespace nacre {

struct FrameOptions {
    std::uint32_t index = 0;  ///< numbers the frames of an average: places on lamps, samples
    int light_points = 8;     ///< of lamps with extent, all together
    int light_view = 512;     ///< width of a light's picture; a power of 2
};

/// Belongs to the context that is current when it is made, and is used only while it is current.
class FrameRenderer {
  public:
    /// `shapes`: each with its technique, which has a `realtime`, or none. `scene` and `gpu`
    /// outlive it. Throws InputError for what techniques refuse, Stopped if `work` says so.
    FrameRenderer(Gpu& gpu, const Scene& scene, std::vector<ShapeTechnique> shapes,
                  const Work& work = {});
    ~FrameRenderer();

    /// The scene changed in these parts.
    void changed(const Changes& what, const Work& work = {});
    /// Other techniques, or others of their options, for the same translucent shapes. Throws
    /// InputError as the constructor does; the frames are then those of no technique.
    void set_techniques(std::vector<ShapeTechnique> shapes, const Work& work = {});
    void deform(const Deformation& deformation) { scene_.deform(gpu_, deformation); }
    /// How visibility is found, of all views from now on.
    void set_visibility(VisibilityMethod method) { visibility_ = method; }

    /// A frame: rgba32f of the view's size; linear RGB radiance, alpha = 1 where a shape is.
    /// Valid until the next.
    const Texture& render(const View& view, const FrameOptions& options = {});

    const GpuScene& scene() const { return scene_; }
    std::size_t bytes() const;  ///< of the device

  private:
    struct Part;
    void make_parts(const Work& work);
    void resize(const View& view, int light_view);
    void see(const View& view);
    void light(const CameraSurface& camera, Part& part, const LightPoint& point,
               const FrameOptions& options, bool first, bool last);
    void compose(const View& view);
    std::vector<LightPoint> lights_at(const Point3f& middle, const FrameOptions& options);

    Gpu& gpu_;
    std::vector<ShapeTechnique> techniques_;
    GpuScene scene_;
    std::vector<std::unique_ptr<Part>> parts_;
    VisibilityMethod visibility_ = VisibilityMethod::compute;
    Visibility camera_, lit_;
    Texture position_, normal_, lit_image_, below_, frame_, transmittance_;
    Texture light_position_, light_entered_;
    struct Falloff {
        LightShape shape;
        Texture texture;  ///< unless it is even
    };
    std::map<const Light*, Falloff> falloffs_;  ///< of lights without extent; until lights change
};

}  // namespace nacre
