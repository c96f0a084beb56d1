// The interface of a wide machine to the renderer: memory, transfers, steps. Floor 2.
#pragma once
#include "engine/wide/frame.h"
#include "engine/wide/likeness_frame.h"

#include <memory>
#include <stdexcept>
#include <string>

namespace lfdsim::wide {

/// Work is done in the order in which it is submitted; run() does not wait for it. Functions throw DeviceError where the machine
/// fails. To be used by one thread at a time.
class Queue {
  public:
    virtual ~Queue() = default;

    /// The machine's name, as in "cuda:0, NVIDIA H100".
    virtual std::string name() const = 0;

    /// Bytes that can be allocated, less what the steps may need for their stacks.
    virtual std::size_t free_bytes() = 0;
    /// Throws DeviceError where there are too few.
    virtual void* allocate(std::size_t bytes) = 0;
    virtual void release(void*) noexcept = 0;

    /// Sets all bytes to zero.
    virtual void clear(void*, std::size_t bytes) = 0;
    /// Waits until `from` may be changed.
    virtual void upload(void* to, const void* from, std::size_t bytes) = 0;
    /// Copies what is there after all work submitted so far. Waits for that work and no later work.
    virtual void download(void* to, const void* from, std::size_t bytes) = 0;

    virtual void run(const Frame&, std::int64_t items) = 0;
    /// Points that it traces in a fraction of a second: a longer run is divided, so that Ctrl-C takes effect.
    virtual std::int64_t points_at_once() const { return std::int64_t(1) << 31; }
    virtual void run(LikenessStep, const LikenessFrame&, std::int64_t items) = 0;
    /// Seconds that the steps have taken on the machine so far, by its own clock. Waits for all of them.
    virtual double seconds() = 0;
};

/// The machine failed, or lacks memory.
class DeviceError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Memory of a queue's machine.
template <class T>
class Buffer {
  public:
    Buffer() = default;
    Buffer(Queue& queue, std::size_t count) : memory_(queue.allocate(count * sizeof(T)), [&queue](void* p) { queue.release(p); }) {}
    T* get() const { return static_cast<T*>(memory_.get()); }

  private:
    std::shared_ptr<void> memory_;
};

}  // namespace lfdsim::wide
