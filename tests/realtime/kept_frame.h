#pragma once
// Frames of a technique together with all that it was given, read back.
#include "nacre/bssrdf/profile.h"
#include "tests/realtime/frames.h"

namespace nacre {

const TechniqueDescription& image_space_technique();
const TechniqueDescription& screen_diffusion_technique();
const TechniqueDescription& separable_technique();
const TechniqueDescription& thickness_trick_technique();

struct KeptLight {
    View view;
    LightPoint point;
    std::vector<float> position, entered;
};
struct KeptFrame {
    View camera;
    std::vector<float> position, normal, lit, below;
    std::vector<KeptLight> lights;

    Vec3d at(const std::vector<float>& picture, int x, int y) const {
        const float* p = &picture[4 * std::size_t(y * camera.width + x)];
        return {p[0], p[1], p[2]};
    }
};

/// Passes everything on to another technique and keeps what passed.
class FrameKeeper final : public RealtimeTechnique {
  public:
    FrameKeeper(std::unique_ptr<RealtimeTechnique> inner, KeptFrame& kept)
        : inner_(std::move(inner)), kept_(kept) {}
    void add_light(const CameraSurface& camera, const LightSurface& light,
                   const Texture& below) override {
        inner_->add_light(camera, light, below);
        kept_.lights.push_back(
            {light.view, light.light, light.position.read(), light.entered.read()});
    }
    void finish(const CameraSurface& camera, const Texture& below) override {
        inner_->finish(camera, below);
        kept_.camera = camera.view;
        kept_.position = camera.position.read();
        kept_.normal = camera.normal.read();
        kept_.lit = camera.lit.read();
        kept_.below = below.read();
    }

  private:
    std::unique_ptr<RealtimeTechnique> inner_;
    KeptFrame& kept_;
};

class KeptFrames : public Frames {
  public:
    using Frames::point_light;
    using Frames::sensor;
    using Frames::translucent;

  protected:
    /// Frames 0, 1, ... of the scene by one technique.
    template <const TechniqueDescription& (*technique)()>
    std::vector<KeptFrame> keep(const Scene& s, const Settings& options = {}, int frames = 1,
                                int light_view = 128) {
        // A plain function makes techniques: where to keep frames is passed beside it.
        static thread_local KeptFrame* place;
        KeptFrame frame;
        place = &frame;
        TechniqueDescription keeping = technique();
        keeping.realtime = [](const RealtimeInput& in) -> std::unique_ptr<RealtimeTechnique> {
            return std::make_unique<FrameKeeper>(technique().realtime(in), *place);
        };
        FrameRenderer renderer(gpu(), s, shapes_of(s, keeping, options));
        std::vector<KeptFrame> all;
        for (int i = 0; i < frames; ++i) {
            frame = {};
            renderer.render(camera_of(s, renderer.scene()),
                            {.index = std::uint32_t(i), .light_view = light_view});
            all.push_back(frame);
        }
        return all;
    }
    /// R of `translucent()` in a band.
    static std::unique_ptr<RadialProfile> profile_of(int band) {
        const double s[] = {1, 0.7, 2}, a[] = {0.02, 0.05, 0.03};
        return make_profile("dipole", ProfileMedium{s[band], a[band], 0., 1.3});
    }
    /// From radiant exitance to what `below` holds.
    static double exit_scale() { return 1 / (pi * ObjectBoundary(1.3f).mean_transmittance()); }

    /// A wide slab from z = -thickness to 0 behind which, or before which, a light shines straight
    /// at it; the camera is before it.
    static std::string lit_slab(double thickness, bool from_behind) {
        return xml::integrator("path") + sensor({0, 0, 150}, {0, 0, 0}, 33, 33, 30) +
               parallel_light({0, 0, from_behind ? 1. : -1.}, 2) +
               xml::shape("cube",
                          fmt::format("<transform name=\"to_world\"><scale x=\"60\" y=\"60\" "
                                      "z=\"{}\"/><translate z=\"{}\"/></transform>",
                                      0.5 * thickness, -0.5 * thickness) +
                              xml::flag("face_normals", true) + translucent());
    }
    /// What enters where the light of `lit_slab` meets it.
    static double entered() { return 2 * double(ObjectBoundary(1.3f).transmittance(1.f)); }
};

}  // namespace nacre
