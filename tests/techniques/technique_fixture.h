#pragma once
// What the tests of the techniques share: slabs of a coloured medium and looks at them.
#include "nacre/bssrdf/medium.h"
#include "nacre/techniques/techniques.h"
#include "tests/render/render_fixture.h"

namespace nacre {

inline constexpr double eta = 1.3;
inline const std::string coefficients =
    xml::rgb("sigma_s", {1., 0.7, 2.}) + xml::rgb("sigma_a", {0.1, 0.2, 0.15});

/// A box from z = -thickness to 0 that is 60 mm wide.
inline std::string slab(double thickness, const std::string& inside) {
    return xml::shape("cube",
                      fmt::format("<transform name=\"to_world\"><scale x=\"30\" y=\"30\" z=\"{}\"/>"
                                  "<translate z=\"{}\"/></transform>",
                                  0.5 * thickness, -0.5 * thickness) +
                          xml::flag("face_normals", true) + inside);
}
inline std::string subsurface(const std::string& profile, const std::string& options) {
    return "<subsurface type=\"" + profile + "\">" + coefficients + xml::number("int_ior", eta) +
           xml::number("ext_ior", 1) + options + "</subsurface>";
}
inline std::string word(const std::string& name, const std::string& value) {
    return "<string name=\"" + name + "\" value=\"" + value + "\"/>";
}

/// Rays from direction `from` onto the square of half a side `half` in the middle of the slab.
inline RayMaker onto_the_middle(const Vec3f& from, float half) {
    return [=](Vec2f u) {
        const Vec3f d = normalize(from);
        const Point3f p{half * (2.f * u.x - 1.f), half * (2.f * u.y - 1.f), 0.f};
        return Ray{p + d * 50.f, -d};
    };
}

inline ProfileMedium medium(int c) {
    const double s[] = {1., 0.7, 2.}, a[] = {0.1, 0.2, 0.15};
    return {s[c], a[c], 0., eta};
}

/// Any rays as a camera's, from the place on the film and the one on the lens.
class RayCamera final : public Camera {
  public:
    using Maker = std::function<Ray(Vec2f film, Vec2f lens)>;
    explicit RayCamera(Maker maker) : maker_(std::move(maker)) {}
    Ray ray(Vec2f film, Vec2f lens) const override { return maker_(film, lens); }

  private:
    Maker maker_;
};

/// A frame of `pixels` independent estimates along such rays.
inline FrameSettings frame_of(const RayMaker& rays, const EstimateOptions& options) {
    FrameSettings frame;
    frame.camera = std::make_shared<RayCamera>([rays](Vec2f, Vec2f lens) { return rays(lens); });
    frame.film.width = options.pixels;
    frame.film.height = 1;
    frame.film.filter.type = "box";
    frame.sampler = {options.sampler, options.samples, options.seed};
    return frame;
}

inline RadianceEstimate estimate(Technique& technique, const RayMaker& rays,
                                 const EstimateOptions& options = {}) {
    const RenderResult r = technique.render(frame_of(rays, options));
    EXPECT_EQ(r.film.invalid_count(), 0u);
    std::vector<Vec3d> means;
    for (int x = 0; x < options.pixels; ++x) means.emplace_back(r.film.mean(x, 0));
    return RadianceEstimate::of(std::move(means));
}

class Techniques : public RenderTest {
  protected:
    /// As the scene says.
    RadianceEstimate look(const Scene& s, const RayMaker& rays, EstimateOptions options = {}) {
        return estimate(*prepare(s, plan_of(s)), rays, options);
    }
    RadianceEstimate look(const Scene& s, const TechniqueChoice& choice, const RayMaker& rays,
                          EstimateOptions options = {}) {
        return estimate(*prepare(s, plan_of(s, choice)), rays, options);
    }
};

}  // namespace nacre
