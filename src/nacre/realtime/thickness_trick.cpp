// The thickness trick: plain diffuse reflection, and a glow from lights behind thin parts.
//
//   C. Barre-Brisebois, M. Bouchard 2011, Approximating Translucency for a Fast, Cheap and
//   Convincing Subsurface Scattering Look, Game Developers Conference; also GPU Pro 2, chapter 2.1.
//
// As there: light that enters comes through towards the viewer as
// (strength (V . -(L + distortion N))^power + ambient) times what the thickness leaves. The
// thickness is not precomputed but that along the light's ray, from the light's picture, and what it
// leaves falls off by the medium's effective transport coefficient, times `density`.
//
// It is not physical: nothing is conserved, light does not spread, so that shadows and edges stay
// hard, and its constants are set by eye. In front the object is a Lambert surface that gives back the
// profile's total.
#include <cmath>

#include "nacre/realtime/band_profiles.h"
#include "nacre/realtime/realtime_description.h"
#include "nacre/realtime/realtime_technique.h"
#include "nacre/technique/common_parameters.h"

namespace nacre {
namespace {

class ThicknessTrick final : public RealtimeTechnique {
  public:
    explicit ThicknessTrick(const RealtimeInput& in)
        : gpu_(in.gpu),
          part_(in.part),
          distortion_(float(in.options.number("distortion"))),
          power_(float(in.options.number("power"))),
          strength_(float(in.options.number("strength"))),
          ambient_(float(in.options.number("ambient"))) {
        const BandProfiles profiles(in);
        for (int b = 0; b < 3; ++b) {
            const ProfileMedium& m = profiles.media()[std::size_t(b)];
            scale_[b] = float(profiles.total(b)) * in.exit_scale();
            attenuation_[b] =
                float(std::sqrt(3 * m.sigma_a * m.sigma_t_prime()) * in.options.number("density"));
        }
    }

    void add_light(const CameraSurface& camera, const LightSurface& light,
                   const Texture& below) override {
        auto pass = gpu_.compute("thickness", gpu_.program("thickness_trick.glsl"));
        pass.reads(1, camera.normal)
            .reads(3, light.position)
            .reads(4, light.entered)
            .set("eye", camera.view.eye)
            .set("is_parallel", int(camera.view.parallel))
            .set("light_clip", light.view.clip)
            .set("light_eye", light.view.eye)
            .set("light_parallel", int(light.view.parallel))
            .set("pixel_width", light.view.pixel)
            .set("distortion", distortion_)
            .set("power", power_)
            .set("strength", strength_)
            .set("ambient", ambient_)
            .set("attenuation", attenuation_);
        run(pass, camera, scale_ * light.light.color, below);
    }
    void finish(const CameraSurface& camera, const Texture& below) override {
        auto pass = gpu_.compute("diffuse", gpu_.program("thickness_trick.glsl", "FRONT"));
        pass.reads(2, camera.lit);
        run(pass, camera, scale_, below);
    }

  private:
    void run(ComputePass& pass, const CameraSurface& camera, const Vec3f& scale,
             const Texture& below) const {
        pass.reads(0, camera.position)
            .writes(0, below)
            .set("part", int(part_))
            .set("scale", scale)
            .threads(camera.view.width, camera.view.height);
    }

    Gpu& gpu_;
    std::uint32_t part_;
    float distortion_, power_, strength_, ambient_;
    Vec3f scale_ = {}, attenuation_ = {};
};

}  // namespace

/// In the list of techniques/techniques.cpp.
const TechniqueDescription& thickness_trick_technique() {
    static const TechniqueDescription description = realtime_description(
        {.name = "thickness_trick",
         .title = "translucency by thickness",
         .authors = "C. Barre-Brisebois, M. Bouchard",
         .year = 2011,
         .paper = "Approximating Translucency for a Fast, Cheap and Convincing Subsurface "
                  "Scattering Look, Game Developers Conference 2011",
         .how = "in real time, not physical: diffuse reflection, and a glow towards lights behind "
                "that falls off with the thickness in their pictures",
         .parameters =
             {profile_parameter(),
              exit_fresnel_parameter(),
              {.name = "distortion",
               .meaning = "how far normals turn the light aside",
               .otherwise = 0.2},
              {.name = "power", .meaning = "how narrow the glow is", .high = 100., .otherwise = 4.},
              {.name = "strength", .meaning = "of the glow", .high = 100., .otherwise = 1.},
              {.name = "ambient",
               .meaning = "glow in all directions",
               .high = 100.,
               .otherwise = 0.1},
              {.name = "density",
               .meaning = "of the thickness: factor of the transport coefficient",
               .high = 100.,
               .otherwise = 1.}},
         .realtime = [](const RealtimeInput& in) -> std::unique_ptr<RealtimeTechnique> {
             return std::make_unique<ThicknessTrick>(in);
         }});
    return description;
}

}  // namespace nacre
