// The perspective map between two pictures of a plane, from four corners: docs/measures.md, "Overlay". Floor 0.
#pragma once
#include <array>
#include <string>

namespace lfdsim {

/// A point (x, y) of a picture, pixels from its upper left corner, y downwards: (0.5, 0.5) is the centre of its first pixel.
using Point = std::array<double, 2>;

/// The corners of a screen as its viewer sees it: top left, top right, bottom right, bottom left.
using Corners = std::array<Point, 4>;

/// Throws InputError at `where` unless the corners are those of a convex quadrilateral in that order, at least 16 pixels apart,
/// with angles of 1 to 179 degrees.
void check_corners(const std::string& where, const Corners&);

/// The map of (x, y) to ((a x + b y + c)/w, (d x + e y + f)/w), w = g x + h y + i. It is scaled so that w is 1 at the first corner.
class Homography {
  public:
    /// Maps each corner of `from` to the same corner of `to`; both must pass check_corners(). Composed of the two closed forms
    /// from the unit square: P. Heckbert, "Fundamentals of Texture Mapping and Image Warping", 1989, section 2.2.3.
    Homography(const Corners& from, const Corners& to);

    /// Returns the image of a point. w is positive inside `from`; where it is not, the point has no image and the result is
    /// meaningless.
    Point operator()(double x, double y) const;
    double w(double x, double y) const { return m_[6] * x + m_[7] * y + m_[8]; }

    /// Returns the derivatives of the image by x (0) and by y (1).
    std::array<Point, 2> derivatives(double x, double y) const;

  private:
    std::array<double, 9> m_;  // a ... i
};

}  // namespace lfdsim
