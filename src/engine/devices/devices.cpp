#include "engine/devices/devices.h"

#include "base/job.h"
#include "base/whole_text.h"
#include "engine/devices/gpu.h"
#include "engine/render.h"

#include <cstdlib>

namespace lfdsim {

namespace {

bool always() { return true; }
[[maybe_unused]] bool has_avx2() {
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2");
}
[[maybe_unused]] bool has_avx512() {
    return has_avx2() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl");
}

constexpr KernelEntry all_kernels[] = {
// Best first. The option LFDSIM_KERNELS (kernels.cmake) may leave the first two out.
#ifdef LFDSIM_WITH_AVX512
    {"avx512", 16, has_avx512, render_tile_avx512},
#endif
#ifdef LFDSIM_WITH_AVX2
    {"avx2", 8, has_avx2, render_tile_avx2},
#endif
    {"baseline", 4, always, render_tile_baseline},
    {"scalar", 1, always, render_tile_scalar},
};

}  // namespace

bool is_cancelled(const Job& job) { return job.cancelled(); }

std::vector<KernelInfo> kernels() {
    std::vector<KernelInfo> all;
    for (const KernelEntry& k : all_kernels) all.push_back({k.name, k.available(), k.lanes});
    return all;
}

const KernelEntry& choose_kernel(const std::string& wanted) {
    const char* const forced = std::getenv("LFDSIM_KERNEL");
    const bool from_environment = wanted.empty() && forced && *forced;
    const std::string name = from_environment ? forced : wanted;
    std::string present;
    for (const KernelEntry& k : all_kernels) {
        if (!k.available()) continue;
        if (name.empty() || name == k.name) return k;
        present += (present.empty() ? "" : ", ") + std::string(k.name);
    }
    bool known = false;
    for (const KernelEntry& k : all_kernels) known = known || name == k.name;
    throw InputError(from_environment ? "environment variable LFDSIM_KERNEL" : "--kernel",
                     (known ? "this machine cannot run kernel '" : "unknown kernel '") + name + "'; it can run: " + present);
}

namespace {

/// Returns the N of "cuda:N", 0 for "cuda", nothing for any other word.
std::optional<int> gpu_number(const std::string& word) {
    if (word == "cuda") return 0;
    if (word.rfind("cuda:", 0) != 0) return {};
    const std::optional<int> n = whole_text<int>(std::string_view(word).substr(5));
    return n >= 0 ? n : std::nullopt;
}

}  // namespace

ChosenDevice choose_device(const std::string& wanted, const std::string& kernel) {
    std::string word = wanted, where = "--device";
    if (const char* const named = std::getenv("LFDSIM_DEVICE"); word.empty() && named && *named) {
        word = named;
        where = "environment variable LFDSIM_DEVICE";
    }
    const bool cpu_kernel = !kernel.empty() || std::getenv("LFDSIM_KERNEL");
    if (word == "cpu" || (word.empty() && cpu_kernel) || (word == "auto" && cpu_kernel)) return {};
    if (word.empty() || word == "auto") {
        const cuda::GpuSearch& found = found_gpus();
        for (std::size_t k = 0; k < found.gpus.size(); ++k)
            if (found.gpus[k].why_not.empty()) return {int(k), false};
        return {};
    }
    const std::optional<int> n = gpu_number(word);
    if (!n) throw InputError(where, "unknown device '" + word + "'; allowed: auto, cpu, cuda, cuda:N");
    if (!kernel.empty()) throw InputError(where + ", --kernel", "'" + kernel + "' is a CPU kernel; give only one of the two");
    const cuda::GpuSearch& found = found_gpus();
    if (!found.missing.empty()) throw InputError(where, word + ": " + found.missing);
    if (std::size_t(*n) >= found.gpus.size())
        throw InputError(where, word + ": the last one is cuda:" + std::to_string(found.gpus.size() - 1));
    const cuda::Gpu& gpu = found.gpus[std::size_t(*n)];
    if (!gpu.why_not.empty()) throw InputError(where, word + ": " + gpu.name + ": " + gpu.why_not);
    return {*n, true};
}

}  // namespace lfdsim
