#include "nacre/realtime/gl/gpu.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "nacre/math/error.h"

namespace nacre {

struct Gpu::State {
    std::string pass;   // that is going on
    std::string error;  // the first, with its pass
    bool timing = false;
    std::chrono::steady_clock::time_point begun;
    struct Timed {
        std::string name;
        GLuint queries[2];
        double ms;
    };
    std::vector<Timed> timed;
};

namespace {

void APIENTRY report(GLenum, GLenum type, GLuint, GLenum severity, GLsizei length,
                     const GLchar* message, const void* user) {
    if (type != GL_DEBUG_TYPE_ERROR || severity == GL_DEBUG_SEVERITY_NOTIFICATION) return;
    const auto take = [&](auto& state) {
        if (state.error.empty())
            state.error = fmt::format("OpenGL in the pass '{}': {}", state.pass,
                                      std::string_view(message, std::size_t(length)));
    };
    take(*static_cast<Gpu::State*>(const_cast<void*>(user)));
}

GLenum image_format(TexelFormat format) {
    switch (format) {
        case TexelFormat::r32ui:
            return GL_R32UI;
        case TexelFormat::r32f:
            return GL_R32F;
        case TexelFormat::rgba16f:
            return GL_RGBA16F;
        case TexelFormat::rgba32f:
            return GL_RGBA32F;
        case TexelFormat::rgba8:
            return GL_RGBA8;
    }
    return 0;
}

}  // namespace

Gpu::Gpu() : state_(std::make_unique<State>()), device_(current_device()) {
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(report, state_.get());
}

Gpu::~Gpu() {
    glDebugMessageCallback(nullptr, nullptr);
    end_timing();
}

const Program& Gpu::program(std::string_view file, std::string_view defines) {
    const std::string key = fmt::format("{} {}", file, defines);
    for (const auto& [name, program] : programs_)
        if (name == key) return *program;
    return *programs_.emplace_back(key, std::make_unique<Program>(file, defines)).second;
}

const Program& Gpu::program(const Program::Raster& files) {
    const std::string key = fmt::format("{} {}", files.vertex, files.fragment);
    for (const auto& [name, program] : programs_)
        if (name == key) return *program;
    return *programs_.emplace_back(key, std::make_unique<Program>(files)).second;
}

ComputePass Gpu::compute(std::string_view pass, const Program& program) {
    return {*this, pass, program};
}

void Gpu::begin_timing() {
    end_timing();
    finish();
    state_->timing = true;
}

std::vector<PassTime> Gpu::end_timing() {
    std::vector<PassTime> result;
    for (const State::Timed& t : state_->timed) {
        double ms = t.ms;
        if (!device_.software) {
            GLuint64 from = 0, to = 0;
            glGetQueryObjectui64v(t.queries[0], GL_QUERY_RESULT, &from);
            glGetQueryObjectui64v(t.queries[1], GL_QUERY_RESULT, &to);
            glDeleteQueries(2, t.queries);
            ms = double(to - from) * 1e-6;
        }
        const auto found = std::ranges::find(result, t.name, &PassTime::name);
        if (found == result.end())
            result.push_back({t.name, ms});
        else
            found->ms += ms;
    }
    state_->timed.clear();
    state_->timing = false;
    return result;
}

void Gpu::finish() { glFinish(); }

void Gpu::check_errors() {
    if (state_->error.empty()) return;
    throw RunError(std::exchange(state_->error, {}));
}

void Gpu::begin_pass(std::string_view pass) {
    state_->pass = pass;
    if (!state_->timing) return;
    State::Timed& t = state_->timed.emplace_back(std::string(pass));
    if (device_.software) {
        glFinish();
        state_->begun = std::chrono::steady_clock::now();
    } else {
        glGenQueries(2, t.queries);
        glQueryCounter(t.queries[0], GL_TIMESTAMP);
    }
}

void Gpu::end_pass() {
    if (state_->timing) {
        State::Timed& t = state_->timed.back();
        if (device_.software) {
            glFinish();
            t.ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() -
                                                             state_->begun)
                       .count();
        } else {
            glQueryCounter(t.queries[1], GL_TIMESTAMP);
        }
    }
    check_errors();
}

ComputePass::ComputePass(Gpu& gpu, std::string_view pass, const Program& program)
    : gpu_(gpu), pass_(pass), program_(program) {}

ComputePass& ComputePass::reads(int unit, const Texture& texture) {
    glBindTextureUnit(GLuint(unit), texture.name());
    return *this;
}

ComputePass& ComputePass::writes(int unit, const Texture& texture, int level) {
    glBindImageTexture(GLuint(unit), texture.name(), level, GL_FALSE, 0, GL_READ_WRITE,
                       image_format(texture.format()));
    return *this;
}

ComputePass& ComputePass::reads_image(int unit, const Texture& texture, int level) {
    glBindImageTexture(GLuint(unit), texture.name(), level, GL_FALSE, 0, GL_READ_ONLY,
                       image_format(texture.format()));
    return *this;
}

ComputePass& ComputePass::reads(int unit, const Buffer& buffer) {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, GLuint(unit), buffer.name());
    return *this;
}

ComputePass& ComputePass::writes(int unit, const Buffer& buffer) { return reads(unit, buffer); }

void ComputePass::threads(int x, int y, int z) {
    const auto groups = [&](int n, int axis) {
        const int size = program_.group()[std::size_t(axis)];
        return GLuint((n + size - 1) / size);
    };
    gpu_.begin_pass(pass_);
    glUseProgram(program_.name());
    glDispatchCompute(groups(x, 0), groups(y, 1), groups(z, 2));
    finish();
}

void ComputePass::groups_of(const Buffer& buffer, std::size_t offset) {
    gpu_.begin_pass(pass_);
    glUseProgram(program_.name());
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, buffer.name());
    glDispatchComputeIndirect(GLintptr(offset));
    finish();
}

void ComputePass::finish() {
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                    GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT |
                    GL_TEXTURE_UPDATE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    gpu_.end_pass();
}

}  // namespace nacre
