// The table of kernels: which are compiled in, which this machine can run, which one to use. Floor 2.
#pragma once
#include "engine/devices/kernel.h"

#include <optional>
#include <string>

namespace lfdsim {

/// A kernel that is compiled in.
struct KernelEntry {
    const char* name;
    int lanes;            // pixels of a packet
    bool (*available)();  // whether this machine can run it
    Kernel run;
};

/// Returns the kernel named by `wanted`, else by the environment variable LFDSIM_KERNEL, else the best this machine can run. Throws
/// InputError, which lists those available, for an unknown name or one that this machine cannot run.
const KernelEntry& choose_kernel(const std::string& wanted);

/// A GPU, or the CPU.
struct ChosenDevice {
    std::optional<int> gpu;  // its number, N of cuda:N; none: the CPU
    bool insists = false;    // the user named a GPU, so an error is reported and the CPU is not used instead
};

/// Returns the device named by `wanted` (RenderOptions::device), else by the environment variable LFDSIM_DEVICE, else auto. auto is
/// the first GPU that works, but the CPU where the user asks for one of its kernels. Throws InputError, which says what is missing,
/// where there is no such GPU.
ChosenDevice choose_device(const std::string& wanted, const std::string& kernel);

}  // namespace lfdsim
