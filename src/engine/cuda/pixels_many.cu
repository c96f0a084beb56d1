// Kernels of pixels whose square is cut into many strata.
#include "engine/cuda/step_kernels.cuh"

template struct lfdsim::cuda::StepKernels<lfdsim::wide::Step::pixels, false>;
