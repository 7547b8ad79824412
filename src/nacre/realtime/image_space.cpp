// Subsurface scattering in image space: places drawn on the tangent plane with the density of R are
// looked up in the picture that the camera has of the irradiance.
//
//   T. Mertens, J. Kautz, P. Bekaert, F. Van Reeth, H.-P. Seidel 2003, Efficient Rendering of Local
//   Subsurface Scattering, Pacific Graphics; 2005, Computer Graphics Forum 24 (1), 41-49.
//
// As in the paper: places by importance of R, its density carried from the plane to the surface by
// cosines and distances (estimator=weighted), or the plain mean (estimator=fast). Otherwise than
// there: half of the places are drawn on a plane across the camera's rays, so that silhouettes, where
// the tangent plane is seen from its edge, are quiet, too (balance heuristic over planes and bands);
// and what the camera does not see is looked up in the lights' pictures, on planes across their rays
// at the point and at the depth at which light enters (pictures=camera leaves it out, as the paper
// does). Each place on the surface counts once: by the share that the camera's picture has of it, the
// rest in each light's picture.
//
// Its limits: light that enters where neither the camera nor, first of all, a light sees the surface
// does not exist; distances are straight, through gaps of concave objects too; small `samples` are
// noise, which stands still as long as the number of the frame does.
#include "nacre/realtime/frame_shift.h"
#include "nacre/realtime/profile_radii.h"
#include "nacre/realtime/realtime_description.h"
#include "nacre/realtime/realtime_technique.h"
#include "nacre/technique/common_parameters.h"

namespace nacre {
namespace {

enum class Estimator { weighted, fast };
enum class Pictures { camera_and_lights, camera };

/// The uniforms of a struct Picture.
void set_picture(ComputePass& pass, const std::string& name, const View& view) {
    pass.set((name + ".clip").c_str(), view.clip)
        .set((name + ".eye").c_str(), view.eye)
        .set((name + ".parallel").c_str(), int(view.parallel))
        .set((name + ".pixel").c_str(), view.pixel);
}

class ImageSpace final : public RealtimeTechnique {
  public:
    explicit ImageSpace(const RealtimeInput& in)
        : gpu_(in.gpu),
          part_(in.part),
          estimator_(in.options.choice<Estimator>("estimator")),
          pictures_(in.options.choice<Pictures>("pictures")),
          samples_(in.options.whole("samples")),
          exit_scale_(in.exit_scale()),
          radii_(BandProfiles(in)) {}

    void add_light(const CameraSurface& camera, const LightSurface& light,
                   const Texture& below) override {
        if (estimator_ == Estimator::fast || pictures_ == Pictures::camera) return;
        auto pass = gpu_.compute("image space, lights", gpu_.program("image_space.glsl", "LIGHT"));
        pass.reads(3, light.position).reads(4, light.entered);
        set_picture(pass, "light", light.view);
        run(pass, camera, light.light.color * exit_scale_, below);
    }
    void finish(const CameraSurface& camera, const Texture& below) override {
        auto pass = gpu_.compute(
            "image space, camera",
            gpu_.program("image_space.glsl", estimator_ == Estimator::fast ? "FAST" : ""));
        pass.reads(2, camera.lit);
        run(pass, camera, Vec3f(exit_scale_, exit_scale_, exit_scale_), below);
    }
    std::size_t bytes() const override { return radii_.bytes(); }

  private:
    void run(ComputePass& pass, const CameraSurface& camera, const Vec3f& scale,
             const Texture& below) {
        set_picture(pass, "camera", camera.view);
        radii_.bind(pass, 5, 6);
        pass.reads(0, camera.position)
            .reads(1, camera.normal)
            .writes(0, below)
            .set("part", int(part_))
            .set("samples", samples_)
            .set("deepest", radii_.deepest())
            .set("frame_shift", frame_shift(camera.frame))
            .set("scale", scale)
            .threads(camera.view.width, camera.view.height);
    }

    Gpu& gpu_;
    std::uint32_t part_;
    Estimator estimator_;
    Pictures pictures_;
    int samples_;
    float exit_scale_;
    ProfileRadii radii_;
};

}  // namespace

/// In the list of techniques/techniques.cpp.
const TechniqueDescription& image_space_technique() {
    static const TechniqueDescription description = realtime_description(
        {.name = "image_space",
         .title = "image-space importance sampling",
         .authors = "T. Mertens, J. Kautz, P. Bekaert, F. Van Reeth, H.-P. Seidel",
         .year = 2003,
         .paper = "Efficient Rendering of Local Subsurface Scattering, Pacific Graphics 2003",
         .how = "in real time: around each visible point places are drawn by importance of R and "
                "looked up in the camera's picture of the irradiance; where the camera does not "
                "look, in the lights' pictures",
         .parameters = {profile_parameter(),
                        exit_fresnel_parameter(),
                        {.name = "samples",
                         .meaning = "places a pixel, in the camera's picture and in each light's",
                         .kind = ParameterKind::integer,
                         .low = 6,
                         .high = 4096,
                         .otherwise = 64},
                        choice_parameter("estimator", "how places are weighed",
                                         {{"weighted", "by R and by their areas"},
                                          {"fast",
                                           "alike: even light comes out exactly, from the camera's "
                                           "picture alone"}}),
                        choice_parameter(
                            "pictures", "where light that entered is looked for",
                            {{"camera_and_lights", "lights' pictures where the camera's ends"},
                             {"camera", "as in the paper: none comes from behind"}})},
         .realtime = [](const RealtimeInput& in) -> std::unique_ptr<RealtimeTechnique> {
             return std::make_unique<ImageSpace>(in);
         }});
    return description;
}

}  // namespace nacre
