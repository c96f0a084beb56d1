// The GPUs of this machine, through CUDA: which there are, what is missing, and a queue to work on one. Floor 2.
#pragma once
#include "engine/wide/queue.h"

#include <memory>
#include <string>
#include <vector>

namespace lfdsim::cuda {

struct Gpu {
    std::string name;  // as its maker names it
    int major, minor;  // compute capability
    double memory_gb;
    std::string why_not;  // empty: it can be used
};

/// What was found, and what is missing, as a message: no CUDA toolkit at build time, no NVIDIA driver, ...
struct GpuSearch {
    std::vector<Gpu> gpus;
    std::string missing;  // empty: there is a GPU that can be used
    std::string toolkit;  // CUDA version that the kernels were compiled with; empty: none
    std::string driver;   // newest CUDA version that the driver supports; empty: no driver
};
GpuSearch find();

/// Throws DeviceError. 0 <= gpu < find().gpus.size().
std::unique_ptr<wide::Queue> open(int gpu);

}  // namespace lfdsim::cuda
