#pragma once
// Which OpenGL the current thread has, and a context without a window.
#include <memory>
#include <string>

namespace nacre {

/// What renders, as it calls itself.
struct GpuDevice {
    std::string name;       ///< GL_RENDERER
    std::string version;    ///< GL_VERSION
    bool software = false;  ///< the processor: Mesa's llvmpipe or softpipe. Never a GPU's speed.

    /// For people: "llvmpipe (LLVM 15.0.6, 256 bits) [software]".
    std::string text() const;
};
/// Of the context that is current on this thread. Throws RunError below OpenGL 4.5.
GpuDevice current_device();

/// An OpenGL 4.5 core context without a window, through EGL: of the first hardware device that
/// gives one, else of any device, else of none (surfaceless). It is current nowhere until used.
class HeadlessContext {
  public:
    /// Throws RunError that says what was tried if there is none.
    HeadlessContext();
    ~HeadlessContext();
    HeadlessContext(const HeadlessContext&) = delete;
    HeadlessContext& operator=(const HeadlessContext&) = delete;

    /// While it lives, the context is current on this thread; what was current before comes back.
    class Use {
      public:
        explicit Use(const HeadlessContext& context);
        ~Use();
        Use(const Use&) = delete;
        Use& operator=(const Use&) = delete;

      private:
        void *display_, *draw_, *read_, *context_, *own_display_;
    };

  private:
    void* display_ = nullptr;
    void* context_ = nullptr;
};

}  // namespace nacre
