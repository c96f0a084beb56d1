// Line spread: how far the point of a plane that an eye is shown lies from the point that it looks at. Its transform is the
// modulation transfer. Floor 3.
//
// A line of sight ends on a panel pixel, which shows what its lens's nodal line meets in the plane. Of an edge there, an eye that
// looks through all the screen sees the mean over these distances: no edge needs to be drawn, and no phase of lenses against
// pixels is left out.
#pragma once
#include "analysis/core/estimate.h"
#include "analysis/core/subject.h"
#include "analysis/resolution/edge_view.h"

#include <array>
#include <vector>

namespace lfdsim {

/// Modulation over frequencies, of all lines of sight and of all sets of them but one.
struct Modulation {
    std::vector<double> all;
    std::array<std::vector<double>, independent_sets> without;
};

/// Distances in one direction of one plane, with the light of their lines.
class LineSpread {
  public:
    /// The distance of a line's shown point from the point that it looks at, and the line's light.
    struct WeightedOffset {
        double off_mm, light;
    };
    using Sets = std::array<std::vector<WeightedOffset>, independent_sets>;
    explicit LineSpread(Sets sets) : sets_(std::move(sets)) {}

    /// Width of the strip about 0 that contains this share of the light; NaN where there is none.
    double width_mm(double share) const;

    /// The mean distance, weighted by light.
    Estimate middle_mm() const;

    /// The modulus of the transform at `count` frequencies from 0 on in equal steps.
    Modulation mtf(double step_per_mm, int count) const;

  private:
    Sets sets_;
};

/// The lines of sight of one eye through a display whose elemental images are those of the nodal pick-up.
class SeenThroughLenses {
  public:
    /// Traces one channel, where it shines and at its wavelengths.
    SeenThroughLenses(const Subject&, const Vec3d& eye_mm, std::size_t channel);
    /// Joins red, green and blue, weighted as luminance.
    explicit SeenThroughLenses(const std::array<SeenThroughLenses, 3>&);

    /// The position of the panel's pixels: as described, or shifted at random by up to a pixel, as assembly may leave them. On a
    /// screen of many lenses the two agree; elsewhere their difference is part of the figure's stated error.
    enum class PixelPositions { as_described, anywhere };

    /// The line spread in a plane at a height above the panel, below the eye, along a direction.
    LineSpread spread(double z_mm, const Direction&, PixelPositions) const;

  private:
    /// A line of sight and the nodal line of the point that it is shown.
    struct LinePair {
        std::array<double, 2> at, slope;        // of the pixel's nodal line at the principal plane
        std::array<double, 2> aimed, straight;  // of the line of sight at the vertex plane
        double light;
    };
    using Sets = std::array<std::vector<LinePair>, independent_sets>;
    /// The point of the panel for which the content at a line's end is made, and its light on a white panel.
    struct ShownPoint {
        double column, row, light;
    };
    /// Lines of sight through the display in light of one wavelength; `shown` of a place, in pixels from the panel's corner.
    template <class ShownAt>
    void trace(const Subject&, const Geometry&, const Vec3d& eye, int lines, const ShownAt& shown);
    double principal_mm_, vertex_mm_;
    Sets as_described_, anywhere_;
};

}  // namespace lfdsim
