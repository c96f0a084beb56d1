// Points and directions in double precision, for computations outside the tracer (its Vec3 is in optics/surface.h). Floor 0.
#pragma once
#include <cmath>

#include "display/display.h"

namespace lfdsim {

constexpr Vec3d minus(const Vec3d& a, const Vec3d& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
constexpr Vec3d times(double s, const Vec3d& a) { return {s * a[0], s * a[1], s * a[2]}; }
constexpr double dot(const Vec3d& a, const Vec3d& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
constexpr Vec3d cross(const Vec3d& a, const Vec3d& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline double length(const Vec3d& a) { return std::hypot(a[0], a[1], a[2]); }
/// Returns the unit vector along a, which must not be 0.
inline Vec3d normalised(const Vec3d& a) {
    const double whole = length(a);
    return {a[0] / whole, a[1] / whole, a[2] / whole};
}

}  // namespace lfdsim
