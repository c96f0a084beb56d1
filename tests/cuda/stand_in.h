// A stand-in for the CUDA runtime: GPUs that are this process, so that the GPU's queue (src/engine/cuda/queue.cu) and what stands
// on it run on any machine. Linked before the runtime, it takes its place.
//
// It is as unkind as CUDA may be. What is handed to a stream happens when somebody waits for it, and not before; the items of a
// kernel are worked off by several threads in any order. Memory begins with rubbish, ends where a page begins that kills whoever
// touches it, and is gone once it is freed. A device that failed fails for ever.
//
// The environment variable LFDSIM_STAND_IN changes what there is: "driver=12.0 gpus=2 capability=6.1 memory_mb=100
// fail=FUNCTION:N", the Nth call of FUNCTION being the one that fails.
#pragma once
#include <cuda_runtime_api.h>

#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <string>

namespace stand_in {

/// Ends the program: CUDA's runtime is used in a way that CUDA might or might not tell of.
[[noreturn]] void misused(const std::string& what);

/// What every function of the runtime answers before it does anything; takes note of an error, as told() does.
cudaError_t enter(const char* function);
cudaError_t told(cudaError_t);

/// The thread's GPU.
int current_gpu();

/// Work in order, done when somebody waits for it.
struct Stream {
    int gpu;
    std::mutex mutex, order;
    std::deque<std::function<void()>> later;

    void add(std::function<void()> work) {
        if (gpu != current_gpu()) misused("a stream of another GPU than the thread's");
        const std::lock_guard lock(mutex);
        later.push_back(std::move(work));
    }
    void wait() {
        const std::lock_guard in_order(order);
        for (;;) {
            std::function<void()> work;
            {
                const std::lock_guard lock(mutex);
                if (later.empty()) return;
                work = std::move(later.front());
                later.pop_front();
            }
            work();
        }
    }
};
inline Stream* stream_of(cudaStream_t s) { return reinterpret_cast<Stream*>(s); }

/// Is this the host's side of a kernel?
bool is_kernel(const void*);

}  // namespace stand_in
