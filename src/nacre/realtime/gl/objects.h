#pragma once
// Textures and buffers of OpenGL, each with its owner. All calls need the context that made them to
// be current.
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace nacre {

/// What a texel is.
enum class TexelFormat { r32ui, r32f, rgba16f, rgba32f, rgba8 };

/// A name of OpenGL that is given back when its owner dies.
class GlName {
  public:
    GlName() = default;
    explicit GlName(std::uint32_t name) : name_(name) {}
    GlName(GlName&& o) noexcept : name_(std::exchange(o.name_, 0)) {}
    GlName& operator=(GlName&& o) noexcept {
        std::swap(name_, o.name_);
        return *this;
    }
    std::uint32_t get() const { return name_; }

  private:
    std::uint32_t name_ = 0;
};

/// A picture on the device, with its smaller levels.
class Texture {
  public:
    Texture() = default;
    /// Filtered linearly (whole numbers: not at all), clamped to its
    /// edge. Its texels are undefined. Throws RunError if the device has no room.
    Texture(TexelFormat format, int width, int height, int levels = 1);
    ~Texture();
    Texture(Texture&&) noexcept = default;
    Texture& operator=(Texture&&) noexcept = default;

    std::uint32_t name() const { return name_.get(); }
    TexelFormat format() const { return format_; }
    int width() const { return width_; }
    int height() const { return height_; }
    int levels() const { return levels_; }
    bool is(int width, int height) const { return width == width_ && height == height_; }
    std::size_t bytes() const;  ///< with all levels

    /// What is sampled beyond the edge is 0, not the edge's texel.
    void end_at_edge();
    /// Level 0 from floats, as many components a texel as the format has; top row first is up to
    /// who reads it.
    void upload(std::span<const float> texels);
    /// A level as floats, four components a texel (r32f: one).
    std::vector<float> read(int level = 0) const;
    std::vector<std::uint32_t> read_integers() const;

  private:
    GlName name_;
    TexelFormat format_ = TexelFormat::rgba32f;
    int width_ = 0, height_ = 0, levels_ = 0;
};

/// Bytes on the device.
class Buffer {
  public:
    Buffer() = default;
    /// Throws RunError if the device has no room.
    Buffer(std::size_t bytes, const void* data);
    template <class T>
    explicit Buffer(const std::vector<T>& data) : Buffer(data.size() * sizeof(T), data.data()) {
        static_assert(std::is_trivially_copyable_v<T>);
    }
    ~Buffer();
    Buffer(Buffer&&) noexcept = default;
    Buffer& operator=(Buffer&&) noexcept = default;

    std::uint32_t name() const { return name_.get(); }
    std::size_t bytes() const { return bytes_; }
    void write(std::size_t offset, std::size_t bytes, const void* data);
    void read(std::size_t offset, std::size_t bytes, void* data) const;

  private:
    GlName name_;
    std::size_t bytes_ = 0;
};

}  // namespace nacre
