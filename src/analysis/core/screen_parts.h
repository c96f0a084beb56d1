// The screen divided into blocks of whole lenses. Floor 3.
#pragma once
#include "analysis/core/eye_rays.h"
#include "geometry/lattice.h"

#include <array>
#include <cstdint>

namespace lfdsim {

/// Neighbouring lenses: all in a range of columns and rows. Strips are cut into squares, which count as lenses here.
struct LensBlock {
    // Along x' and y', counted from the array's left and lower border; `end` is not included
    std::array<std::int64_t, 2> first, end;
    double lenses() const { return double(end[0] - first[0]) * double(end[1] - first[1]); }
};

/// Columns and rows of blocks that differ by at most one lens along each axis, symmetric about the array's middle, over the lenses
/// that cover the panel: what lies further out is not seen. A block has as few lenses, about the same number along both axes, as
/// give no more than `most_along` blocks along the longer side.
class ScreenParts {
  public:
    ScreenParts(const Display&, const Geometry&, int most_along);
    int columns() const { return count_[0]; }
    int rows() const { return count_[1]; }
    int count() const { return count_[0] * count_[1]; }
    /// Returns width and height of all parts together, mm.
    std::array<double, 2> size_mm() const;
    /// Returns a part's block; part = row x columns() + column, row 0 at the top.
    LensBlock block(int part) const;
    /// Returns a block of the same size in the middle of the array.
    LensBlock middle() const;
    /// Returns the choice of a line of sight among the lenses of a block for a choice among all lenses.
    Choice within(const LensBlock&, Choice) const;
    /// Returns whether the block's middle lies within the middle 80 % of the array's width and height, and of the panel's as the
    /// eye sees it.
    bool is_inner(const LensBlock&, const Vec3d& eye) const;

  private:
    Lattice<double> lattice_;
    PanelBehind panel_behind_;
    std::array<double, 2> array_mm_;
    std::array<std::int64_t, 2> lenses_;   // along x' and y'; of strips the squares along y'
    std::array<std::int64_t, 2> beside_;   // lenses before the first block: as many as beyond the last
    std::array<std::int64_t, 2> covered_;  // by blocks
    std::int64_t together_;                // lenses of a block along each axis
    std::array<int, 2> count_;             // blocks along x' and y'
};

/// The least share of a part that must be in front of the panel for the part to have a figure.
constexpr double least_on_screen = 0.5;

}  // namespace lfdsim
