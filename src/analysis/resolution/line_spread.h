// Line spread: the distribution of the distance, in a plane, from the point at which an eye looks to the point that it is shown.
// Its transform is the modulation transfer function. Floor 3. docs/measures.md, "Resolution".
//
// A line of sight ends on a panel pixel, which shows what its lens's nodal line meets in the plane. The mean picture of an edge
// there, over the whole screen, is a step convolved with the line spread: no edge needs to be drawn, and all phases of lenses and
// pixels are included.
#pragma once
#include "analysis/core/estimate.h"
#include "analysis/core/subject.h"
#include "analysis/resolution/edge_view.h"

#include <array>
#include <vector>

namespace lfdsim {

/// Modulation over frequencies, from all lines of sight, and from all sets of them but one.
struct Modulation {
    std::vector<double> all;
    std::array<std::vector<double>, independent_sets> without;
};

/// Distances in one direction of one plane, weighted with the light of their lines.
class LineSpread {
  public:
    /// The distance of a line's shown point from the point that it looks at, and the line's light.
    struct WeightedOffset {
        double off_mm, light;  // from the point looked at to the one shown
    };
    using Sets = std::array<std::vector<WeightedOffset>, independent_sets>;
    explicit LineSpread(Sets sets) : sets_(std::move(sets)) {}

    /// Returns the width of the strip about 0 that contains a share of the light, mm; NaN if there is no light.
    double width_mm(double share) const;

    /// Returns the mean distance, mm.
    Estimate middle_mm() const;

    /// Returns the modulus of the Fourier transform at `count` frequencies from 0 on, `step_per_mm` apart.
    Modulation mtf(double step_per_mm, int count) const;

  private:
    Sets sets_;
};

/// The lines of sight of one eye through a display whose elemental images are made by the nodal pick-up.
class SeenThroughLenses {
  public:
    /// Traces one channel at its wavelengths; lines count where they end on rectangles that emit it. The eye: mm, display frame.
    SeenThroughLenses(const Subject&, const Vec3d& eye_mm, std::size_t channel);
    /// Joins red, green and blue, weighted by luminance.
    explicit SeenThroughLenses(const std::array<SeenThroughLenses, 3>&);

    /// The position of the panel's pixels: as described, or shifted at random by up to a pixel, as assembly may leave them. On
    /// screens of many lenses both give the same; elsewhere their difference is part of the stated error.
    enum class PixelPositions { as_described, anywhere };

    /// Returns the line spread in a plane at a height above the panel, below the eye, along a direction.
    LineSpread spread(double z_mm, const Direction&, PixelPositions) const;

  private:
    /// A line of sight and the nodal line of the point that it is shown.
    struct LinePair {
        std::array<double, 2> at, slope;        // nodal line of the pixel, where it meets the plane of H'
        std::array<double, 2> aimed, straight;  // line of sight, where it meets the vertex plane, and its slope
        double light;
    };
    using Sets = std::array<std::vector<LinePair>, independent_sets>;
    /// The point of the panel, pixels, for which the content at a line's end is made, and its light on a white panel.
    struct ShownPoint {
        double column, row, light;
    };
    /// Traces lines of sight in light of one wavelength. shown() returns the ShownPoint of a position, in pixels from the panel's
    /// corner.
    template <class ShownAt>
    void trace(const Subject&, const Geometry&, const Vec3d& eye, int lines, const ShownAt& shown);
    double principal_mm_, vertex_mm_;
    Sets as_described_, anywhere_;
};

}  // namespace lfdsim
