// The table of kernels: which are compiled in, which this machine can run, which one to take. Floor 2.
#pragma once
#include "engine/kernel.h"
#include "engine/render.h"

#include <optional>
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

/// A GPU, or the CPU. `insists`: the user named a GPU, and an error is better than the CPU.
struct ChosenDevice {
    std::optional<int> gpu;
    bool insists = false;
};

/// The device named by `wanted` (RenderOptions::device). auto takes the first GPU that works, but keeps to the CPU where the user
/// asks for one of its kernels. Throws InputError that says what is missing where there is no such GPU.
ChosenDevice choose_device(const std::string& wanted, const std::string& kernel);

/// The device of renderings that name none; as long as none is set, the environment variable LFDSIM_DEVICE says it, else auto.
/// Throws InputError as choose_device. To be called before work begins.
void set_default_device(const std::string&);

}  // namespace lfdsim
