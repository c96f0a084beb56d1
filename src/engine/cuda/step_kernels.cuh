// Defines StepKernels; a file that includes this instantiates it for one step. Floor 2.
#pragma once
#include "engine/cuda/step_kernels.h"

#include <algorithm>

namespace lfdsim::cuda {

namespace {

using wide::Step;

/// Thread blocks that a multiprocessor is to hold at once at least, which limits the registers of a step's kernel: measured on an
/// H100 (docs/gpu.md).
constexpr int least_blocks(Step step) {
    return step == Step::points ? 6 : step == Step::bundles || step == Step::pixels ? 4 : step == Step::places ? 8 : 1;
}

template <Step step, optics::Way through, bool simple>
__global__ void __launch_bounds__(threads, least_blocks(step))
    step_kernel(const __grid_constant__ wide::Frame frame, std::int64_t items) {
    const std::int64_t i = std::int64_t(blockIdx.x) * threads + threadIdx.x;
    if (i < items) wide::item<step, through, simple>(frame, i);
}

}  // namespace

template <Step step, bool simple>
void StepKernels<step, simple>::start(const wide::Frame& frame, std::int64_t items, cudaStream_t stream) {
    wide::with_way_of_step<step>(frame, [&]<optics::Way way>() {
        step_kernel<step, way, simple><<<thread_blocks(items), threads, 0, stream>>>(frame, items);
    });
}

template <Step step, bool simple>
cudaError_t StepKernels<step, simple>::raise_to_local_bytes(std::size_t& most) {
    cudaError_t result = cudaSuccess;
    wide::for_all_ways_of_step<step>([&]<optics::Way way>() {
        cudaFuncAttributes attributes;
        const cudaError_t asked = cudaFuncGetAttributes(&attributes, step_kernel<step, way, simple>);
        if (asked == cudaSuccess)
            most = std::max(most, attributes.localSizeBytes);
        else
            result = asked;
    });
    return result;
}

}  // namespace lfdsim::cuda
