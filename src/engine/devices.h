// The table of kernels: which are compiled in, which this machine can run, which one to take. Floor 2.
#pragma once
#include "engine/kernel.h"
#include "engine/render.h"

#include <string>

namespace lfdsim {

struct KernelEntry {
    const char* name;
    int lanes;
    bool (*available)();
    Kernel run;
};

/// The kernel named by `wanted`, else by the environment variable LFDSIM_KERNEL, else the best this machine has. Throws InputError
/// that lists what there is for an unknown name or one that this machine lacks.
const KernelEntry& choose_kernel(const std::string& wanted);

}  // namespace lfdsim
