// The interface of a wide machine, such as a GPU, to the renderer: memory, transfers, steps. Floor 2.
#pragma once
#include "engine/wide/frame.h"
#include "engine/wide/likeness_frame.h"

#include <memory>
#include <stdexcept>
#include <string>

namespace lfdsim::wide {

/// A machine and the work submitted to it, which is done in that order. run() does not wait for it. Functions throw DeviceError
/// where the machine fails. To be used by one thread at a time.
class Queue {
  public:
    virtual ~Queue() = default;

    /// Returns the machine's name, as in "cuda:0, NVIDIA H100".
    virtual std::string name() const = 0;

    /// Returns the bytes that can be allocated, less what the steps may need for their stacks.
    virtual std::size_t free_bytes() = 0;
    /// Returns memory of the machine, not cleared. Throws DeviceError where there is too little.
    virtual void* allocate(std::size_t bytes) = 0;
    virtual void release(void*) noexcept = 0;

    /// Sets all bytes to zero.
    virtual void clear(void*, std::size_t bytes) = 0;
    /// Copies to the machine, and waits until `from` may be changed.
    virtual void upload(void* to, const void* from, std::size_t bytes) = 0;
    /// Copies what is there after all work submitted so far. Waits for that work and no later work.
    virtual void download(void* to, const void* from, std::size_t bytes) = 0;

    /// Renders the first `items` items of a frame (items.h).
    virtual void run(const Frame&, std::int64_t items) = 0;
    /// Returns the number of points that it traces in a fraction of a second: a longer run is divided, so that Ctrl-C takes effect.
    virtual std::int64_t points_at_once() const { return std::int64_t(1) << 31; }
    /// Computes the first `items` items of a step (likeness_items.h).
    virtual void run(LikenessStep, const LikenessFrame&, std::int64_t items) = 0;
    /// Returns the seconds that the steps have taken on the machine so far, by the machine's clock. Waits for all of them.
    virtual double seconds() = 0;
};

/// The error of a machine that failed, or lacks memory.
class DeviceError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Memory of a queue's machine for some T, which copies of the buffer share; the last one releases it. The queue must outlive it.
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
