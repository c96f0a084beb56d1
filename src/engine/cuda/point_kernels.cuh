// Defines PointKernels; a file that includes this instantiates it for one sampler. Floor 2.
#pragma once
#include "engine/cuda/point_kernels.h"
#include "engine/wide/items.h"
#include "optics/trace.h"

#include <algorithm>

namespace lfdsim::cuda {

namespace {

/// Thread blocks that a multiprocessor is to hold at once at least, which limits a kernel's registers: measured on an H100
/// (docs/gpu.md).
constexpr int least_blocks = 6;

/// Computes one item of the frame in each thread. `row` is a row of optics::Specialisations.
template <int row, bool sobol>
__global__ void __launch_bounds__(threads, least_blocks)
    point_kernel(const __grid_constant__ wide::Frame frame, std::int64_t items) {
    const std::int64_t i = std::int64_t(blockIdx.x) * threads + threadIdx.x;
    if (i < items) wide::point_item<optics::Specialisations::row[row], sobol>(frame, i);
}

}  // namespace

template <bool sobol>
void PointKernels<sobol>::start(const wide::Frame& frame, std::int64_t items, cudaStream_t stream) {
    optics::with_facts(frame.display, [&]<optics::Facts facts>() {
        point_kernel<optics::Specialisations::number_of<facts>(), sobol>
            <<<thread_blocks(items), threads, 0, stream>>>(frame, items);
    });
}

template <bool sobol>
cudaError_t PointKernels<sobol>::raise_to_local_bytes(std::size_t& most) {
    cudaError_t result = cudaSuccess;
    optics::for_all_specialisations([&]<optics::Facts facts>() {
        cudaFuncAttributes attributes;
        const cudaError_t asked =
            cudaFuncGetAttributes(&attributes, point_kernel<optics::Specialisations::number_of<facts>(), sobol>);
        if (asked == cudaSuccess)
            most = std::max(most, attributes.localSizeBytes);
        else
            result = asked;
    });
    return result;
}

}  // namespace lfdsim::cuda
