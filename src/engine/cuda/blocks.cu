// Kernels of the steps that are the same for every display.
#include "engine/cuda/step_kernels.cuh"

template struct lfdsim::cuda::StepKernels<lfdsim::wide::Step::even, true>;
template struct lfdsim::cuda::StepKernels<lfdsim::wide::Step::blocks, true>;
template struct lfdsim::cuda::StepKernels<lfdsim::wide::Step::survey, true>;
template struct lfdsim::cuda::StepKernels<lfdsim::wide::Step::places, true>;
template struct lfdsim::cuda::StepKernels<lfdsim::wide::Step::soft, true>;
