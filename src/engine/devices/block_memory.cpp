#include "engine/devices/kernel.h"

#include <memory>
#include <new>

namespace lfdsim {
namespace {

constexpr std::align_val_t alignment{64};  // a line of the cache, and the widest register

struct Free {
    void operator()(void* memory) const { ::operator delete(memory, alignment); }
};
struct Held {
    std::unique_ptr<void, Free> memory;
    std::size_t bytes = 0;
};

}  // namespace

void* block_memory(std::size_t bytes) {
    thread_local Held held;
    if (held.bytes < bytes) {
        held = {};
        held.memory.reset(::operator new(bytes, alignment));
        held.bytes = bytes;
    }
    return held.memory.get();
}

}  // namespace lfdsim
