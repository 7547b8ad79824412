// Normalised diffusion in screen space: what engines ship. The irradiance of the pixels around is
// averaged on a disk whose places have the density of R.
//
//   E. Golubev 2018, Efficient Screen-Space Subsurface Scattering Using Burley's Normalized
//   Diffusion in Real-Time, SIGGRAPH course Advances in Real-Time Rendering. Blender's EEVEE works
//   alike.
//
// As there: radii by the band that reaches farthest; each place weighs R of its distance in space,
// bands apart, over the density; the sum is divided by the sum of weights, so that even light stays
// even; other objects are left out; nothing is blurred within one pixel. Otherwise: R is any profile
// of the list (profile=normalised_diffusion is the one there).
//
// What it cannot do: no light comes from behind or from beyond what the camera sees, so that thin
// parts lit from the back are black; dividing by the weights gives back at silhouettes and edges
// what ought to be lost there; foreshortened surfaces are sampled on a disk that faces the camera,
// which is noisy; the noise stands still as long as the number of the frame does.
#include "nacre/realtime/frame_shift.h"
#include "nacre/realtime/profile_radii.h"
#include "nacre/realtime/realtime_description.h"
#include "nacre/realtime/realtime_technique.h"
#include "nacre/technique/common_parameters.h"

namespace nacre {
namespace {

class ScreenDiffusion final : public RealtimeTechnique {
  public:
    explicit ScreenDiffusion(const RealtimeInput& in)
        : gpu_(in.gpu),
          part_(in.part),
          samples_(in.options.whole("samples")),
          exit_scale_(in.exit_scale()),
          radii_(BandProfiles(in)) {}

    void finish(const CameraSurface& camera, const Texture& below) override {
        auto pass = gpu_.compute("screen diffusion", gpu_.program("screen_diffusion.glsl"));
        radii_.bind(pass, 5, 6);
        pass.reads(0, camera.position)
            .reads(1, camera.lit)
            .writes(0, below)
            .set("camera_clip", camera.view.clip)
            .set("pixel_width", camera.view.pixel)
            .set("exit_scale", exit_scale_)
            .set("part", int(part_))
            .set("samples", samples_)
            .set("widest", radii_.widest())
            .set("frame_shift", frame_shift(camera.frame))
            .threads(camera.view.width, camera.view.height);
    }
    std::size_t bytes() const override { return radii_.bytes(); }

  private:
    Gpu& gpu_;
    std::uint32_t part_;
    int samples_;
    float exit_scale_;
    ProfileRadii radii_;
};

}  // namespace

/// In the list of techniques/techniques.cpp.
const TechniqueDescription& screen_diffusion_technique() {
    static const TechniqueDescription description = realtime_description(
        {.name = "screen_diffusion",
         .title = "screen-space normalised diffusion",
         .authors = "E. Golubev",
         .year = 2018,
         .paper = "Efficient Screen-Space Subsurface Scattering Using Burley's Normalized "
                  "Diffusion in Real-Time, SIGGRAPH 2018 course",
         .how =
             "in real time: the camera's picture of the irradiance is averaged around each pixel "
             "at places with the density of R, weighed by R of their distance in space",
         .parameters = {profile_parameter(),
                        exit_fresnel_parameter(),
                        {.name = "samples",
                         .meaning = "places a pixel",
                         .kind = ParameterKind::integer,
                         .low = 4,
                         .high = 1024,
                         .otherwise = 55}},
         .realtime = [](const RealtimeInput& in) -> std::unique_ptr<RealtimeTechnique> {
             return std::make_unique<ScreenDiffusion>(in);
         }});
    return description;
}

}  // namespace nacre
