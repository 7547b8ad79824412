#include "nacre/realtime/gl/program.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "nacre/math/error.h"
#include "nacre/text/split_words.h"

namespace nacre {
namespace {

std::string_view text_of(std::string_view file) {
    const auto& all = shader_files();
    const auto found = std::ranges::find(all, file, &ShaderFile::name);
    if (found == all.end()) throw RunError(fmt::format("there is no shader file '{}'", file));
    return found->text;
}

/// Appends the file's lines; `#line` keeps the compiler's numbers those of the file, and the
/// number of the source string tells which (Program looks it up in `files`).
void append(std::string_view file, std::vector<std::string>& files, std::string& source) {
    const std::size_t index = files.size();
    files.emplace_back(file);
    source += fmt::format("#line 1 {}\n", index);
    std::string_view rest = text_of(file);
    int number = 1;
    while (!rest.empty()) {
        const std::size_t end = rest.find('\n');
        const std::string_view line = rest.substr(0, end);
        rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
        ++number;
        constexpr std::string_view include = "#include \"";
        if (line.starts_with(include)) {
            const std::string_view other =
                line.substr(include.size(), line.rfind('"') - include.size());
            if (std::ranges::find(files, other) == files.end()) append(other, files, source);
            source += fmt::format("#line {} {}\n", number, index);
        } else {
            source += line;
            source += '\n';
        }
    }
}

std::string source_of(std::string_view file, std::string_view defines,
                      std::vector<std::string>& files) {
    std::string source = "#version 450 core\n";
    for (const std::string_view define : split_words(defines)) {
        const std::size_t equals = define.find('=');
        source += fmt::format("#define {} {}\n", define.substr(0, equals),
                              equals == std::string_view::npos ? "" : define.substr(equals + 1));
    }
    append(file, files, source);
    return source;
}

/// What the driver says of a shader or a program, without its last line break.
template <class Get, class GetLog>
std::string log_of(GLuint name, Get get, GetLog get_log) {
    GLint length = 0;
    get(name, GL_INFO_LOG_LENGTH, &length);
    std::string text(std::size_t(std::max(length, 1)), '\0');
    get_log(name, length, nullptr, text.data());
    while (!text.empty() && (text.back() == '\0' || text.back() == '\n')) text.pop_back();
    return text;
}

}  // namespace

std::string shader_source(std::string_view file, std::string_view defines) {
    std::vector<std::string> files;
    return source_of(file, defines, files);
}

Program::Program(std::string_view file, std::string_view defines)
    : title_(defines.empty() ? std::string(file) : fmt::format("{} ({})", file, defines)) {
    make({{GL_COMPUTE_SHADER, file}}, defines);
    GLint size[3];
    glGetProgramiv(name(), GL_COMPUTE_WORK_GROUP_SIZE, size);
    group_ = {size[0], size[1], size[2]};
}

Program::Program(const Raster& files)
    : title_(fmt::format("{} and {}", files.vertex, files.fragment)) {
    make({{GL_VERTEX_SHADER, files.vertex}, {GL_FRAGMENT_SHADER, files.fragment}}, "");
}

void Program::make(std::initializer_list<Stage> stages, std::string_view defines) {
    // Owned from the start: it goes when something is thrown.
    name_ = GlName(glCreateProgram());
    const auto fail = [&](const std::vector<std::string>& files, const std::string& log) {
        if (const GLuint program = std::exchange(name_, GlName()).get()) glDeleteProgram(program);
        std::string numbers;
        for (std::size_t i = 0; i < files.size(); ++i)
            numbers += fmt::format("{}{} is {}", i ? ", " : "", i, files[i]);
        throw RunError(fmt::format("the shader {} cannot be compiled by this driver ({}): {}",
                                   title_, numbers, log));
    };
    std::vector<std::string> files;
    for (const Stage& stage : stages) {
        files.clear();
        const std::string source = source_of(stage.file, defines, files);
        const GLuint shader = glCreateShader(stage.type);
        const char* text = source.c_str();
        glShaderSource(shader, 1, &text, nullptr);
        glCompileShader(shader);
        GLint compiled = 0;
        glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
        const std::string log = compiled ? "" : log_of(shader, glGetShaderiv, glGetShaderInfoLog);
        glAttachShader(name(), shader);
        glDeleteShader(shader);  // goes with the program
        if (!compiled) fail(files, log);
    }
    glLinkProgram(name());
    GLint linked = 0;
    glGetProgramiv(name(), GL_LINK_STATUS, &linked);
    if (!linked) fail(files, log_of(name(), glGetProgramiv, glGetProgramInfoLog));
}

Program::~Program() {
    if (name_.get()) glDeleteProgram(name_.get());
}

int Program::location(const char* name) const {
    const auto found = locations_.find(std::string_view(name));
    if (found != locations_.end()) return found->second;
    const int location = glGetUniformLocation(this->name(), name);
    locations_.emplace(name, location);
    return location;
}

void Program::set(const char* n, int v) const { glProgramUniform1i(name(), location(n), v); }
void Program::set(const char* n, std::uint32_t v) const {
    glProgramUniform1ui(name(), location(n), v);
}
void Program::set(const char* n, float v) const { glProgramUniform1f(name(), location(n), v); }
void Program::set(const char* n, Vec2f v) const {
    glProgramUniform2f(name(), location(n), v.x, v.y);
}
void Program::set(const char* n, const Vec3f& v) const {
    glProgramUniform3f(name(), location(n), v.x, v.y, v.z);
}
void Program::set(const char* n, const std::array<float, 4>& v) const {
    glProgramUniform4fv(name(), location(n), 1, v.data());
}
void Program::set(const char* n, const Mat4& v) const {
    glProgramUniformMatrix4fv(name(), location(n), 1, GL_FALSE, v.data());
}

}  // namespace nacre
