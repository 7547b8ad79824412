// Any bytes either load as a mesh whose indices are in range, or are refused with InputError.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "nacre/geometry/gltf_materials.h"
#include "nacre/geometry/mesh_io.h"
#include "nacre/geometry/mesh_report.h"
#include "nacre/math/error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    // The first byte chooses the reader. The folder does not exist, so that no buffer is found.
    constexpr const char* kNames[] = {"/nowhere/a.obj", "/nowhere/a.ply",        "/nowhere/a.off",
                                      "/nowhere/a.stl", "/nowhere/a.serialized", "/nowhere/a.gltf"};
    const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
    try {
        const auto mesh = nacre::parse_mesh(bytes, kNames[data[0] % 6]);
        for (const nacre::Mesh::Triangle& triangle : mesh->triangles)
            for (const std::uint32_t corner : triangle)
                if (corner >= mesh->positions.size()) std::abort();
        nacre::inspect(*mesh);
        if (data[0] % 6 == 5) nacre::parse_gltf_object(bytes, kNames[5]);
    } catch (const nacre::InputError&) {
    }
    return 0;
}
