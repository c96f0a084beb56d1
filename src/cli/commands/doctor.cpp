#include "cli/output/output.h"
#include "cli/program/commands.h"
#include "cli/program/machine.h"
#include "content/models/reader_path.h"
#include "engine/devices/devices.h"
#include "engine/devices/gpu.h"
#include "engine/devices/memory.h"
#include "engine/render.h"

#include <fmt/format.h>
#include <oneapi/tbb/version.h>
#include <png.h>
#include <tbb/info.h>
#include <unistd.h>
#include <cctype>
#include <cstdlib>

// lfdsim doctor: prints what a bug report should contain, and what answers "why is it slow" and "why does it not read my model".
namespace lfdsim::cli {
namespace {

std::string model_reader() {
    try {
        return reader_path().string();
    } catch (const std::exception& error) {
        return fmt::format("missing: {}; only panel images and patterns can be shown", error.what());
    }
}

// The kernel that the environment variable LFDSIM_KERNEL names, or the error if it cannot be used; null if it is not set.
Json forced_kernel() {
    const char* forced = std::getenv("LFDSIM_KERNEL");
    if (!forced || !*forced) return {};
    try {
        return choose_kernel("").name;
    } catch (const InputError& error) {
        return error.problems.front().what;
    }
}

// The CUDA toolkit of the build, the driver, whether a GPU is used or why not, and each GPU.
Json gpus() {
    const cuda::GpuSearch& found = found_gpus();
    Json all;
    all["toolkit"] = found.toolkit.empty() ? "none when lfdsim was built" : "CUDA " + found.toolkit;
    all["driver"] = found.driver.empty() ? "none" : "up to CUDA " + found.driver;
    all["used"] = found.missing.empty() ? "yes, unless --device cpu" : "no: " + found.missing;
    for (std::size_t k = 0; k < found.gpus.size(); ++k) {
        const cuda::Gpu& g = found.gpus[k];
        all[fmt::format("cuda:{}", k)] = fmt::format("{}, compute capability {}.{}, {:.1f} GB{}", g.name, g.major, g.minor,
                                                     g.memory_gb, g.why_not.empty() ? "" : "; cannot be used: " + g.why_not);
    }
    return all;
}

Json findings() {
    Json sets = Json::array(), available = Json::array(), unavailable = Json::array();
    // __builtin_cpu_supports() accepts only literals, so that a loop over names is impossible.
    const auto add = [&](const char* name, bool there) {
        if (there) sets.push_back(name);
    };
    add("sse4.2", __builtin_cpu_supports("sse4.2"));
    add("avx", __builtin_cpu_supports("avx"));
    add("avx2", __builtin_cpu_supports("avx2"));
    add("fma", __builtin_cpu_supports("fma"));
    add("avx512f", __builtin_cpu_supports("avx512f"));
    add("avx512dq", __builtin_cpu_supports("avx512dq"));
    add("avx512bw", __builtin_cpu_supports("avx512bw"));
    add("avx512vl", __builtin_cpu_supports("avx512vl"));
    for (const KernelInfo& k : kernels())
        (k.available ? available : unavailable).push_back(fmt::format("{} ({} lanes)", k.name, k.lanes));

    Json all;
    all["version"] = LFDSIM_VERSION;
    all["build"] = compiler() + ", " + build_type();
    all["processor"] = processor();
    all["instruction_sets"] = sets;
    all["kernels"] = available;
    all["kernels_this_processor_lacks"] = unavailable;
    all["kernel_forced_by_LFDSIM_KERNEL"] = forced_kernel();
    all["threads"] = tbb::info::default_concurrency();
    all["memory_gb"] = std::round(installed_bytes() / 1e8) / 10;
    all["gpu"] = gpus();
    all["model_reader"] = model_reader();
    all["current_folder_writable"] = access(".", W_OK) == 0;
    all["libraries"] = {{"oneTBB", TBB_VERSION_STRING},    {"Embree", LFDSIM_EMBREE},   {"Assimp", LFDSIM_ASSIMP},
                        {"libpng", PNG_LIBPNG_VER_STRING}, {"OpenEXR", LFDSIM_OPENEXR}, {"toml++", LFDSIM_TOMLPLUSPLUS}};
    return all;
}

std::string readable(const Json& value) {
    if (value.is_string()) return value.get<std::string>();
    if (value.is_null()) return "-";
    if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
    if (!value.is_structured()) return value.dump();
    std::string text;
    for (const auto& [key, element] : value.items())
        text += (text.empty() ? "" : ", ") + (value.is_object() ? key + " " : "") + readable(element);
    return text.empty() ? "-" : text;
}

struct DoctorArguments {
    Command command;
    Flag json = command.flag("--json", "Print results as JSON");
};

void run(const DoctorArguments& args) {
    const Json all = findings();
    if (args.json) return print_json(all);
    std::string text;
    for (const auto& [key, value] : all.items()) {
        std::string name = key;
        for (std::size_t i = 1; i < name.size(); ++i)
            if (name[i] == '_' && std::islower(name[i - 1])) name[i] = ' ';  // not in LFDSIM_KERNEL
        text += fmt::format("{:<32} {}\n", name, readable(value));
    }
    print(text);
}

}  // namespace

CommandSpec doctor_command() {
    return {.name = "doctor",
            .summary = "Reports the optional parts found on this machine, and those missing",
            .examples = "Example:\n  lfdsim doctor",
            .run = with_options<DoctorArguments>(run)};
}

}  // namespace lfdsim::cli
