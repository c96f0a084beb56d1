#include "analysis/screen_parts.h"

#include <algorithm>

namespace lfdsim {

ScreenParts::ScreenParts(const Display& d, int most_along)
    : lenses_(lens_count(d.panel, d.array)), together_((std::max(lenses_[0], lenses_[1]) + most_along - 1) / most_along) {
    for (std::size_t k = 0; k < 2; ++k) count_[k] = int(std::max<std::int64_t>(lenses_[k] / together_, 1));
}

LensBlock ScreenParts::block(int part) const {
    const std::array<std::int64_t, 2> at{part % count_[0], count_[1] - 1 - part / count_[0]};
    LensBlock block{};
    for (std::size_t k = 0; k < 2; ++k) {
        block.first[k] = at[k] * lenses_[k] / count_[k];
        block.end[k] = (at[k] + 1) * lenses_[k] / count_[k];
    }
    return block;
}

LensBlock ScreenParts::middle() const {
    LensBlock block{};
    for (std::size_t k = 0; k < 2; ++k) {
        const std::int64_t together = std::min(together_, lenses_[k]);
        block.first[k] = (lenses_[k] - together) / 2;
        block.end[k] = block.first[k] + together;
    }
    return block;
}

Choice ScreenParts::within(const LensBlock& block, Choice choice) const {
    for (std::size_t k = 0; k < 2; ++k) {
        const double first = double(block.first[k]), end = double(block.end[k]);
        choice[4 + k] = 2 * (first + (0.5 + 0.5 * choice[4 + k]) * (end - first)) / double(lenses_[k]) - 1;
    }
    return choice;
}

}  // namespace lfdsim
