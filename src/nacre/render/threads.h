#pragma once
// How many threads a piece of work may use.
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

namespace nacre {

/// Runs `work` with as many threads as asked for, more than there are cores if need be; 0: as many
/// as the caller has.
template <class Work>
auto with_threads(int threads, Work&& work) {
    if (threads <= 0) return work();
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    std::size_t(threads));
    tbb::task_arena arena(threads);
    return arena.execute(work);
}

}  // namespace nacre
