#pragma once
// Small scenes for the viewer's tests.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "apps/viewer/viewer_state.h"
#include "nacre/geometry/tessellate.h"
#include "nacre/scene/load.h"

namespace nacre::test {

/// A ball of 100 mm on its stage, as a mesh: a floor, a sky and two lamps.
inline viewer::ViewerScene ball(int size = 32) {
    auto mesh = std::make_shared<Mesh>(tessellate(Primitive(Sphere{{0, 0, 0}, 1}), 2e-3));
    mesh->name = "ball";
    MeshSceneOptions options;
    options.width = options.height = size;
    return {make_mesh_scene(mesh, options), "ball", {}};
}

/// A scene file of these elements, loaded.
class SceneFolder {
  public:
    SceneFolder()
        : folder_(std::filesystem::path(testing::TempDir()) /
                  fmt::format("nacre_viewer_{}_{}", getpid(),
                              testing::UnitTest::GetInstance()->current_test_info()->name())) {
        std::filesystem::create_directories(folder_);
    }
    ~SceneFolder() { std::filesystem::remove_all(folder_); }
    std::filesystem::path file(const std::string& name) const { return folder_ / name; }
    std::filesystem::path write(const std::string& name, const std::string& text) const {
        std::ofstream(file(name)) << text;
        return file(name);
    }
    viewer::ViewerScene scene(const std::string& elements) const {
        return {load_scene(write("scene.xml", "<scene version='3.0.0'>" + elements + "</scene>")),
                "scene.xml",
                {}};
    }

  private:
    std::filesystem::path folder_;
};

inline constexpr const char* small_sensor = R"(
    <sensor type="perspective">
        <transform name="to_world"><lookat origin="0, 20, 90" target="0, 5, 0" up="0, 1, 0"/></transform>
        <film type="hdrfilm"><integer name="width" value="32"/><integer name="height" value="24"/>
            <rfilter type="box"/></film>
        <sampler type="independent"><integer name="sample_count" value="4"/></sampler>
    </sensor>)";
inline constexpr const char* marble_ball = R"(
    <shape type="sphere" id="ball"><float name="radius" value="10"/>
        <bsdf type="dielectric"><float name="int_ior" value="1.5"/></bsdf>
        <medium type="homogeneous" name="interior"><string name="material" value="marble"/></medium>
    </shape>)";
inline constexpr const char* lamp = R"(
    <shape type="sphere" id="lamp"><point name="center" x="-40" y="40" z="40"/><float name="radius" value="8"/>
        <emitter type="area"><rgb name="radiance" value="20, 20, 20"/></emitter></shape>)";

}  // namespace nacre::test
