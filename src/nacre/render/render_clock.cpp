#include "nacre/render/render_clock.h"

#include <sys/resource.h>

#include <algorithm>

namespace nacre {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

double process_cpu_seconds() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

Clock::time_point deadline_after(double seconds) {
    // A hundred years are for ever, and fit the clock.
    constexpr double longest_s = 3e9;
    if (!(seconds > 0)) return Clock::time_point::max();
    return Clock::now() + std::chrono::duration_cast<Clock::duration>(
                              std::chrono::duration<double>(std::min(seconds, longest_s)));
}

}  // namespace nacre
