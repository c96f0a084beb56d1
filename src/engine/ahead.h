// Several pictures, one after another, of which the next is made while the last is looked at. Floor 2.
#pragma once
#include "engine/devices.h"
#include "engine/render.h"

#include <future>
#include <optional>

namespace lfdsim {

/// Would the GPU render, so that the CPU has time for something else?
inline bool renders_on_gpu(const RenderOptions& options) { return choose_device(options.device, options.kernel).gpu.has_value(); }

/// take(k, make(k)) for k = 0 .. count - 1 in this order, until take says false. at_once: make(k + 1), in a thread of its own,
/// while take has k; then a GPU's steps, transfers and what the CPU does with the pictures overlap. Throws what they throw, when
/// neither is under way any more.
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
