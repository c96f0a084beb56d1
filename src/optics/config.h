// The three macros of the optics. Floor 1.
#pragma once

// Everything in optics may run on the host and on a CUDA device, and must be inlined for speed on both.
#ifdef __CUDACC__
#define LFDSIM_FN __host__ __device__ __forceinline__
#else
#define LFDSIM_FN inline __attribute__((always_inline))
#endif

// For work that few rays need: kept out of the way of the registers of the many.
#ifdef __CUDACC__
#define LFDSIM_RARE __host__ __device__ __noinline__
#else
#define LFDSIM_RARE __attribute__((noinline, cold))
#endif

// The optics is compiled once per instruction set into one program. An inline namespace of its own for each keeps the linker from
// taking one instruction set's copy of a function for another's.
#ifndef LFDSIM_ISA
#define LFDSIM_ISA generic
#endif
