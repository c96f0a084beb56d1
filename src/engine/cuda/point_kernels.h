// The GPU's kernels of point samples. Those of each sampler are a separate file, so that both are compiled at once. Floor 2.
#pragma once
#include "engine/wide/frame.h"

#include <cuda_runtime.h>

#include <cstddef>
#include <cstdint>

namespace lfdsim::cuda {

constexpr int threads = 128;  // of a thread block

/// Returns the number of thread blocks for items, one for each thread.
inline unsigned thread_blocks(std::int64_t items) { return unsigned((items + threads - 1) / threads); }

/// The kernels of a sampler, Sobol's or random points: one for each row of optics::Specialisations.
template <bool sobol>
struct PointKernels {
    /// Starts the kernel of the frame's display for `items` > 0 items; cudaGetLastError() returns whether it could.
    static void start(const wide::Frame& frame, std::int64_t items, cudaStream_t stream);
    /// Raises `most` to the bytes of local memory per thread of the kernel that takes most of them.
    static cudaError_t raise_to_local_bytes(std::size_t& most);
};

}  // namespace lfdsim::cuda
