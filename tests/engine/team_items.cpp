// The step `bundles` as teams of threads do it on a GPU.
#define LFDSIM_HOST_TEAMS
#define LFDSIM_ISA teams
#include "host_team.h"

#include "host_items.h"

#include "engine/wide/items.h"

void lfdsim::run_bundles_by_teams(const wide::Frame& frame, std::int64_t items) {
    struct Work {
        const wide::Frame& frame;
        void (*item)(const wide::Frame&, std::int64_t);
        std::int64_t first;
    };
    Work work{frame, nullptr, 0};
    optics::with_way(frame.scene, [&]<optics::Way way>() {
        work.item = [](const wide::Frame& f, std::int64_t i) {
            wide::item<wide::Step::bundles, optics::for_few_rays(way), true>(f, i);
        };
    });
    for (work.first = 0; work.first < items; work.first += host_team::threads)
        host_team::run(
            unsigned(work.first % 128),
            [](const void* with, int thread) {
                const Work& w = *static_cast<const Work*>(with);
                w.item(w.frame, w.first + thread);
            },
            &work);
}
