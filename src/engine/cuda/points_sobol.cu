// Kernels of point samples that are Sobol points.
#include "engine/cuda/step_kernels.cuh"

template struct lfdsim::cuda::StepKernels<lfdsim::wide::Step::points, true>;
