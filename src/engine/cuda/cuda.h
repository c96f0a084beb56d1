// The GPUs of this machine, through CUDA: which there are, what is missing, and a queue to work on one. Floor 2.
#pragma once
#include "engine/wide/queue.h"

#include <memory>
#include <string>
#include <vector>

namespace lfdsim::cuda {

/// A GPU of this machine.
struct Gpu {
    std::string name;     // as its maker names it
    int major, minor;     // compute capability
    double memory_gb;     // in 10^9 bytes
    std::string why_not;  // why it cannot be used; empty: it can
};

/// The result of find().
struct GpuSearch {
    std::vector<Gpu> gpus;
    std::string missing;  // what is missing (a CUDA toolkit at build time, an NVIDIA driver ...); empty: some GPU can be used
    std::string toolkit;  // CUDA version that the kernels were compiled with; empty: none
    std::string driver;   // newest CUDA version that the driver supports; empty: no driver
};
/// Looks for GPUs, and tries of each whether this binary holds code for it.
GpuSearch find();

/// Opens a queue of a GPU, 0 <= gpu < find().gpus.size(). Throws DeviceError.
std::unique_ptr<wide::Queue> open(int gpu);

}  // namespace lfdsim::cuda
