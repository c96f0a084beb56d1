// The screen in parts of whole lenses. Floor 3.
#pragma once
#include "analysis/core/eye_rays.h"
#include "geometry/lattice.h"

#include <array>
#include <cstdint>

namespace lfdsim {

/// Some lenses next to each other, all in their columns and rows. Strips are cut into squares, which count as lenses here.
struct LensBlock {
    std::array<std::int64_t, 2> first, end;  // along the array's own x and y, from its left and its lower border
    double lenses() const { return double(end[0] - first[0]) * double(end[1] - first[1]); }
};

/// Columns and rows of blocks as equal as lenses allow. A block has as few lenses, the same number along both axes, as give no more
/// than `most_along` blocks along the longer side.
class ScreenParts {
  public:
    ScreenParts(const Display&, const Geometry&, int most_along);
    int columns() const { return count_[0]; }
    int rows() const { return count_[1]; }
    int count() const { return count_[0] * count_[1]; }
    /// Row 0 is at the top.
    LensBlock block(int part) const;
    /// Returns a block of that size in the middle of the array.
    LensBlock middle() const;
    /// The line of sight of a choice among all lenses, among those of a block.
    Choice within(const LensBlock&, Choice) const;
    /// Whether the block's middle lies in the middle 8/10 of the array's width and height, and of the panel's as the eye sees it.
    bool is_inner(const LensBlock&, const Vec3d& eye) const;

  private:
    Lattice<double> lattice_;
    PanelBehind panel_behind_;
    std::array<std::int64_t, 2> lenses_;
    std::int64_t together_;
    std::array<int, 2> count_;
};

/// Parts of which less is in front of the panel have no figure of their own.
constexpr double least_on_screen = 0.5;

}  // namespace lfdsim
