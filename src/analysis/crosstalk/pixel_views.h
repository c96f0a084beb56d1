// The views of a display: strips of its elemental images one panel pixel wide. Floor 3.
#pragma once
#include "analysis/core/subject.h"
#include "analysis/crosstalk/intended_panel.h"

#include <cstdint>
#include <vector>

namespace lfdsim {

/// The views' middles and number. A view consists of what is intended for slopes within half a step, a/g, of its middle. The
/// middles are at k a/g; where elemental images are an even number of pixels wide, so that over the whole array images and pixels
/// come apart by less than a pixel, they are at (k + 1/2) a/g. If most pixels' centres would then lie near the borders of views,
/// as with lenses shifted by half a pixel, the other of both holds. Only whole views count, whose strips lie in the elemental
/// image.
class PixelViews {
  public:
    /// `pixels`: the panel with content made for whole pixels.
    PixelViews(const Subject&, const MeantPanel& pixels);

    /// Returns the slope from view to view, a/g.
    double step_slope() const { return step_; }
    /// Returns the middle of the innermost view, in steps: 0 or 1/2.
    double innermost() const { return innermost_; }
    /// Returns the number of whole views; 0 if elemental images are narrower than a pixel.
    std::int64_t count() const { return count_; }

    /// Returns the views' middles, in steps, ascending: all of them, or at most `most` at equal distances; the innermost is among
    /// them.
    std::vector<double> middles(std::int64_t most) const;

  private:
    double step_, innermost_ = 0;
    std::int64_t count_ = 0;
};

/// Returns the width of an elemental image along a row of the panel, mm: p', over cos(slant) of strips.
double image_along_eyes_mm(const Display&, const Geometry&);

/// Returns the width of the viewing zone, E p'/g along a row of the panel, mm, at `eye_mm` = E from the rear principal plane.
double viewing_zone_mm(const Display&, const Geometry&, double eye_mm);

}  // namespace lfdsim
