#pragma once
// What the tests of frames in real time share: a context (or a skip that says why there is none),
// scenes with a camera, frames as numbers.
#include <optional>

#include "nacre/realtime/frame_renderer.h"
#include "nacre/scene/subsurface.h"
#include "tests/render/render_fixture.h"

namespace nacre {

class Frames : public RenderTest {
  protected:
    void SetUp() override {
        RenderTest::SetUp();
        try {
            context_.emplace();
            use_.emplace(*context_);
            gpu_ = std::make_unique<Gpu>();
        } catch (const RunError& error) {
            GTEST_SKIP() << error.what();
        }
    }
    void TearDown() override {
        gpu_.reset();
        use_.reset();
        context_.reset();
        RenderTest::TearDown();
    }

    Gpu& gpu() { return *gpu_; }

    /// A perspective camera at `from` that looks at `to`, with a film of `width` x `height`.
    static std::string sensor(const Vec3d& from, const Vec3d& to, int width, int height,
                              double fov = 35, const std::string& more = "") {
        return fmt::format(
            "<sensor type=\"perspective\">{}<string name=\"fov_axis\" value=\"smaller\"/>"
            "<transform name=\"to_world\"><lookat origin=\"{}, {}, {}\" target=\"{}, {}, {}\" "
            "up=\"0, 1, 0\"/></transform><film type=\"hdrfilm\">{}{}<rfilter type=\"box\"/></film>"
            "{}</sensor>\n",
            xml::number("fov", fov), from.x, from.y, from.z, to.x, to.y, to.z,
            xml::integer("width", width), xml::integer("height", height), more);
    }
    static std::string point_light(const Vec3d& at, double intensity) {
        return fmt::format(
            "<emitter type=\"point\"><point name=\"position\" x=\"{}\" y=\"{}\" "
            "z=\"{}\"/>{}</emitter>\n",
            at.x, at.y, at.z, xml::rgb("intensity", Vec3d(intensity, intensity, intensity)));
    }
    static std::string parallel_light(const Vec3d& along, double irradiance) {
        return fmt::format(
            "<emitter type=\"directional\"><vector name=\"direction\" x=\"{}\" "
            "y=\"{}\" z=\"{}\"/>{}</emitter>\n",
            along.x, along.y, along.z,
            xml::rgb("irradiance", Vec3d(irradiance, irradiance, irradiance)));
    }
    /// A medium of three different bands behind a smooth boundary.
    static std::string translucent(double density = 1) {
        return xml::dielectric(1.3) + matter(density);
    }
    static std::string matter(double density = 1) {
        return xml::medium("interior", xml::rgb("sigma_s", Vec3d(1, 0.7, 2) * density) +
                                           xml::rgb("sigma_a", Vec3d(0.02, 0.05, 0.03) * density) +
                                           xml::phase("isotropic"));
    }

    /// All translucent shapes by one technique.
    static std::vector<ShapeTechnique> shapes_of(const Scene& scene,
                                                 const TechniqueDescription& technique,
                                                 const Settings& options = {}) {
        std::vector<ShapeTechnique> shapes(scene.shapes.size());
        for (std::size_t i = 0; i < shapes.size(); ++i)
            if (is_translucent(scene.shapes[i]))
                shapes[i] = {&technique,
                             ParameterValues(technique.name, technique.parameters, options)};
        return shapes;
    }
    View camera_of(const Scene& scene, const GpuScene& on_device) const {
        return camera_view(*scene.camera, scene.film, {0.f, 0.f}, on_device.bounds());
    }

  private:
    std::optional<HeadlessContext> context_;
    std::optional<HeadlessContext::Use> use_;
    std::unique_ptr<Gpu> gpu_;
};

}  // namespace nacre
