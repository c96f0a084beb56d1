#include "host_items.h"

#include "engine/wide/items.h"
#include "engine/wide/likeness_items.h"

lfdsim::HostKernel lfdsim::host_kernel(wide::Step step, const wide::Frame& frame) {
    HostKernel kernel{};
    wide::choose_step(step, frame, [&]<wide::Step s, bool simple>() {
        wide::with_way_of_step<s>(frame, [&]<optics::Way way>() {
            kernel = {int(way), simple, [](const wide::Frame& f, std::int64_t i) { wide::item<s, way, simple>(f, i); }};
        });
    });
    return kernel;
}

lfdsim::HostLikenessItem lfdsim::host_likeness_item(wide::LikenessStep step) {
    HostLikenessItem item = nullptr;
    wide::choose_likeness_item(step, [&]<wide::LikenessStep s>() {
        item = [](const wide::LikenessFrame& f, std::int64_t i) { wide::likeness_item<s>(f, i); };
    });
    return item;
}

lfdsim::wide::BlockSize lfdsim::host_block_size(int across, bool by_lens) {
    const Room room(across, by_lens);
    return {wide::BlockLayout(across, room).end, room.strata};
}

std::size_t lfdsim::host_even_bytes() { return sizeof(EvenCuts); }

int lfdsim::host_places_per_axis(const Tile& tile) { return places_per_axis(tile); }
