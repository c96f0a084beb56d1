// Work on a number of threads. Floor 0; what includes it links oneTBB.
#pragma once
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cstddef>

namespace lfdsim {

/// The most threads that may be asked for.
inline constexpr int most_threads = 1024;

/// Returns do_it(), whose parallel loops use `threads` threads; 0: one for each processor.
template <class Do>
auto on_threads(int threads, const Do& do_it) {
    const int processors = tbb::info::default_concurrency(), workers = threads > 0 ? threads : processors;
    // TBB uses at most as many threads as there are processors unless set otherwise; the user may ask for more.
    const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism, std::size_t(std::max(workers, processors)));
    tbb::task_arena arena(workers);
    return arena.execute(do_it);
}

}  // namespace lfdsim
