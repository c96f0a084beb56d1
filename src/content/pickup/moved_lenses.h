// Nodal points of misaligned lenses, for content made for the array as built. docs/model.md, "Errors". Floor 2.
#pragma once
#include "display/display.h"
#include "geometry/geometry.h"

#include <memory>
#include <vector>

namespace lfdsim {

/// A lens's nodal points, mm: (x, y) from its lattice position, in the array's frame rotated about z only; z over the nodal
/// points of lenses as described.
struct MovedLens {
    struct Point {
        double x, y, z;
    };
    Point front, rear;
};

/// Returns the nodal points of each lens, row by row from the lower left, with the array's wedge and bow. Null if content is not
/// made for such errors, or if all lenses are alike in the lattice. A curvature error does not move nodal points.
std::shared_ptr<const std::vector<MovedLens>> moved_lenses(const Display&, const Geometry& built);

}  // namespace lfdsim
