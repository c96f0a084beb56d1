// The GPU's kernels of the steps. Each step has a file of its own, so that several are compiled at once. Floor 2.
#pragma once
#include "engine/wide/items.h"

#include <cuda_runtime.h>

namespace lfdsim::cuda {

constexpr int threads = optics::block_threads;

inline unsigned thread_blocks(std::int64_t items) { return unsigned((items + threads - 1) / threads); }

/// The kernels of a step, one for each way through an array; `simple` as for wide::item().
template <wide::Step step, bool simple>
struct StepKernels {
    /// Starts the kernel of the frame's display for `items` > 0 items; cudaGetLastError() tells whether it could.
    static void start(const wide::Frame& frame, std::int64_t items, cudaStream_t stream);
    /// Raises `most` to the bytes of local memory per thread of the kernel that takes most of them.
    static cudaError_t raise_to_local_bytes(std::size_t& most);
};

}  // namespace lfdsim::cuda
