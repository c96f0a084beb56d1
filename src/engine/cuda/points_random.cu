// Kernels of point samples that are random.
#include "engine/cuda/step_kernels.cuh"

template struct lfdsim::cuda::StepKernels<lfdsim::wide::Step::points, false>;
