// Kernels of point samples that are random.
#include "engine/cuda/point_kernels.cuh"

template struct lfdsim::cuda::PointKernels<false>;
