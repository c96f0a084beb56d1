#include "analysis/core/parallel.h"

#include "base/on_threads.h"

#include <oneapi/tbb/parallel_for.h>
#include <algorithm>

namespace lfdsim {

void Parts::run(int n, const std::function<void(int)>& part) {
    on_threads(threads_, [&] {
        tbb::parallel_for(0, n, [&](int k) {
            if (job_.cancelled()) return;
            part(k);
            const std::int64_t done = ++done_;  // each number once, so that what is reported adds up to exactly `steps`
            job_.advance(steps_ * done / count_ - steps_ * (done - 1) / count_);
        });
    });
    if (job_.cancelled()) throw Stopped{};
}

std::int64_t pictures_worth(const Subject& s, std::int64_t rays) {
    const std::array<std::int64_t, 2>& size = s.display().camera.resolution;
    // A single ray takes as long as about four pixels of a picture.
    return std::max<std::int64_t>(1, 4 * rays / (size[0] * size[1]));
}

}  // namespace lfdsim
