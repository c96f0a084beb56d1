// The macros of functions that run on the host and on a GPU. Floor 0.
#pragma once

// What runs on the host and on a CUDA device. LFDSIM_FN must be inlined for speed; LFDSIM_BOTH may be;
// LFDSIM_LARGE must be on the CPU only; LFDSIM_APART must not, as its stack or its code is large; LFDSIM_RARE is for work that few
// rays need, kept out of line so that it takes no registers from the rest.
#ifdef __CUDACC__
#define LFDSIM_FN __host__ __device__ __forceinline__
#define LFDSIM_BOTH __host__ __device__
#define LFDSIM_LARGE __host__ __device__ __noinline__
#define LFDSIM_APART __host__ __device__ __noinline__
#define LFDSIM_RARE __host__ __device__ __noinline__
#else
#define LFDSIM_FN inline __attribute__((always_inline))
#define LFDSIM_BOTH
#define LFDSIM_LARGE LFDSIM_FN
#define LFDSIM_APART __attribute__((noinline))
#define LFDSIM_RARE __attribute__((noinline, cold))
#endif
