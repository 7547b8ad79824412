// Separable subsurface scattering: two one-dimensional blurs of the camera's irradiance, what games
// ship for skin.
//
//   J. Jimenez, K. Zsolnai, A. Jarabo, C. Freude, T. Auzinger, X.-C. Wu, J. von der Pahlen, M.
//   Wimmer, D. Gutierrez 2015, Separable Subsurface Scattering, Computer Graphics Forum 34 (6),
//   188-197.
//
// The kernel is the paper's pre-integrated one: R integrated across the direction of the blur, which
// is exact for light that varies along one axis. It is integrated from the profile itself; of a sum
// of Gaussians it would be the sum of their one-dimensional ones. Offsets grow quadratically, each
// tap weighs the light between the middles to its neighbours, and where the depth differs the
// pixel's own light stands in for the tap's (the paper's surface-following correction).
//
// What it cannot do: no light from behind or from beyond what the camera sees; a point of light
// spreads as a cross rather than a disk; the following weakens the blur on slanted surfaces; where a
// blur leaves the object or the picture, the pixel's own light stands in.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "nacre/realtime/band_profiles.h"
#include "nacre/realtime/realtime_description.h"
#include "nacre/realtime/realtime_technique.h"
#include "nacre/technique/common_parameters.h"

namespace nacre {
namespace {

/// R of a band integrated along lines: light within a strip |x| < a, over all of it.
class LineProfile {
  public:
    LineProfile(const BandProfiles& profiles, int band, double longest) {
        // Radii of equal steps of the logarithm; a ring's light is spread over x as asin says.
        constexpr int steps = 1500;
        const double first = 1e-4 * profiles.scale(), ratio = longest / first;
        double before = 0;
        for (int i = 0; i <= steps; ++i) {
            const double r = first * std::pow(ratio, double(i) / steps);
            const double within = profiles.cumulative(band, r);
            rings_.push_back({r * std::pow(ratio, -0.5 / steps), within - before});
            before = within;
        }
        total_ = before;
    }
    double within(double a) const {
        double sum = 0;
        for (const auto& [r, light] : rings_)
            sum += light * (a >= r ? 1 : 2 * std::numbers::inv_pi * std::asin(a / r));
        return total_ > 0 ? sum / total_ : 1;
    }

  private:
    struct Ring {
        double radius, light;
    };
    std::vector<Ring> rings_;
    double total_ = 0;
};

class Separable final : public RealtimeTechnique {
  public:
    explicit Separable(const RealtimeInput& in) : gpu_(in.gpu), part_(in.part) {
        const BandProfiles profiles(in);
        const int taps = 2 * in.options.whole("taps") + 1;
        const double range = profiles.radius_of(0.97);
        const LineProfile bands[] = {{profiles, 0, 4 * profiles.reach()},
                                     {profiles, 1, 4 * profiles.reach()},
                                     {profiles, 2, 4 * profiles.reach()}};
        const auto offset = [&](double i) {
            const double t = 2 * i / (taps - 1) - 1;
            return range * t * std::abs(t);
        };
        std::vector<float> table;
        for (int i = 0; i < taps; ++i) {
            // What lies between the middles to the neighbours; the outermost take all beyond.
            const double x = offset(i), low = 0.5 * (x + offset(i - 1)),
                         high = 0.5 * (x + offset(i + 1));
            for (const LineProfile& band : bands) {
                const auto left_of = [&](double a) {
                    return 0.5 + std::copysign(0.5, a) * band.within(std::abs(a));
                };
                const double from = i == 0 ? 0 : left_of(low),
                             to = i + 1 == taps ? 1 : left_of(high);
                table.push_back(float(to - from));
            }
            table.push_back(float(x));
        }
        kernel_ = Texture(TexelFormat::rgba32f, taps, 1);
        kernel_.upload(table);
        following_ = float(in.options.number("following") / range);
        for (int b = 0; b < 3; ++b) scale_[b] = float(profiles.total(b)) * in.exit_scale();
    }

    void finish(const CameraSurface& camera, const Texture& below) override {
        if (!between_.is(camera.view.width, camera.view.height))
            between_ = Texture(TexelFormat::rgba32f, camera.view.width, camera.view.height);
        const auto blur = [&](std::string_view define, const Texture& from, const Texture& to,
                              Vec2f direction) {
            gpu_.compute("separable", gpu_.program("separable.glsl", define))
                .reads(0, camera.position)
                .reads(1, from)
                .reads(2, kernel_)
                .writes(0, to)
                .set("camera_clip", camera.view.clip)
                .set("pixel_width", camera.view.pixel)
                .set("following", following_)
                .set("scale", scale_)
                .set("direction", direction)
                .set("part", int(part_))
                .threads(camera.view.width, camera.view.height);
        };
        blur("", camera.lit, between_, {1.f, 0.f});
        blur("FINISH", between_, below, {0.f, 1.f});
    }
    std::size_t bytes() const override { return kernel_.bytes() + between_.bytes(); }

  private:
    Gpu& gpu_;
    std::uint32_t part_;
    Texture kernel_, between_;
    float following_ = 0;
    Vec3f scale_ = {};
};

}  // namespace

/// In the list of techniques/techniques.cpp.
const TechniqueDescription& separable_technique() {
    static const TechniqueDescription description = realtime_description(
        {.name = "separable",
         .title = "separable subsurface scattering",
         .authors = "J. Jimenez, K. Zsolnai, A. Jarabo, C. Freude, T. Auzinger, X.-C. Wu, "
                    "J. von der Pahlen, M. Wimmer, D. Gutierrez",
         .year = 2015,
         .paper = "Separable Subsurface Scattering, Computer Graphics Forum 34 (6)",
         .how =
             "in real time: the camera's picture of the irradiance is blurred across and down by "
             "R integrated along lines",
         .parameters = {profile_parameter(),
                        exit_fresnel_parameter(),
                        {.name = "taps",
                         .meaning = "of each blur, to either side of the pixel",
                         .kind = ParameterKind::integer,
                         .low = 2,
                         .high = 64,
                         .otherwise = 12},
                        {.name = "following",
                         .meaning =
                             "how soon a difference of depth, over the kernel's reach, parts "
                             "surfaces",
                         .low = 0.,
                         .high = 100.,
                         .otherwise = 1.}},
         .realtime = [](const RealtimeInput& in) -> std::unique_ptr<RealtimeTechnique> {
             return std::make_unique<Separable>(in);
         }});
    return description;
}

}  // namespace nacre
