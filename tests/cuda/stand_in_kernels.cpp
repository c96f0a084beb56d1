// Kernel launches of the stand-in (stand_in.h): a kernel's items run on the CPU's threads.
//
// The compiler turns kernel<<<...>>>() into calls of the runtime's functions below, from __cudaRegisterFunction, which gives the
// mangled name of each kernel, to cudaLaunchKernel. The kernel and its template arguments are read from that name, and the same
// item functions as on a GPU (engine/wide/items.h, likeness_items.h), compiled for the CPU (../engine/host_items.cpp), do the work.
#include "../engine/host_items.h"
#include "stand_in.h"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <algorithm>
#include <map>
#include <regex>
#include <vector>

namespace stand_in {
namespace {

using namespace lfdsim;

struct Configuration {
    dim3 grid, block;
    std::size_t shared;
    cudaStream_t stream;
};
thread_local std::vector<Configuration> configurations;

std::map<const void*, std::string>& kernel_names() {
    static std::map<const void*, std::string> all;
    return all;
}

/// item(i) for all i below `items`, in no fixed order, as on a GPU.
template <class Item>
void work_off(std::int64_t items, Item item) {
    tbb::this_task_arena::isolate([&] { tbb::parallel_for(std::int64_t(0), items, [&](std::int64_t i) { item(i); }); });
}

/// Does what a GPU does when the kernel of this mangled name is launched: adds to the stream item<...>() of engine/wide/, with the
/// template arguments that the name contains (the row of optics::Specialisations, the sampler; the step of a comparison), for all
/// items that the grid covers. A launch that the queue (engine/cuda/) must not make ends the program.
void launch(const std::string& name, const Configuration& c, void** arguments) {
    // A grid that is too small leaves items undone.
    const std::int64_t items = std::min(*static_cast<std::int64_t*>(arguments[1]), std::int64_t(c.grid.x) * c.block.x);
    if (c.block.x != 128 || c.block.y * c.block.z * c.grid.y * c.grid.z != 1 || c.grid.x < 1 || c.grid.x > 0x7fffffff ||
        c.shared != 0)
        misused("a grid that CUDA or this stand-in does not know");
    const auto numbers = [&](const char* pattern) {
        std::smatch found;
        std::vector<int> all;
        if (std::regex_search(name, found, std::regex(pattern)))
            for (std::size_t k = 1; k < found.size(); ++k) all.push_back(std::stoi(found[k]));
        return all;
    };
    if (const auto n = numbers("point_kernelILi(\\d+)ELb(\\d)E"); !n.empty()) {
        const wide::Frame frame = *static_cast<wide::Frame*>(arguments[0]);
        stream_of(c.stream)->add([=] {
            const HostKernel kernel = host_kernel(frame);
            if (kernel.row != n[0] || kernel.sobol != (n[1] != 0))
                misused("another kernel was launched than the frame asks for: " + name);
            work_off(items, [&](std::int64_t i) { kernel.item(frame, i); });
        });
    } else if (const auto l = numbers("likeness_kernelI.*?LikenessStepE(\\d+)E"); !l.empty()) {
        const wide::LikenessFrame frame = *static_cast<wide::LikenessFrame*>(arguments[0]);
        stream_of(c.stream)->add([=] {
            const HostLikenessItem item = host_likeness_item(wide::LikenessStep(l[0]));
            work_off(items, [&](std::int64_t i) { item(frame, i); });
        });
    } else {
        misused("unknown kernel " + name);
    }
}

}  // namespace

bool is_kernel(const void* host) { return kernel_names().contains(host); }

}  // namespace stand_in

extern "C" {

using namespace stand_in;

void** __cudaRegisterFatBinary(void*) {
    static void* handle;
    return &handle;
}
void __cudaRegisterFatBinaryEnd(void**) {}
void __cudaUnregisterFatBinary(void**) {}
void __cudaRegisterFunction(void**, const char* host, char*, const char* name, int, uint3*, uint3*, dim3*, dim3*, int*) {
    kernel_names()[host] = name;
}
unsigned __cudaPushCallConfiguration(dim3 grid, dim3 block, std::size_t shared, cudaStream_t stream) {
    configurations.push_back({grid, block, shared, stream});
    return 0;
}
cudaError_t __cudaPopCallConfiguration(dim3* grid, dim3* block, std::size_t* shared, void* stream) {
    const Configuration c = configurations.back();
    configurations.pop_back();
    *grid = c.grid;
    *block = c.block;
    *shared = c.shared;
    *static_cast<cudaStream_t*>(stream) = c.stream;
    return cudaSuccess;
}
cudaError_t cudaLaunchKernel(const void* kernel, dim3 grid, dim3 block, void** arguments, std::size_t shared, cudaStream_t stream) {
    if (const cudaError_t e = enter("cudaLaunchKernel")) return e;
    launch(kernel_names().at(kernel), {grid, block, shared, stream}, arguments);
    return cudaSuccess;
}
// Since CUDA 13 compiled launches call these two.
cudaError_t __cudaGetKernel(cudaKernel_t* kernel, const void* host) {
    *kernel = reinterpret_cast<cudaKernel_t>(const_cast<void*>(host));
    return cudaSuccess;
}
cudaError_t __cudaLaunchKernel(cudaKernel_t kernel, dim3 grid, dim3 block, void** arguments, std::size_t shared,
                               cudaStream_t stream) {
    return cudaLaunchKernel(reinterpret_cast<const void*>(kernel), grid, block, arguments, shared, stream);
}

}  // extern "C"
