#include "nacre/realtime/gl/objects.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>

#include "nacre/math/error.h"

namespace nacre {
namespace {

struct FormatWords {
    GLenum inner, components;
    int count, bytes;
};
FormatWords words_of(TexelFormat format) {
    switch (format) {
        case TexelFormat::r32ui:
            return {GL_R32UI, GL_RED_INTEGER, 1, 4};
        case TexelFormat::r32f:
            return {GL_R32F, GL_RED, 1, 4};
        case TexelFormat::rgba16f:
            return {GL_RGBA16F, GL_RGBA, 4, 8};
        case TexelFormat::rgba32f:
            return {GL_RGBA32F, GL_RGBA, 4, 16};
        case TexelFormat::rgba8:
            return {GL_RGBA8, GL_RGBA, 4, 4};
    }
    return {};
}

/// An allocation that fails leaves an error and no object: looked for at once, where its size is
/// known. Errors that others left are theirs.
void forget_errors() {
    while (glGetError() != GL_NO_ERROR) {
    }
}

}  // namespace

Texture::Texture(TexelFormat format, int width, int height, int levels)
    : format_(format), width_(width), height_(height), levels_(levels) {
    GLint largest = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    if (width > largest || height > largest)
        throw RunError(
            fmt::format("a picture of {} x {} does not fit the device, which takes {} x {} at most",
                        width, height, largest, largest));
    const FormatWords words = words_of(format);
    GLuint name = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &name);
    name_ = GlName(name);
    forget_errors();
    glTextureStorage2D(name, levels, words.inner, width, height);
    if (glGetError() == GL_OUT_OF_MEMORY)
        throw RunError(fmt::format("the device has no room for a picture of {} x {} ({} MB)", width,
                                   height, bytes() / 1000000));
    const bool whole = format == TexelFormat::r32ui;
    const GLint filter = whole ? GL_NEAREST : GL_LINEAR;
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER,
                        !whole && levels > 1 ? GL_LINEAR_MIPMAP_LINEAR : filter);
    glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, filter);
    glTextureParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

Texture::~Texture() {
    if (const GLuint name = name_.get()) glDeleteTextures(1, &name);
}

std::size_t Texture::bytes() const {
    std::size_t texels = 0;
    for (int l = 0; l < levels_; ++l)
        texels += std::size_t(std::max(1, width_ >> l)) * std::size_t(std::max(1, height_ >> l));
    return texels * std::size_t(words_of(format_).bytes);
}

void Texture::end_at_edge() {
    constexpr float nothing[4] = {};
    glTextureParameteri(name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
    glTextureParameteri(name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
    glTextureParameterfv(name(), GL_TEXTURE_BORDER_COLOR, nothing);
}

void Texture::upload(std::span<const float> texels) {
    const FormatWords words = words_of(format_);
    if (texels.size() != std::size_t(width_) * height_ * words.count)
        throw RunError(fmt::format("a picture of {} x {} was given {} numbers instead of {}",
                                   width_, height_, texels.size(),
                                   std::size_t(width_) * height_ * words.count));
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTextureSubImage2D(name(), 0, 0, 0, width_, height_, words.components, GL_FLOAT,
                        texels.data());
}

std::vector<float> Texture::read(int level) const {
    const FormatWords words = words_of(format_);
    std::vector<float> texels(std::size_t(std::max(1, width_ >> level)) *
                              std::size_t(std::max(1, height_ >> level)) * words.count);
    glGetTextureImage(name(), level, words.components, GL_FLOAT,
                      GLsizei(texels.size() * sizeof(float)), texels.data());
    return texels;
}

std::vector<std::uint32_t> Texture::read_integers() const {
    std::vector<std::uint32_t> texels(std::size_t(width_) * height_);
    glGetTextureImage(name(), 0, GL_RED_INTEGER, GL_UNSIGNED_INT,
                      GLsizei(texels.size() * sizeof(std::uint32_t)), texels.data());
    return texels;
}

Buffer::Buffer(std::size_t bytes, const void* data) : bytes_(bytes) {
    GLuint name = 0;
    glCreateBuffers(1, &name);
    name_ = GlName(name);
    forget_errors();
    glNamedBufferStorage(name, GLsizeiptr(std::max<std::size_t>(bytes, 4)), bytes ? data : nullptr,
                         GL_DYNAMIC_STORAGE_BIT);
    if (glGetError() == GL_OUT_OF_MEMORY)
        throw RunError(fmt::format("the device has no room for {} MB", bytes / 1000000));
}

Buffer::~Buffer() {
    if (const GLuint name = name_.get()) glDeleteBuffers(1, &name);
}

void Buffer::write(std::size_t offset, std::size_t bytes, const void* data) {
    glNamedBufferSubData(name(), GLintptr(offset), GLsizeiptr(bytes), data);
}

void Buffer::read(std::size_t offset, std::size_t bytes, void* data) const {
    glGetNamedBufferSubData(name(), GLintptr(offset), GLsizeiptr(bytes), data);
}

}  // namespace nacre
