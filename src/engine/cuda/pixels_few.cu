// Kernels of pixels whose square is cut into few strata.
#include "engine/cuda/step_kernels.cuh"

template struct lfdsim::cuda::StepKernels<lfdsim::wide::Step::pixels, true>;
