// Rotations of models, and boxes about them. Floor 2, internal to content.
#pragma once
#include "base/constants.h"
#include "display/display.h"

#include <cmath>

namespace lfdsim {

/// The rotation R_y(yaw) R_x(tilt) R_z(roll) of docs/model.md, "Pose": roll about z (counter-clockwise as the viewer sees it, +x
/// towards +y), then tilt about x (positive raises the front, +z towards +y), then yaw about y (counter-clockwise from above, the
/// front towards +x).
struct Turn {
    double cr, sr, ct, st, cy, sy;
    Turn(double roll_deg, double tilt_deg, double yaw_deg)
        : cr(std::cos(roll_deg * degree)),
          sr(std::sin(roll_deg * degree)),
          ct(std::cos(tilt_deg * degree)),
          st(std::sin(tilt_deg * degree)),
          cy(std::cos(yaw_deg * degree)),
          sy(std::sin(yaw_deg * degree)) {}
    /// Returns the rotated point.
    Vec3d operator()(const float* p) const {
        const double x = cr * p[0] - sr * p[1], rolled = sr * p[0] + cr * p[1];
        const double y = ct * rolled + st * p[2], z = ct * p[2] - st * rolled;
        return {cy * x + sy * z, y, cy * z - sy * x};
    }
    /// Returns the point that is rotated to p.
    Vec3d inverse(const Vec3d& p) const {
        const double x = cy * p[0] - sy * p[2], z = cy * p[2] + sy * p[0];
        const double y = ct * p[1] - st * z;
        return {cr * x + sr * y, cr * y - sr * x, ct * z + st * p[1]};
    }
};

/// The bounding box of points; empty at first.
struct PointBounds {
    Vec3d low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};
    void add(const Vec3d& p) {
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], p[k]);
            high[k] = std::max(high[k], p[k]);
        }
    }
    double extent(std::size_t k) const { return high[k] - low[k]; }
    double middle(std::size_t k) const { return 0.5 * (low[k] + high[k]); }
};

}  // namespace lfdsim
