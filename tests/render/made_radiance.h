#pragma once
// Pictures of given functions: a scene with a camera and no shapes, and an integrator that says what it is told.
#include <cmath>
#include <functional>

#include "nacre/render/integrator.h"
#include "nacre/scene/scene.h"

namespace nacre {

/// A pinhole looking along +z, or parallel rays along it.
class TestCamera : public Camera {
  public:
    explicit TestCamera(bool parallel = false) : parallel_(parallel) {}
    Ray ray(Vec2f film, Vec2f) const override {
        if (parallel_) return {{film.x, film.y, 0.f}, {0.f, 0.f, 1.f}};
        return {{}, normalize(Vec3f(2 * film.x - 1, 2 * film.y - 1, 1.f))};
    }

  private:
    bool parallel_;
};

/// Radiance given by a function; counts one ray and two scatterings.
class TestIntegrator : public Integrator {
  public:
    using Function = std::function<Spectral(const Ray&, Sampler&, const Wavelengths&)>;
    explicit TestIntegrator(Function f) : f_(std::move(f)) {}
    Spectral radiance(const Ray& ray, Sampler& sampler, const Wavelengths& wavelengths,
                      RayCounts& counts) const override {
        ++counts.rays;
        counts.scatterings += 2;
        return f_(ray, sampler, wavelengths);
    }

  private:
    Function f_;
};

inline Scene test_scene(int width, int height, int samples, const std::string& filter = "box") {
    Scene scene;
    scene.camera = std::make_shared<TestCamera>();
    scene.film.width = width;
    scene.film.height = height;
    scene.film.filter.type = filter;
    scene.sampler.samples = samples;
    return scene;
}

}  // namespace nacre
