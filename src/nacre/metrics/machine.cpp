#include "nacre/metrics/machine.h"

#include <malloc.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <thread>

namespace nacre {
namespace {

/// The text after "NAME" and blanks, tabs or colons in the first line that begins with it.
std::string field(const std::string& file, const std::string& name) {
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);)
        if (line.starts_with(name)) {
            const std::size_t at = line.find_first_not_of(": \t", name.size());
            return at == line.npos ? "" : line.substr(at);
        }
    return {};
}

/// A line of /proc/PROCESS/status, "VmHWM: 1234 kB", in MB.
double status_mb(const char* name, const std::string& process = "self") {
    const std::string text = field("/proc/" + process + "/status", name);
    return text.empty() ? 0 : std::stod(text) * 1024e-6;
}

}  // namespace

Machine this_machine() {
    Machine m;
    m.processor = field("/proc/cpuinfo", "model name");
    if (m.processor.empty()) m.processor = "unknown processor";
    m.threads = std::max(1, int(std::thread::hardware_concurrency()));
    m.memory_gb = double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGESIZE)) * 1e-9;
    utsname name{};
    if (uname(&name) == 0) m.system = std::string(name.sysname) + " " + name.release;
    return m;
}

double peak_memory_of(int process) { return status_mb("VmHWM", std::to_string(process)); }

PeakMemory::PeakMemory() {
    malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << "5";  // proc(5): resets the peak resident size
    before_ = status_mb("VmRSS");
}

double PeakMemory::mb() const { return std::max(0., status_mb("VmHWM") - before_); }

}  // namespace nacre
