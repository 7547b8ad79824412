// Visibility by the raster unit: the same pictures as by compute, but for pixels whose centres lie
// on an edge, where the two round differently.
#include <epoxy/gl.h>

#include "nacre/math/error.h"
#include "nacre/realtime/visibility.h"

namespace nacre {

struct RasterTarget {
    GLuint frame = 0, depth = 0, no_vertices = 0;

    RasterTarget(const Texture& bits, const Texture& ids) {
        glCreateRenderbuffers(1, &depth);
        glNamedRenderbufferStorage(depth, GL_DEPTH_COMPONENT32F, bits.width(), bits.height());
        glCreateFramebuffers(1, &frame);
        glNamedFramebufferTexture(frame, GL_COLOR_ATTACHMENT0, bits.name(), 0);
        glNamedFramebufferTexture(frame, GL_COLOR_ATTACHMENT1, ids.name(), 0);
        glNamedFramebufferRenderbuffer(frame, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
        const GLenum buffers[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
        glNamedFramebufferDrawBuffers(frame, 2, buffers);
        glCreateVertexArrays(1, &no_vertices);
        if (glCheckNamedFramebufferStatus(frame, GL_DRAW_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
            throw RunError(
                "this driver cannot draw into pictures of whole numbers: use visibility by "
                "compute");
    }
    ~RasterTarget() {
        glDeleteVertexArrays(1, &no_vertices);
        glDeleteFramebuffers(1, &frame);
        glDeleteRenderbuffers(1, &depth);
    }
    RasterTarget(const RasterTarget&) = delete;
    RasterTarget& operator=(const RasterTarget&) = delete;
};

Visibility::Visibility(std::uint32_t tiles) : tile_capacity_(tiles) {}
Visibility::~Visibility() = default;
Visibility::Visibility(Visibility&&) noexcept = default;
Visibility& Visibility::operator=(Visibility&&) noexcept = default;
void Visibility::drop_target() { target_.reset(); }

void Visibility::see_by_raster(Gpu& gpu, const GpuScene& scene, std::uint32_t triangles,
                               const View& view, std::string_view pass) {
    if (!target_) target_ = std::make_unique<RasterTarget>(depth_, ids_);
    const Program& program = gpu.program(
        {.vertex = "visibility_raster.vert.glsl", .fragment = "visibility_raster.frag.glsl"});
    program.set("clip", view.clip);
    gpu.pass(pass, [&] {
        GLint before = 0;
        glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &before);
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target_->frame);
        glViewport(0, 0, view.width, view.height);
        const GLuint none[4] = {};
        const GLfloat far = 0.f;
        glClearNamedFramebufferuiv(target_->frame, GL_COLOR, 0, none);
        glClearNamedFramebufferuiv(target_->frame, GL_COLOR, 1, none);
        glClearNamedFramebufferfv(target_->frame, GL_DEPTH, 0, &far);
        glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_GREATER);
        glDepthMask(GL_TRUE);
        glDisable(GL_CULL_FACE);
        glDisable(GL_BLEND);
        glDisable(GL_SCISSOR_TEST);
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, scene.positions().name());
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, scene.indices().name());
        glUseProgram(program.name());
        glBindVertexArray(target_->no_vertices);
        glDrawArrays(GL_TRIANGLES, 0, GLsizei(3 * triangles));
        glDisable(GL_DEPTH_TEST);
        glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, GLuint(before));
        glMemoryBarrier(GL_ALL_BARRIER_BITS);
    });
}

}  // namespace nacre
