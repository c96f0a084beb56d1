// Which views a display has: strips of its elemental images one pixel wide. Floor 3.
#pragma once
#include "analysis/core/subject.h"
#include "analysis/crosstalk/intended_panel.h"

#include <cstdint>
#include <vector>

namespace lfdsim {

/// A view is what is meant for the slopes within half a step a/g of its middle. The middles are at k a/g from the screen's normal;
/// where elemental images are a whole even number of pixels wide, so that over the whole array they and the pixels come apart by
/// less than a pixel, they are at (k + 1/2) a/g. Where the centres of most pixels would lie about the borders of such views, as
/// with lenses that are shifted by half a pixel, the other of both holds. Only views that lie in an elemental image as a whole
/// count.
class PixelViews {
  public:
    /// `pixels`: with content made for whole pixels.
    PixelViews(const Subject&, const MeantPanel& pixels);

    double step_slope() const { return step_; }
    /// Middle of the innermost one, in steps: 0 or 1/2.
    double innermost() const { return innermost_; }
    std::int64_t count() const { return count_; }

    /// Middles in steps, rising, the innermost one among them; `most` of them at most, evenly.
    std::vector<double> middles(std::int64_t most) const;

  private:
    double step_, innermost_ = 0;
    std::int64_t count_ = 0;
};

/// Width of an elemental image along a row of the panel, mm; strips lean against it.
double image_along_row_mm(const Subject&);

}  // namespace lfdsim
