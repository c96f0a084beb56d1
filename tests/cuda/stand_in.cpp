// The stand-in's functions but for those that launch kernels, as far as they are used; what they do is in CUDA's own reference.
#include "stand_in.h"

#include <sys/mman.h>
#include <unistd.h>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <sstream>
#include <tuple>
#include <utility>

namespace stand_in {
namespace {

struct Machine {
    int driver = CUDART_VERSION, gpus = 1, major = 9, minor = 0;
    std::size_t memory = std::size_t(4) << 30;
    std::string failing;  // function
    int failing_call = 0;

    Machine() {
        const char* const said = std::getenv("LFDSIM_STAND_IN");
        std::istringstream words(said ? said : "");
        const auto version = [](const std::string& v) { return std::pair(std::stoi(v), std::stoi(v.substr(v.find('.') + 1))); };
        for (std::string word; words >> word;) {
            const std::string key = word.substr(0, word.find('=')), value = word.substr(key.size() + 1);
            if (key == "driver") driver = version(value).first * 1000 + version(value).second * 10;
            if (key == "gpus") gpus = std::stoi(value);
            if (key == "capability") std::tie(major, minor) = version(value);
            if (key == "memory_mb") memory = std::size_t(std::stoi(value)) << 20;
            if (key == "fail") {
                failing = value.substr(0, value.find(':'));
                failing_call = std::stoi(value.substr(failing.size() + 1));
            }
        }
    }
};

const Machine& machine() {
    static const Machine the_one;
    return the_one;
}

std::atomic<bool> failed_for_ever = false;
thread_local cudaError_t last_error = cudaSuccess;
thread_local int current = 0;  // GPU of the thread

struct Piece {
    std::size_t bytes, mapped;
    void* map;
};
struct Memory {
    std::mutex mutex;
    std::map<std::uintptr_t, Piece> pieces;
    std::size_t used = 0, reserved = 0;
};
Memory& memory_of(int gpu) {
    static std::map<int, Memory> all;
    static std::mutex mutex;
    const std::lock_guard lock(mutex);
    return all[gpu];
}

// Does all of it lie in one piece of the GPU's?
bool holds(int gpu, const void* p, std::size_t bytes) {
    Memory& m = memory_of(gpu);
    const std::lock_guard lock(m.mutex);
    const auto after = m.pieces.upper_bound(std::uintptr_t(p));
    if (after == m.pieces.begin()) return false;
    const auto& [start, piece] = *std::prev(after);
    return std::uintptr_t(p) + bytes <= start + piece.bytes;
}

constexpr std::size_t piece_alignment = 64;  // of a piece: what lies behind its last bytes, up to so many, is not guarded
constexpr std::size_t rubbish_bytes = std::size_t(8) << 20;  // bytes at a piece's beginning: more would take most of the time

struct Event {
    Stream* stream = nullptr;
    std::chrono::steady_clock::time_point at;
};
Event* event_of(cudaEvent_t e) { return reinterpret_cast<Event*>(e); }

}  // namespace

void misused(const std::string& what) {
    std::fprintf(stderr, "stand-in for CUDA: %s\n", what.c_str());
    std::abort();
}

int current_gpu() { return current; }

cudaError_t told(cudaError_t e) {
    if (e != cudaSuccess) last_error = e;
    return e;
}

cudaError_t enter(const char* function) {
    static std::atomic<int> calls = 0;
    if (machine().failing == function && ++calls == machine().failing_call) {
        if (machine().failing == "cudaMallocAsync") return told(cudaErrorMemoryAllocation);
        failed_for_ever = true;
    }
    return told(failed_for_ever ? cudaErrorLaunchFailure : cudaSuccess);
}

}  // namespace stand_in

