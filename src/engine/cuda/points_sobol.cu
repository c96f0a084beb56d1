// Kernels of point samples at Sobol's points.
#include "engine/cuda/point_kernels.cuh"

template struct lfdsim::cuda::PointKernels<true>;
