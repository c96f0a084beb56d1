// Kernels of pixels in blocks that share nothing.
#include "engine/cuda/step_kernels.cuh"

template struct lfdsim::cuda::StepKernels<lfdsim::wide::Step::alone, true>;
