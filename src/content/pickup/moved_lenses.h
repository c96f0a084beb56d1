// Nodal points of lenses that stand by themselves, for content that is made for the array as it was built. docs/model.md, "Errors".
// Floor 2.
#pragma once
#include "display/display.h"
#include "geometry/geometry.h"

#include <memory>
#include <vector>

namespace lfdsim {

/// A lens's nodal points: (x, y) from its place in the lattice, in the array's frame, turned about z alone; z over those of
/// lenses as described; mm.
struct MovedLens {
    struct Point {
        double x, y, z;
    };
    Point front, rear;
};

/// The nodal points of each lens, row by row from the lower left, with the array's wedge and bow. Null where content is not
/// made for such errors, or all lenses stand in the lattice alike. A lens's curvature does not move its nodal points.
std::shared_ptr<const std::vector<MovedLens>> moved_lenses(const Display&, const Geometry& built);

}  // namespace lfdsim
