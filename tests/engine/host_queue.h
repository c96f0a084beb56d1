// The wide machine's items, one after another on the host: what a GPU would compute, but for its compiler and its rounding.
#pragma once
#include "engine/wide/queue.h"
#include "host_items.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <new>
#include <set>

namespace lfdsim {

class HostQueue : public wide::Queue {
  public:
    explicit HostQueue(std::size_t memory = std::size_t(4) << 30) : memory_(memory) {}
    ~HostQueue() override { EXPECT_TRUE(taken_.empty()) << "memory not released"; }

    std::string name() const override { return "host"; }
    std::size_t free_bytes() override { return memory_ - used_; }
    void* allocate(std::size_t bytes) override {
        if (bytes > free_bytes()) throw wide::DeviceError("out of memory");
        used_ += bytes;
        void* const p = ::operator new(bytes, std::align_val_t(256));
        // A machine's memory comes as it was left. Filling all of a large buffer would take most of a small picture's time.
        std::memset(p, 0xcd, std::min(bytes, std::size_t(16) << 20));
        taken_[p] = bytes;
        return p;
    }
    void release(void* p) noexcept override {
        used_ -= taken_[p];
        taken_.erase(p);
        ::operator delete(p, std::align_val_t(256));
    }
    void clear(void* p, std::size_t bytes) override { std::memset(p, 0, bytes); }
    void upload(void* to, const void* from, std::size_t bytes) override { std::memcpy(to, from, bytes); }
    void download(void* to, const void* from, std::size_t bytes) override { std::memcpy(to, from, bytes); }
    /// From the last item to the first: no order among them is promised.
    void run(const wide::Frame& frame, std::int64_t items) override {
        const HostKernel kernel = host_kernel(frame);
        specialisations.push_back(kernel.facts);
        for (std::int64_t i = items - 1; i >= 0; --i) kernel.item(frame, i);
    }
    void run(wide::LikenessStep step, const wide::LikenessFrame& frame, std::int64_t items) override {
        const HostLikenessItem item = host_likeness_item(step);
        for (std::int64_t i = items - 1; i >= 0; --i) item(frame, i);
    }
    double seconds() override { return 0; }

    std::int64_t points_at_once() const override { return points; }

    std::int64_t points = std::int64_t(1) << 31;  // at once
    std::vector<optics::Facts> specialisations;   // of the kernels

  private:
    std::size_t memory_, used_ = 0;
    std::map<void*, std::size_t> taken_;
};

}  // namespace lfdsim
