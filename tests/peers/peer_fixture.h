#pragma once
// A scene, a request and programs that stand for peers, in a folder of the test's own.
#include "nacre/peers/peer.h"
#include "tests/scene/scene_files.h"

namespace nacre {

class PeerTest : public SceneFiles {
  protected:
    Scene load(const std::string& body) {
        return load_scene(
            write("scene.xml", "<scene version=\"3.0.0\">\n" + body + "\n</scene>\n"));
    }
    PeerRequest request(const Scene& scene) const {
        PeerRequest r{.scene = scene};
        r.folder = folder_ / "job";
        r.search_path = (folder_ / "bin").string();
        std::filesystem::create_directories(r.folder);
        return r;
    }
    /// A program of that name on the request's search path.
    void write_program(const std::string& name, const std::string& script) const {
        const auto file = write("bin/" + name, "#!/bin/sh\n" + script + "\n");
        std::filesystem::permissions(file, std::filesystem::perms::owner_all);
    }
};

inline constexpr const char* plane = R"(
    <emitter type="constant"/>
    <shape type="rectangle"><bsdf type="diffuse"><rgb name="reflectance" value="0.5, 0.25, 0"/></bsdf></shape>)";

}  // namespace nacre
