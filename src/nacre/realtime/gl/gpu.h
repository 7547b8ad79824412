#pragma once
// The device as passes use it: programs, each compiled once; passes that say what they read and
// write, are timed, and whose errors name them.
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "nacre/realtime/gl/device.h"
#include "nacre/realtime/gl/objects.h"
#include "nacre/realtime/gl/program.h"

namespace nacre {

/// What a pass took in a frame; passes of one name are added.
struct PassTime {
    std::string name;
    double ms = 0;
};

class ComputePass;

/// Belongs to one context, which is current whenever it is used.
class Gpu {
  public:
    /// Of the context that is current on this thread. Throws RunError if that is too old.
    Gpu();
    ~Gpu();
    Gpu(const Gpu&) = delete;
    Gpu& operator=(const Gpu&) = delete;

    const GpuDevice& device() const { return device_; }
    /// Compiled when first asked for.
    const Program& program(std::string_view file, std::string_view defines = "");
    const Program& program(const Program::Raster& files);
    /// A pass of a compute program: say what it reads and writes, then dispatch.
    ComputePass compute(std::string_view pass, const Program& program);

    /// Anything else as a pass: timed, and its errors named.
    template <class F>
    void pass(std::string_view name, F&& work) {
        begin_pass(name);
        work();
        end_pass();
    }

    /// Passes are timed from here on until `times`: by timer queries on hardware, by waiting for
    /// each pass in software, whose queries read nothing. Without it nothing waits.
    void begin_timing();
    /// What the passes since took, in the order of their first appearance; waits for them.
    std::vector<PassTime> end_timing();
    /// Waits until all that was asked for is done.
    void finish();
    /// Throws RunError with the first error that the driver reported, and the pass in which.
    void check_errors();

    struct State;  ///< stays where it is: the driver reports errors to it

  private:
    friend class ComputePass;
    void begin_pass(std::string_view pass);
    void end_pass();

    std::unique_ptr<State> state_;
    GpuDevice device_;
    std::vector<std::pair<std::string, std::unique_ptr<Program>>> programs_;
};

/// One dispatch of a compute program. What a pass writes is visible to all that come after it.
class ComputePass {
  public:
    /// A texture, sampled through `layout(binding = unit) uniform sampler2D`.
    ComputePass& reads(int unit, const Texture& texture);
    /// A level of a texture as an image, `layout(binding = unit, FORMAT) uniform image2D`.
    ComputePass& writes(int unit, const Texture& texture, int level = 0);
    ComputePass& reads_image(int unit, const Texture& texture, int level = 0);
    /// `layout(std430, binding = unit) buffer`.
    ComputePass& reads(int unit, const Buffer& buffer);
    ComputePass& writes(int unit, const Buffer& buffer);
    template <class T>
    ComputePass& set(const char* name, const T& value) {
        program_.set(name, value);
        return *this;
    }

    /// So many threads at least along each axis, in whole workgroups.
    void threads(int x, int y = 1, int z = 1);
    /// Workgroups along x, y, z from three whole numbers in a buffer.
    void groups_of(const Buffer& buffer, std::size_t offset = 0);

  private:
    friend class Gpu;
    ComputePass(Gpu& gpu, std::string_view pass, const Program& program);
    void finish();

    Gpu& gpu_;
    std::string pass_;
    const Program& program_;
};

}  // namespace nacre
