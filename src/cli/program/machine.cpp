#include "cli/program/machine.h"

#include <fstream>

// The definitions come from program.cmake.
namespace lfdsim::cli {

std::string processor() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    return "unknown";
}

std::string compiler() { return LFDSIM_COMPILER; }
std::string build_type() { return LFDSIM_BUILD_TYPE; }
std::string flags() { return LFDSIM_FLAGS; }

std::string kernel_flags(const std::string& kernel) {
    if (kernel == "scalar") return LFDSIM_FLAGS_SCALAR;
    if (kernel == "baseline") return LFDSIM_FLAGS_BASELINE;
    if (kernel == "avx2") return LFDSIM_FLAGS_AVX2;
    return LFDSIM_FLAGS_AVX512;
}

}  // namespace lfdsim::cli
