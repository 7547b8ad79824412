#pragma once
// Programs, made from the shader files that are compiled into the library
// (realtime/shaders, one program or one set of functions a file).
#include <array>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "nacre/math/vec.h"
#include "nacre/realtime/gl/objects.h"

namespace nacre {

/// A file of realtime/shaders.
struct ShaderFile {
    std::string_view name, text;
};
/// All of them, by name.
const std::vector<ShaderFile>& shader_files();
/// The source of a program: the file with every `#include "other.glsl"` replaced, each file once,
/// so that messages name file and line. `defines`: "TAPS=21 LOCAL". Throws RunError for names that
/// are not there.
std::string shader_source(std::string_view file, std::string_view defines = "");

/// A column-major matrix, as shaders have it.
using Mat4 = std::array<float, 16>;

/// A program of a compute shader, or of a vertex and a fragment shader. Values are set by name; names that the shader does not use
/// are passed over, since compilers remove what they find useless.
class Program {
  public:
    /// Throws RunError with the compiler's message if it does not compile.
    Program(std::string_view file, std::string_view defines = "");
    /// For the raster unit.
    struct Raster {
        std::string_view vertex, fragment;
    };
    explicit Program(const Raster& files);
    ~Program();
    Program(Program&&) noexcept = default;

    std::uint32_t name() const { return name_.get(); }
    const std::string& title() const { return title_; }
    /// Threads of a workgroup along each axis; of compute programs.
    const std::array<int, 3>& group() const { return group_; }

    void set(const char* name, int value) const;
    void set(const char* name, std::uint32_t value) const;
    void set(const char* name, float value) const;
    void set(const char* name, Vec2f value) const;
    void set(const char* name, const Vec3f& value) const;
    void set(const char* name, const std::array<float, 4>& value) const;
    void set(const char* name, const Mat4& value) const;

  private:
    struct Stage {
        unsigned type;
        std::string_view file;
    };
    void make(std::initializer_list<Stage> stages, std::string_view defines);
    int location(const char* name) const;

    GlName name_;
    std::string title_;
    std::array<int, 3> group_{1, 1, 1};
    mutable std::map<std::string, int, std::less<>> locations_;
};

}  // namespace nacre
