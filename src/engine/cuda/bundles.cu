// Kernels of bundles.
#include "engine/cuda/step_kernels.cuh"

template struct lfdsim::cuda::StepKernels<lfdsim::wide::Step::bundles, true>;
