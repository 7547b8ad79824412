// Translucent shadow maps: what a light's picture of an object holds of entered light, summed around
// each point by few taps in its smaller levels.
//
//   C. Dachsbacher, M. Stamminger 2003, Translucent Shadow Maps, Eurographics Symposium on
//   Rendering, 197-201.
//
// As in the paper: the light's picture of position, normal and entered light with its levels, and a
// dense square of 7 x 7 taps for what comes from near. For the rest there are two patterns: 21 taps
// as the paper has, on rings that follow the profile (tap_pattern.h); and, the default, squares
// around the dense one that double in size until they hold the whole picture, each of blocks that
// are a fixed share of its side: some 340 taps, within 2 % of the sum over all texels, where the
// rings are within 12 to 22 % and show blotches where the surface bends. Otherwise than in the paper,
// near and far are parted by distance and not by depth, a light may be of any kind, and the distance
// to a source is that between the points (the paper puts sources along the normal where light
// enters: option `placement`).
//
// Its limits are the paper's: only what a light sees first sends light on, so that what lies behind
// a cavity is too dark, and light goes straight through the gaps of concave objects as through
// matter.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "nacre/bssrdf/dipole.h"
#include "nacre/math/error.h"
#include "nacre/realtime/band_profiles.h"
#include "nacre/realtime/realtime_description.h"
#include "nacre/realtime/realtime_technique.h"
#include "nacre/realtime/tap_pattern.h"
#include "nacre/technique/common_parameters.h"

namespace nacre {
namespace {

enum class Placement { distance, paper };
enum class Pattern { nested, rings };

class TranslucentShadowMap final : public RealtimeTechnique {
  public:
    explicit TranslucentShadowMap(const RealtimeInput& in)
        : gpu_(in.gpu),
          scene_(in.scene),
          part_(in.part),
          placement_(in.options.choice<Placement>("placement")),
          pattern_kind_(in.options.choice<Pattern>("pattern")),
          blocks_(4 * in.options.whole("blocks")),
          exit_scale_(in.exit_scale()),
          profiles_(in) {
        if (placement_ == Placement::paper && in.profile != "dipole")
            throw InputError(
                "placement 'paper' moves the two sources of the dipole: give profile 'dipole', or "
                "placement 'distance'");
        for (std::size_t b = 0; b < 3; ++b) {
            const ProfileMedium& m = profiles_.media()[b];
            const Dipole<double> d(m.sigma_s_prime(), m.sigma_a, m.eta);
            dipole_[b] = {float(d.z_r), float(d.z_v), float(d.sigma_tr),
                          float(d.albedo * 0.25 * std::numbers::inv_pi)};
        }
        const GpuShape& shape = scene_.shapes()[part_];
        const TapPattern pattern =
            make_tap_pattern([this](int b, double rho, double z) { return kernel(b, rho, z); },
                             in.options.whole("taps") / ring_taps, profiles_.radius_of(0.35),
                             profiles_.reach(), double(length(shape.bounds.diagonal())));
        square_ = float(pattern.square);
        depth_scale_ = float(pattern.depth_scale);
        depth_range_ = float(pattern.depth_range);
        rings_ = pattern.rings;
        pattern_ = pattern.texture();
        profile_ = profiles_.texture();
    }

