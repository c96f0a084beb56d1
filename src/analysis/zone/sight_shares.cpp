// The shares of wrong, mixed and dark lines of sight. docs/measures.md, "Viewing zone".

#include "analysis/zone/zone_search.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace lfdsim {
namespace {

/// Returns whether the middle of the elemental image of the lens that the line passes lies on the panel; of a strip, the point of
/// the image's middle line beside the line's end.
bool image_on_panel(const Pickup& pickup, const Panel& panel, const Sight& s) {
    const auto [x, y] = pickup.image_centre_beside(s.cell, s.x, s.y);
    const double half = 0.5 * panel.pixel_pitch_mm;
    return std::abs(x) <= half * double(panel.pixels[0]) && std::abs(y) <= half * double(panel.pixels[1]);
}

}  // namespace

SightShares sight_shares(const EyeRays& rays, const Pickup& pickup, const Display& d, const Vec3d& eye,
                         std::span<const Choice> choices) {
    std::int64_t aimed = 0, through = 0, dark = 0, wrong = 0;
    // Numbers of lines by the columns and rows from their lens to the owner of their pixel
    std::map<std::pair<long, long>, std::int64_t> towards;
    for (const Choice& choice : choices) {
        const Sight s = rays.look(eye, choice);
        if (!s.on_screen) continue;
        ++aimed;
        if (!s.through) {
            ++dark;
            continue;
        }
        if (!s.by_lens) continue;
        if (!image_on_panel(pickup, d.panel, s)) {
            dark += !(s.light > 0);
            continue;
        }
        ++through;
        const auto [column, row] = pixel_place(d.panel, s);
        const NodalLine owner = pickup.line(pickup.x_mm(std::floor(column)), pickup.y_mm(std::floor(row)));
        if (s.light > 0 && owner.owned) {
            const Lattice<double>& lattice = pickup.lattice();
            // Columns are counted in halves of the pitch, since staggered rows are shifted by half of it.
            const auto to = optics::axis_in_array(lattice, owner.lens), from = optics::axis_in_array(lattice, s.cell);
            const std::pair way{std::lround(2 * (to.x - from.x) / lattice.pitch[0]), std::lround(owner.lens.j - s.cell.j)};
            wrong += way != std::pair{0L, 0L};
            ++towards[way];
        } else {
            ++wrong;
            ++dark;
        }
    }
    if (through == 0) return {std::nan(""), std::nan(""), 1};
    std::int64_t most = 0;
    for (const auto& [way, lines] : towards) most = std::max(most, lines);
    const double all = double(through);
    return {double(wrong) / all, 1 - double(most) / all, double(dark) / double(aimed)};
}

}  // namespace lfdsim
