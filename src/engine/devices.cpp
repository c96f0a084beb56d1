#include "engine/devices.h"

#include <cstdlib>

namespace lfdsim {

namespace {

bool always() { return true; }
bool has_avx2() { return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2"); }
bool has_avx512() {
    return has_avx2() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl");
}

constexpr KernelEntry kTable[] = {
    // best first
    {"avx512", 16, has_avx512, render_tile_avx512},
    {"avx2", 8, has_avx2, render_tile_avx2},
    {"baseline", 4, always, render_tile_baseline},
    {"scalar", 1, always, render_tile_scalar},
};

}  // namespace

std::vector<KernelInfo> kernels() {
    std::vector<KernelInfo> all;
    for (const KernelEntry& k : kTable) all.push_back({k.name, k.available(), k.lanes});
    return all;
}

const KernelEntry& choose_kernel(const std::string& wanted) {
    const char* const forced = std::getenv("LFDSIM_KERNEL");
    const bool from_environment = wanted.empty() && forced && *forced;
    const std::string name = from_environment ? forced : wanted;
    std::string present;
    for (const KernelEntry& k : kTable) {
        if (!k.available()) continue;
        if (name.empty() || name == k.name) return k;
        present += (present.empty() ? "" : ", ") + std::string(k.name);
    }
    bool known = false;
    for (const KernelEntry& k : kTable) known = known || name == k.name;
    throw InputError(from_environment ? "environment variable LFDSIM_KERNEL" : "--kernel",
                     (known ? "this machine cannot run kernel '" : "unknown kernel '") + name + "'; it can run: " + present);
}

}  // namespace lfdsim
