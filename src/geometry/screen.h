// The part of the lens array that is a screen: what of it is in front of the panel. Floor 0.
#pragma once
#include "geometry/geometry.h"
#include "geometry/vec.h"

#include <array>
#include <cmath>

namespace lfdsim {

/// The screen: those points of the lenses' vertex plane whose straight line from the eye meets the panel's rectangle. An array
/// may extend beyond the panel: slanted strips without a count cover its bounding box, and may be twice as large. Measures that
/// are means over the screen count these points only.
class PanelBehind {
  public:
    explicit PanelBehind(const Geometry& g)
        : half_width_(0.5 * g.panel_width_mm), half_height_(0.5 * g.panel_height_mm), vertex_plane_(g.vertex_plane_mm) {}

    /// Returns whether the straight line from an eye in front of the vertex plane through its point (x, y) meets the panel;
    /// `share`: this part of the panel's width and height. All in mm.
    bool meets(const Vec3d& eye, double x, double y, double share = 1) const {
        const double on = vertex_plane_ / (eye[2] - vertex_plane_);  // from the vertex plane to the panel, over the way before it
        return std::abs(x + (x - eye[0]) * on) <= share * half_width_ && std::abs(y + (y - eye[1]) * on) <= share * half_height_;
    }

  private:
    double half_width_, half_height_, vertex_plane_;
};

/// Returns the size of the box about the part of the array that is in front of the panel as a distant viewer on the axis sees it:
/// along the array's x' and y', mm; 0 if there is none.
std::array<double, 2> screen_size_mm(const Geometry&);

/// Returns how many lenses lie side by side in front of the panel along an axis of the array, x' (0) or y' (1); at least 1.
double lenses_across(const Geometry&, std::size_t axis);

}  // namespace lfdsim
