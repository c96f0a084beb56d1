// Several pictures, one after another: the next is made while the last is processed. Floor 2.
#pragma once
#include "engine/devices/devices.h"
#include "engine/render.h"

#include <future>

namespace lfdsim {

/// Returns whether the GPU would render, so that the CPU is free for other work. Throws as choose_device().
inline bool renders_on_gpu(const RenderOptions& options) { return choose_device(options.device, options.kernel).gpu.has_value(); }

/// Calls take(k, make(k)) for k = 0 .. count - 1 in this order, until take returns false. at_once: runs make(k + 1) in a separate
/// thread during take(k), so that a GPU's steps, transfers and the CPU's work on the pictures overlap. Throws what they throw,
/// after both have ended.
template <class Make, class Take>
void make_ahead(std::size_t count, bool at_once, Make make, Take take) {
    using Made = decltype(make(std::size_t(0)));
    std::future<Made> next;  // its destructor waits
    for (std::size_t k = 0; k < count; ++k) {
        Made made = next.valid() ? next.get() : make(k);
        if (at_once && k + 1 < count) next = std::async(std::launch::async, make, k + 1);
        if (!take(k, std::move(made))) return;
    }
}

}  // namespace lfdsim
