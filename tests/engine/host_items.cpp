#include "host_items.h"

#include "engine/wide/items.h"
#include "engine/wide/likeness_items.h"
#include "optics/trace.h"

lfdsim::HostKernel lfdsim::host_kernel(const wide::Frame& frame) {
    return optics::with_facts(frame.display, [&]<optics::Facts facts>() {
        const auto of = [&]<bool sobol>() {
            return HostKernel{facts, optics::Specialisations::number_of<facts>(), sobol,
                              [](const wide::Frame& f, std::int64_t i) { wide::point_item<facts, sobol>(f, i); }};
        };
        return frame.tile.sampling == Sampling::sobol ? of.template operator()<true>() : of.template operator()<false>();
    });
}

lfdsim::HostLikenessItem lfdsim::host_likeness_item(wide::LikenessStep step) {
    HostLikenessItem item = nullptr;
    wide::choose_likeness_item(step, [&]<wide::LikenessStep s>() {
        item = [](const wide::LikenessFrame& f, std::int64_t i) { wide::likeness_item<s>(f, i); };
    });
    return item;
}
