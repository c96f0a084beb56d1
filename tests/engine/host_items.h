// The kernels of a wide machine (engine/wide/items.h), each compiled for the host: once for all tests that run them there.
#pragma once
#include "engine/wide/frame.h"
#include "engine/wide/likeness_frame.h"
#include "engine/wide/queue.h"

#include <cstdint>

namespace lfdsim {

/// The kernel of a step of a frame.
struct HostKernel {
    int way;      // optics::Way, through the array
    bool simple;  // the template argument of wide::item
    void (*item)(const wide::Frame&, std::int64_t i);
};

HostKernel host_kernel(wide::Step step, const wide::Frame& frame);

/// The items of the step `bundles`, 16 at a time as a GPU's team of threads (team_items.cpp).
void run_bundles_by_teams(const wide::Frame& frame, std::int64_t items);

using HostLikenessItem = void (*)(const wide::LikenessFrame&, std::int64_t i);
HostLikenessItem host_likeness_item(wide::LikenessStep step);

/// What these kernels take (wide::Queue asks for it).
wide::BlockSize host_block_size(int across, bool by_lens);
std::size_t host_even_bytes();
int host_places_per_axis(const Tile& tile);

}  // namespace lfdsim
