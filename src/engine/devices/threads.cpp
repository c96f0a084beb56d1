#include "engine/devices/threads.h"

#include <tbb/global_control.h>
#include <tbb/info.h>

#include <pthread.h>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <limits>
#include <semaphore>
#include <thread>
#include <vector>

namespace lfdsim {
namespace {

constexpr std::size_t stack_bytes = 4 << 20;  // of a worker of TBB
constexpr int spare = 3;                      // for a picture made ahead, writers of files, and the process that reads a model
int thread_limit = std::numeric_limits<int>::max();  // set by use_only_threads_to_be_had()

/// Returns the number of threads of this process, as the system counts them.
std::ptrdiff_t tasks() {
    std::error_code error;
    return std::distance(std::filesystem::directory_iterator("/proc/self/task", error), {});
}

/// Waits until the system counts no more than `before` threads, 100 ms at most: a thread that was joined still counts for a moment,
/// in which another one would be refused.
void wait_for_release(std::ptrdiff_t before) {
    using namespace std::chrono_literals;
    for (int k = 0; k < 100 && tasks() > before; ++k) std::this_thread::sleep_for(1ms);
    std::this_thread::sleep_for(2ms);  // the count of a group of processes falls a little later
}

}  // namespace

int threads_to_be_had(int wanted) {
    // Each thread waits for `end` and hands it on to the next, so that all of them exist at once.
    std::binary_semaphore end(0);
    const auto wait = [](void* until) -> void* {
        auto& semaphore = *static_cast<std::binary_semaphore*>(until);
        semaphore.acquire();
        semaphore.release();
        return nullptr;
    };
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    pthread_attr_setstacksize(&attributes, stack_bytes);
    const std::ptrdiff_t before = tasks();
    std::vector<pthread_t> threads(std::size_t(std::max(wanted, 0)));
    std::size_t had = 0;
    while (had < threads.size() && pthread_create(&threads[had], &attributes, wait, &end) == 0) ++had;
    end.release();
    for (std::size_t k = 0; k < had; ++k) pthread_join(threads[k], nullptr);
    pthread_attr_destroy(&attributes);
    if (had < threads.size()) wait_for_release(before);
    return int(had);
}

void use_only_threads_to_be_had() {
    const int wanted = tbb::info::default_concurrency() - 1 + spare, had = threads_to_be_had(wanted);
    if (had >= wanted) return;
    thread_limit = 1 + std::max(had - spare, 0);
    // The limit is never destroyed: when it ends, TBB starts threads.
    static_cast<void>(new tbb::global_control(tbb::global_control::max_allowed_parallelism, std::size_t(thread_limit)));
}

int threads_used(int wanted) { return std::min(wanted > 0 ? wanted : tbb::info::default_concurrency(), thread_limit); }

}  // namespace lfdsim
