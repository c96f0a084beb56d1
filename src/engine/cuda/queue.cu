// A GPU's queue, over the CUDA runtime, and the kernels that compare views.
#include "engine/cuda/cuda.h"
#include "engine/cuda/point_kernels.h"
#include "engine/wide/likeness_items.h"

#include <cuda_runtime.h>

#include <algorithm>

namespace lfdsim::cuda {

namespace {

/// Throws DeviceError, which says what was being done, unless a call succeeded.
void check(cudaError_t result, const char* doing) {
    if (result == cudaSuccess) return;
    cudaGetLastError();  // clears it
    throw wide::DeviceError(std::string("the GPU failed while ") + doing + ": " + cudaGetErrorString(result));
}

template <wide::LikenessStep step>
__global__ void __launch_bounds__(threads) likeness_kernel(const __grid_constant__ wide::LikenessFrame frame, std::int64_t items) {
    const std::int64_t i = std::int64_t(blockIdx.x) * threads + threadIdx.x;
    if (i < items) wide::likeness_item<step>(frame, i);
}

/// Returns a version of CUDA, 1000 major + 10 minor, as "major.minor".
std::string text(int version) { return std::to_string(version / 1000) + "." + std::to_string(version % 1000 / 10); }

/// A stream of a GPU. Each function first makes that GPU the calling thread's current one, since queues change threads.
class CudaQueue : public wide::Queue {
  public:
    explicit CudaQueue(int gpu) : gpu_(gpu) {
        use();
        cudaDeviceProp properties;
        check(cudaGetDeviceProperties(&properties, gpu), "reading its properties");
        name_ = "cuda:" + std::to_string(gpu) + ", " + properties.name;
#ifdef LFDSIM_CUDA_FMAD
        name_ += ", contracted";
#endif
        resident_threads_ = std::size_t(properties.multiProcessorCount) * std::size_t(properties.maxThreadsPerMultiProcessor);
        // Memory that is given back stays with the process, so that the next view's picture does not wait for an allocation.
        check(cudaDeviceGetDefaultMemPool(&pool_, gpu), "asking for its memory pool");
        std::uint64_t keep = ~std::uint64_t(0);
        check(cudaMemPoolSetAttribute(pool_, cudaMemPoolAttrReleaseThreshold, &keep), "asking for its memory pool");
        check(cudaStreamCreateWithFlags(&steps_, cudaStreamNonBlocking), "making a stream");
        check(cudaEventCreate(&begun_), "making an event");
        check(cudaEventCreate(&ended_), "making an event");
    }
    ~CudaQueue() override {
        cudaSetDevice(gpu_);
        cudaEventDestroy(begun_);
        cudaEventDestroy(ended_);
        cudaStreamDestroy(steps_);
    }

    std::string name() const override { return name_; }

    std::size_t free_bytes() override {
        use();
        std::size_t free = 0, all = 0;
        check(cudaMemGetInfo(&free, &all), "asking for its free memory");
        std::uint64_t kept = 0, used = 0;
        check(cudaMemPoolGetAttribute(pool_, cudaMemPoolAttrReservedMemCurrent, &kept), "asking for its free memory");
        check(cudaMemPoolGetAttribute(pool_, cudaMemPoolAttrUsedMemCurrent, &used), "asking for its free memory");
        free += kept - used;
        // Threads keep what does not fit into registers in local memory, which is allocated when a kernel first runs.
        static const std::size_t stack = largest_stack();
        const std::size_t stacks = resident_threads_ * stack;
        return free > stacks ? free - stacks : 0;
    }
    void* allocate(std::size_t bytes) override {
        use();
        void* memory = nullptr;
        check(cudaMallocAsync(&memory, std::max<std::size_t>(bytes, 1), steps_),
              ("taking " + std::to_string((bytes >> 20) + 1) + " MB of memory").c_str());
        return memory;
    }
    void release(void* memory) noexcept override {
        cudaSetDevice(gpu_);
        cudaFreeAsync(memory, steps_);
    }

    void clear(void* memory, std::size_t bytes) override {
        use();
        check(cudaMemsetAsync(memory, 0, bytes, steps_), "clearing memory");
    }
    void upload(void* to, const void* from, std::size_t bytes) override {
        use();
        check(cudaMemcpyAsync(to, from, bytes, cudaMemcpyHostToDevice, steps_), "sending data to it");
        check(cudaStreamSynchronize(steps_), "sending data to it");
    }
    void download(void* to, const void* from, std::size_t bytes) override {
        use();
        check(cudaMemcpyAsync(to, from, bytes, cudaMemcpyDeviceToHost, steps_), "fetching the picture");
        check(cudaStreamSynchronize(steps_), "rendering");
    }