    void add_light(const CameraSurface& camera, const LightSurface& light,
                   const Texture& below) override {
        auto pass = gpu_.compute("translucent shadow map",
                                 gpu_.program("translucent_shadow_map.glsl",
                                              placement_ == Placement::paper ? "PAPER" : ""));
        // Squares that double until they hold the whole picture, wherever in it the point is.
        const float picture =
            light.view.pixel * float(light.view.width) *
            (light.view.parallel ? 1.f
                                 : length(scene_.shapes()[part_].bounds.center() - light.view.eye));
        const int levels =
            pattern_kind_ == Pattern::nested
                ? std::max(1, int(std::ceil(std::log2(2.f * picture / (7.f * square_)))))
                : 0;
        profiles_.bind(pass, 5, profile_);
        const Mat4& m = light.view.clip;
        const Vec3f across = normalize(Vec3f(m[0], m[4], m[8]));
        const Vec3f down = normalize(Vec3f(m[1], m[5], m[9]));
        pass.reads(0, camera.position)
            .reads(1, light.position)
            .reads(2, light.entered)
            .reads(3, pattern_)
            .writes(0, below)
            .set("light_clip", m)
            .set("light_parallel", int(light.view.parallel))
            .set("pixel_width", light.view.pixel)
            .set("across", across)
            .set("down", down)
            .set("light_color", light.light.color * exit_scale_)
            .set("part", int(part_))
            .set("rings", rings_)
            .set("levels", levels)
            .set("blocks", blocks_)
            .set("square", square_)
            .set("depth_scale", depth_scale_)
            .set("depth_range", depth_range_);
        for (std::size_t b = 0; b < 3; ++b)
            pass.set(std::array{"dipole[0]", "dipole[1]", "dipole[2]"}[b], dipole_[b]);
        pass.threads(camera.view.width, camera.view.height);
    }

    std::size_t bytes() const override { return pattern_.bytes() + profile_.bytes(); }

  private:
    double kernel(int band, double rho, double z) const {
        if (placement_ == Placement::distance) return profiles_.eval(band, std::hypot(rho, z));
        // Light enters at depth z above the point and its real source lies z_r below the entry.
        const auto& d = dipole_[std::size_t(band)];
        const auto term = [&](double depth, double height) {
            const double s = std::max(std::hypot(rho, height), 0.25 * d[0]);
            return depth * (d[2] * s + 1) * std::exp(-d[2] * s) / (s * s * s);
        };
        return d[3] * (term(d[0], z - d[0]) + term(d[1], z + d[1]));
    }

    Gpu& gpu_;
    const GpuScene& scene_;
    std::uint32_t part_;
    Placement placement_;
    Pattern pattern_kind_;
    int blocks_;
    float exit_scale_;
    BandProfiles profiles_;
    std::array<std::array<float, 4>, 3> dipole_{};  // z_r, z_v, sigma_tr, albedo / 4 pi
    float square_ = 0, depth_scale_ = 0, depth_range_ = 0;
    int rings_ = 0;
    Texture pattern_, profile_;
};

}  // namespace

/// In the list of techniques/techniques.cpp.
const TechniqueDescription& translucent_shadow_map_technique() {
    static const TechniqueDescription description = realtime_description(
        {.name = "translucent_shadow_map",
         .title = "translucent shadow maps",
         .authors = "C. Dachsbacher, M. Stamminger",
         .year = 2003,
         .paper = "Translucent Shadow Maps, Eurographics Symposium on Rendering 2003",
         .how = "in real time: the light's picture of the object holds what enters; each visible "
                "point sums it by a dense square and a sparse pattern of taps that follows the "
                "profile",
         .parameters =
             {profile_parameter(),
              exit_fresnel_parameter(),
              choice_parameter("placement", "where the sources of the dipole stand",
                               {{"distance", "R of the distance between the points"},
                                {"paper", "along the normal where light enters, as in the paper"}}),
              choice_parameter(
                  "pattern", "how what is not near is summed",
                  {{"nested", "the whole picture, by blocks that grow with distance"},
                   {"rings",
                    "few taps that follow the profile, as in the paper: faster, with blotches "
                    "where the surface bends"}}),
              {.name = "blocks",
               .meaning = "blocks of nested squares along a quarter of their side",
               .kind = ParameterKind::integer,
               .low = 1,
               .high = 8,
               .otherwise = 2},
              {.name = "taps",
               .meaning = "taps of the rings, 7 each",
               .kind = ParameterKind::integer,
               .low = 7,
               .high = 70,
               .otherwise = 21}},
         .variants = "pattern=nested|pattern=rings",
         .realtime = [](const RealtimeInput& in) -> std::unique_ptr<RealtimeTechnique> {
             return std::make_unique<TranslucentShadowMap>(in);
         }});
    return description;
}

}  // namespace nacre
