// The part of the lens array that is a screen: what of it is in front of the panel. Floor 0.
#pragma once
#include "base/vec.h"
#include "geometry/geometry.h"

#include <array>
#include <cmath>

namespace lfdsim {

/// An array may reach over the panel: slanted strips without a count cover its bounding box, and may be twice as large. The screen
/// that an eye sees holds those points of the lenses' vertex plane whose straight line from the eye meets the panel's rectangle.
/// Measures that are means over the screen count these alone.
class PanelBehind {
  public:
    explicit PanelBehind(const Geometry& g)
        : half_width_(0.5 * g.panel_width_mm), half_height_(0.5 * g.panel_height_mm), vertex_plane_(g.vertex_plane_mm) {}

    /// For a point (x, y) of the vertex plane, an eye in front of that, and this share of the panel's width and height.
    bool meets(const Vec3d& eye, double x, double y, double share = 1) const {
        const double on = vertex_plane_ / (eye[2] - vertex_plane_);  // from the vertex plane to the panel, over the way before it
        return std::abs(x + (x - eye[0]) * on) <= share * half_width_ && std::abs(y + (y - eye[1]) * on) <= share * half_height_;
    }

  private:
    double half_width_, half_height_, vertex_plane_;
};

/// The box about what is both the array's and in front of the panel, seen from far away on the axis: along the array's own x and y,
/// mm; 0 where there is nothing.
std::array<double, 2> screen_size_mm(const Geometry&);

/// How many lenses stand side by side before the panel along an axis of the array.
double lenses_across(const Geometry&, std::size_t axis);

}  // namespace lfdsim