    void run(const wide::Frame& frame, std::int64_t items) override {
        if (items <= 0) return;
        start_clock();
        frame.tile.sampling == Sampling::sobol ? PointKernels<true>::start(frame, items, steps_)
                                               : PointKernels<false>::start(frame, items, steps_);
        check(cudaGetLastError(), "starting work");
        check(cudaEventRecord(ended_, steps_), "starting work");
    }
    void run(wide::LikenessStep step, const wide::LikenessFrame& frame, std::int64_t items) override {
        if (items <= 0) return;
        start_clock();
        wide::choose_likeness_item(
            step, [&]<wide::LikenessStep s>() { likeness_kernel<s><<<thread_blocks(items), threads, 0, steps_>>>(frame, items); });
        check(cudaGetLastError(), "starting work");
        check(cudaEventRecord(ended_, steps_), "starting work");
    }
    double seconds() override {
        use();
        if (timing_) {
            check(cudaEventSynchronize(ended_), "rendering");
            float milliseconds = 0;
            check(cudaEventElapsedTime(&milliseconds, begun_, ended_), "reading its clock");
            seconds_ += milliseconds * 1e-3;
            timing_ = false;
        }
        return seconds_;
    }

  private:
    void use() { check(cudaSetDevice(gpu_), "choosing it"); }
    /// Begins a measurement of time, unless one has begun: it lasts until seconds() reads it, from the first step to the last.
    void start_clock() {
        use();
        if (!timing_) check(cudaEventRecord(begun_, steps_), "starting work");
        timing_ = true;
    }

    /// Returns the bytes of local memory per thread of the kernel that needs most.
    static std::size_t largest_stack() {
        std::size_t most = 0;
        for (const cudaError_t asked :
             {PointKernels<true>::raise_to_local_bytes(most), PointKernels<false>::raise_to_local_bytes(most)})
            check(asked, "reading a kernel's needs");
        return most;
    }

    const int gpu_;
    std::string name_;
    std::size_t resident_threads_ = 0;
    cudaMemPool_t pool_{};
    cudaStream_t steps_{};
    cudaEvent_t begun_{}, ended_{};
    bool timing_ = false;
    double seconds_ = 0;
};

}  // namespace

GpuSearch find() {
    // What is missing, if no GPU can be reached at all
    GpuSearch found;
    found.toolkit = text(CUDART_VERSION);
    int version = 0;
    if (cudaDriverGetVersion(&version) == cudaSuccess && version > 0) found.driver = text(version);
    int count = 0;
    const cudaError_t result = cudaGetDeviceCount(&count);
    cudaGetLastError();
    if (found.driver.empty()) {
        found.missing = "no NVIDIA driver was found; a GPU needs one that supports CUDA " + found.toolkit;
    } else if (result == cudaErrorInsufficientDriver) {
        found.missing =
            "the NVIDIA driver is too old: it supports CUDA " + found.driver + ", " + found.toolkit + " is needed; update it";
    } else if (result == cudaErrorNoDevice || (result == cudaSuccess && count == 0)) {
        found.missing = "there is a driver, but no GPU that it shows; CUDA_VISIBLE_DEVICES may hide them";
    } else if (result != cudaSuccess) {
        found.missing = std::string("the NVIDIA driver answers: ") + cudaGetErrorString(result);
    }
    if (!found.missing.empty()) return found;
    // Each GPU, and why it cannot be used
    bool any = false;
    for (int k = 0; k < count; ++k) {
        cudaDeviceProp p;
        if (cudaGetDeviceProperties(&p, k) != cudaSuccess) {
            cudaGetLastError();
            found.gpus.push_back({"unknown", 0, 0, 0, "it does not report its properties"});
            continue;
        }
        Gpu gpu{p.name, p.major, p.minor, double(p.totalGlobalMem) * 1e-9, ""};
        // Does this binary hold code that the GPU can run?
        std::size_t bytes = 0;
        cudaError_t works = cudaSetDevice(k);
        if (works == cudaSuccess) works = PointKernels<true>::raise_to_local_bytes(bytes);
        cudaGetLastError();
        if (works == cudaSuccess)
            any = true;
        else if (p.major * 10 + p.minor < 75)
            gpu.why_not = "compute capability " + std::to_string(p.major) + "." + std::to_string(p.minor) +
                          "; this lfdsim holds code for 7.5 and newer";
        else
            gpu.why_not = std::string("it answers: ") + cudaGetErrorString(works);
        found.gpus.push_back(gpu);
    }
    if (!any) found.missing = "no GPU here can be used: " + found.gpus.front().name + ": " + found.gpus.front().why_not;
    return found;
}

std::unique_ptr<wide::Queue> open(int gpu) { return std::make_unique<CudaQueue>(gpu); }

}  // namespace lfdsim::cuda
