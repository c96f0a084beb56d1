#include "analysis/core/screen_parts.h"

#include "optics/lattice.h"

#include <algorithm>
#include <cmath>

namespace lfdsim {

ScreenParts::ScreenParts(const Display& d, const Geometry& g, int most_along)
    : lattice_(g.lattice), panel_behind_(g), array_mm_{g.array_width_mm, g.array_height_mm}, lenses_(lens_count(d.panel, d.array)) {
    std::array<std::int64_t, 2> cover = covering_count(d.panel, d.array);
    if (lattice_.strips) lenses_[1] = cover[1] = std::max(std::llround(lattice_.pitch[1] / lattice_.pitch[0]), 1LL);
    const double shift = std::hypot(d.errors.shift_mm[0], d.errors.shift_mm[1]);
    for (std::size_t k = 0; k < 2; ++k) {
        const std::int64_t wanted = cover[k] + 2 * std::int64_t(std::ceil(std::min(shift / lattice_.pitch[k], 1e9)));
        beside_[k] = std::max<std::int64_t>(lenses_[k] - wanted, 0) / 2;
        covered_[k] = lenses_[k] - 2 * beside_[k];
    }
    together_ = (std::max(covered_[0], covered_[1]) + most_along - 1) / most_along;
    for (std::size_t k = 0; k < 2; ++k) {
        count_[k] = int(std::max<std::int64_t>(covered_[k] / together_, 1));
        count_[k] -= covered_[k] % 2 == 1 && count_[k] % 2 == 0;  // no border of blocks may pass through the middle lens
    }
}

std::array<double, 2> ScreenParts::size_mm() const {
    std::array<double, 2> size = array_mm_;
    for (std::size_t k = 0; k < 2; ++k) size[k] -= 2 * double(beside_[k]) * lattice_.pitch[k];
    return size;
}

LensBlock ScreenParts::block(int part) const {
    const std::array<std::int64_t, 2> at{part % count_[0], count_[1] - 1 - part / count_[0]};
    LensBlock block{};
    for (std::size_t k = 0; k < 2; ++k) {
        // Border number i is the whole number of lenses nearest to i covered/count, and as far from the last block's end as its
        // counterpart is from the first one's: a mirror image of the display has the mirror images of the blocks.
        const auto border = [&](std::int64_t i) {
            const std::int64_t from_end = std::min(i, count_[k] - i),
                               lenses = (2 * from_end * covered_[k] + count_[k]) / (2 * count_[k]);
            return beside_[k] + (i == from_end ? lenses : covered_[k] - lenses);
        };
        block.first[k] = border(at[k]);
        block.end[k] = border(at[k] + 1);
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
        // A strip is one lens: its squares are chosen by the position along it.
        double& number = choice[k == 1 && lattice_.strips ? 1 : 4 + k];
        number = 2 * (first + (0.5 + 0.5 * number) * (end - first)) / double(lenses_[k]) - 1;
    }
    return choice;
}

bool ScreenParts::is_inner(const LensBlock& block, const Vec3d& eye) const {
    constexpr double inner = 0.8 + 1e-9;
    std::array<double, 2> share{};  // of the way from the array's middle to its border
    for (std::size_t k = 0; k < 2; ++k) share[k] = double(block.first[k] + block.end[k]) / double(lenses_[k]) - 1;
    const auto at = optics::in_display(lattice_, optics::Vec2<double>{0.5 * lattice_.count[0] * lattice_.pitch[0] * share[0],
                                                                      0.5 * lattice_.count[1] * lattice_.pitch[1] * share[1]});
    return std::max(std::abs(share[0]), std::abs(share[1])) <= inner && panel_behind_.meets(eye, at.x, at.y, inner);
}

}  // namespace lfdsim
