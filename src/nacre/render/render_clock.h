#pragma once
// Times of a render: since when, until when, of how many processors.
#include <chrono>

namespace nacre {

double seconds_since(std::chrono::steady_clock::time_point start);
/// Of all threads of the process.
double process_cpu_seconds();
/// When something that begins now has to end; 0 seconds: never.
std::chrono::steady_clock::time_point deadline_after(double seconds);

}  // namespace nacre