extern "C" {

using namespace stand_in;

cudaError_t cudaGetLastError() { return std::exchange(last_error, failed_for_ever ? cudaErrorLaunchFailure : cudaSuccess); }
const char* cudaGetErrorString(cudaError_t e) {
    return e == cudaErrorMemoryAllocation ? "out of memory"
           : e == cudaErrorLaunchFailure  ? "unspecified launch failure"
                                          : "another error";
}
cudaError_t cudaDriverGetVersion(int* version) {
    *version = machine().driver;
    return cudaSuccess;
}
cudaError_t cudaGetDeviceCount(int* count) {
    *count = 0;
    if (const cudaError_t e = enter("cudaGetDeviceCount")) return e;
    if (machine().driver < CUDART_VERSION / 1000 * 1000) return told(cudaErrorInsufficientDriver);
    *count = machine().gpus;
    return told(*count ? cudaSuccess : cudaErrorNoDevice);
}
cudaError_t cudaSetDevice(int gpu) {
    if (const cudaError_t e = enter("cudaSetDevice")) return e;
    if (gpu < 0 || gpu >= machine().gpus) return told(cudaErrorInvalidDevice);
    current = gpu;
    return cudaSuccess;
}
cudaError_t cudaGetDeviceProperties(cudaDeviceProp* p, int gpu) {
    if (const cudaError_t e = enter("cudaGetDeviceProperties")) return e;
    *p = {};
    std::snprintf(p->name, sizeof p->name, "stand-in %d", gpu);
    p->major = machine().major;
    p->minor = machine().minor;
    p->totalGlobalMem = machine().memory;
    p->multiProcessorCount = 2;
    p->maxThreadsPerMultiProcessor = 1024;
    return cudaSuccess;
}
cudaError_t cudaFuncGetAttributes(cudaFuncAttributes* attributes, const void* kernel) {
    if (const cudaError_t e = enter("cudaFuncGetAttributes")) return e;
    if (!is_kernel(kernel)) misused("attributes of what is no kernel");
    if (machine().major * 10 + machine().minor < 75) return told(cudaErrorNoKernelImageForDevice);
    *attributes = {};
    attributes->localSizeBytes = 1024;
    return cudaSuccess;
}

cudaError_t cudaDeviceGetDefaultMemPool(cudaMemPool_t* pool, int gpu) {
    *pool = reinterpret_cast<cudaMemPool_t>(&memory_of(gpu));
    return enter("cudaDeviceGetDefaultMemPool");
}
cudaError_t cudaMemPoolSetAttribute(cudaMemPool_t, cudaMemPoolAttr, void*) { return enter("cudaMemPoolSetAttribute"); }
cudaError_t cudaMemPoolGetAttribute(cudaMemPool_t pool, cudaMemPoolAttr attribute, void* value) {
    Memory& m = *reinterpret_cast<Memory*>(pool);
    const std::lock_guard lock(m.mutex);
    *static_cast<std::uint64_t*>(value) = attribute == cudaMemPoolAttrReservedMemCurrent ? m.reserved : m.used;
    return enter("cudaMemPoolGetAttribute");
}
cudaError_t cudaMemGetInfo(std::size_t* free, std::size_t* all) {
    Memory& m = memory_of(current);
    const std::lock_guard lock(m.mutex);
    *all = machine().memory;
    *free = *all - m.reserved;
    return enter("cudaMemGetInfo");
}
cudaError_t cudaMallocAsync(void** memory, std::size_t bytes, cudaStream_t stream) {
    if (const cudaError_t e = enter("cudaMallocAsync")) return e;
    if (stream_of(stream)->gpu != current) misused("a stream of another GPU than the thread's");
    Memory& m = memory_of(current);
    const std::lock_guard lock(m.mutex);
    if (m.used + bytes > machine().memory) return told(cudaErrorMemoryAllocation);
    const std::size_t page = std::size_t(sysconf(_SC_PAGESIZE)), room = (bytes + page - 1) / page * page;
    void* const map = mmap(nullptr, room + page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (map == MAP_FAILED || mprotect(static_cast<char*>(map) + room, page, PROT_NONE) != 0) misused("no memory for it");
    *memory = static_cast<char*>(map) + room - (bytes + piece_alignment - 1) / piece_alignment * piece_alignment;
    std::memset(*memory, 0xcd, std::min(bytes, rubbish_bytes));
    m.pieces[std::uintptr_t(*memory)] = {bytes, room + page, map};
    m.used += bytes;
    m.reserved = std::max(m.reserved, m.used);
    return cudaSuccess;
}
cudaError_t cudaFreeAsync(void* memory, cudaStream_t stream) {
    if (const cudaError_t e = enter("cudaFreeAsync")) return e;
    Memory& m = memory_of(current);
    const std::lock_guard lock(m.mutex);
    const auto found = m.pieces.find(std::uintptr_t(memory));
    if (found == m.pieces.end()) misused("memory is freed that is none, or of another GPU");
    const Piece piece = found->second;
    m.used -= piece.bytes;
    m.pieces.erase(found);
    stream_of(stream)->add([piece] { munmap(piece.map, piece.mapped); });
    return cudaSuccess;
}
cudaError_t cudaMemsetAsync(void* memory, int value, std::size_t bytes, cudaStream_t stream) {
    if (const cudaError_t e = enter("cudaMemsetAsync")) return e;
    if (!holds(current, memory, bytes)) misused("memory is cleared that is not the GPU's");
    stream_of(stream)->add([=] { std::memset(memory, value, bytes); });
    return cudaSuccess;
}
cudaError_t cudaMemcpyAsync(void* to, const void* from, std::size_t bytes, cudaMemcpyKind kind, cudaStream_t stream) {
    if (const cudaError_t e = enter("cudaMemcpyAsync")) return e;
    const bool up = kind == cudaMemcpyHostToDevice;
    if (!up && kind != cudaMemcpyDeviceToHost) misused("a transfer of a kind that is not used");
    if (!holds(current, up ? to : from, bytes) || holds(current, up ? from : to, 0))
        misused("a transfer in the wrong direction or past the end");
    stream_of(stream)->add([=] { std::memcpy(to, from, bytes); });
    return cudaSuccess;
}

cudaError_t cudaStreamCreateWithFlags(cudaStream_t* stream, unsigned) {
    if (const cudaError_t e = enter("cudaStreamCreateWithFlags")) return e;
    *stream = reinterpret_cast<cudaStream_t>(new Stream{current, {}, {}, {}});
    return cudaSuccess;
}
cudaError_t cudaStreamSynchronize(cudaStream_t stream) {
    if (const cudaError_t e = enter("cudaStreamSynchronize")) return e;
    stream_of(stream)->wait();
    return cudaSuccess;
}
cudaError_t cudaStreamDestroy(cudaStream_t stream) {
    stream_of(stream)->wait();
    delete stream_of(stream);
    return enter("cudaStreamDestroy");
}
cudaError_t cudaEventCreate(cudaEvent_t* event) {
    *event = reinterpret_cast<cudaEvent_t>(new Event);
    return enter("cudaEventCreate");
}
cudaError_t cudaEventDestroy(cudaEvent_t event) {
    delete event_of(event);
    return enter("cudaEventDestroy");
}
cudaError_t cudaEventRecord(cudaEvent_t event, cudaStream_t stream) {
    if (const cudaError_t e = enter("cudaEventRecord")) return e;
    event_of(event)->stream = stream_of(stream);
    stream_of(stream)->add([event] { event_of(event)->at = std::chrono::steady_clock::now(); });
    return cudaSuccess;
}
cudaError_t cudaEventSynchronize(cudaEvent_t event) {
    if (const cudaError_t e = enter("cudaEventSynchronize")) return e;
    event_of(event)->stream->wait();
    return cudaSuccess;
}
cudaError_t cudaEventElapsedTime(float* milliseconds, cudaEvent_t from, cudaEvent_t to) {
    if (const cudaError_t e = enter("cudaEventElapsedTime")) return e;
    *milliseconds = std::chrono::duration<float, std::milli>(event_of(to)->at - event_of(from)->at).count();
    return cudaSuccess;
}

}  // extern "C"
