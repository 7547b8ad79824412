#pragma once
// What the tests of lights share: lights from XML and of single shapes, and estimates with errors.

#include "nacre/math/random.h"
#include "nacre/scene/lights/types.h"
#include "tests/geometry/shapes.h"
#include "tests/scene/bands.h"
#include "tests/scene/scene_files.h"
#include "tests/support/constants.h"

namespace nacre {

/// Mean of f over n samples with its standard error.
struct MeanEstimate {
    double mean = 0.0, error = 0.0;
    template <class F>
    MeanEstimate(int n, F&& f) {
        double sum = 0.0, sum2 = 0.0;
        for (int i = 0; i < n; ++i) {
            const double v = f();
            sum += v;
            sum2 += v * v;
        }
        mean = sum / n;
        error = std::sqrt(std::max(0.0, sum2 / n - mean * mean) / n);
    }
};
/// Within four standard errors (6e-5 of correct estimates fail; seeds are fixed) and float
/// rounding.
inline void expect_estimate(const MeanEstimate& e, double truth) {
    EXPECT_NEAR(e.mean, truth, 4.0 * e.error + 3e-6 * truth);
    EXPECT_LT(e.error, 0.02 * truth) << "too noisy to tell";
}

/// Irradiance of a surface with normal n at p, green channel.
inline MeanEstimate irradiance(const Light& light, const Point3f& p, const Vec3f& n,
                               int samples = 20000) {
    Random random(11);
    return {samples, [&] {
                const LightSample s = light.sample(p, random.next2(), bands);
                if (!(s.pdf > 0.f)) return 0.0;
                return double(s.radiance[1]) * std::max(0.f, dot(s.wi, n)) / s.pdf;
            }};
}

class Lights : public SceneFiles {
  protected:
    LightPtr light(const std::string& xml) {
        root_ = read(xml);
        return make_light(*root_->children.at(0).node, context_);
    }
    /// The light of the only shape of `rays_`; green radiance 2.
    LightPtr area_light() {
        rays_.build();
        root_ = read(
            "<shape type=\"sphere\"><emitter type=\"area\">"
            "<rgb name=\"radiance\" value=\"1, 2, 3\"/></emitter></shape>");
        return make_area_light(*root_->children.at(0).node->children.at(0).node, rays_, 0,
                               context_);
    }
    LightPtr sphere(const Point3f& center, float radius, bool inwards = false) {
        rays_.add(Sphere{center, radius, inwards});
        return area_light();
    }
    LightPtr rectangle(const Point3f& corner, const Vec3f& a, const Vec3f& b, bool flip = false) {
        Mesh mesh;
        mesh.positions = {corner, corner + a, corner + a + b, corner + b};
        mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
        rays_.add(test::share(mesh), true, flip);
        return area_light();
    }
    LightPtr cube(const Point3f& c, float half) {
        Mesh mesh;
        for (int i = 0; i < 8; ++i)
            mesh.positions.push_back(
                c + Vec3f(i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? half : -half));
        mesh.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                          {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
        rays_.add(test::share(mesh), true);
        return area_light();
    }

    /// Integral of the light's density over the directions whose rays meet it. Directions are drawn
    /// uniformly from the cone about `axis`, which must hold the whole light.
    MeanEstimate density_integral(const Light& light, const Point3f& from, const Vec3f& axis,
                                  double cos_cone) {
        Random random(5);
        const Framef frame = Framef::around(normalize(axis));
        return {60000, [&] {
                    const Vec2f u = random.next2();
                    const double drop = u.x * (1.0 - cos_cone);  // keeps its digits in narrow cones
                    const double sine = std::sqrt(drop * (2.0 - drop)), phi = 2.0 * pi * u.y;
                    const Ray ray{from,
                                  frame.to_world({float(sine * std::cos(phi)),
                                                  float(sine * std::sin(phi)), float(1.0 - drop)})};
                    const auto hit = rays_.intersect(ray);
                    if (!hit) return 0.0;
                    const SurfacePoint at = rays_.surface_point(ray, *hit);
                    return 2.0 * pi * (1.0 - cos_cone) * light.pdf(from, ray.d, &at);
                }};
    }

    /// Every sample must be met where it says, with the radiance and density that it says.
    void expect_samples_are_met(const Light& light, const Point3f& from, float tolerance) {
        Random random(3);
        for (int i = 0; i < 500; ++i) {
            const LightSample s = light.sample(from, random.next2(), bands);
            if (!(s.pdf > 0.f)) continue;
            EXPECT_NEAR(length(s.wi), 1.f, 1e-6f);
            const Ray ray{from, s.wi};
            const auto hit = rays_.intersect(ray);
            if (!hit) continue;  // at the very rim
            EXPECT_NEAR(hit->t, s.distance, tolerance * s.distance);
            const SurfacePoint at = rays_.surface_point(ray, *hit);
            EXPECT_NEAR(light.pdf(from, s.wi, &at), s.pdf, tolerance * s.pdf);
            EXPECT_EQ(light.radiance(&at, s.wi, bands)[1], s.radiance[1]);
        }
    }

    RayScene rays_;
    SceneNodePtr root_;
    BuildContext context_;
};

}  // namespace nacre
