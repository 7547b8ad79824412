#pragma once
// What was measured on, and how much memory it took.
#include <string>

namespace nacre {

struct Machine {
    std::string processor;  ///< as it calls itself
    int threads = 1;        ///< that can run at once
    double memory_gb = 0;
    std::string system;  ///< name and release of the kernel
};
Machine this_machine();

/// The most memory that a running process has held, MB; 0 if it cannot be asked. Its parent's is
/// not part of it, unlike in getrusage, where a new program begins with the peak of who started it.
double peak_memory_of(int process);

/// The most memory (MB, 10^6 bytes) that the process holds beyond what it held when this was made.
/// Pages that were freed but are kept by the allocator are given back first. Linux only: elsewhere
/// `mb` is 0. Resets the kernel's mark of the process, so that two must not overlap.
class PeakMemory {
  public:
    PeakMemory();
    double mb() const;

  private:
    double before_ = 0;
};

}  // namespace nacre
