#include "content/pickup/moved_lenses.h"

#include "base/constants.h"
#include "engine/scene/misalignment.h"
#include "geometry/lens_misalignment.h"
#include "optics/lattice.h"

#include <cmath>

namespace lfdsim {
namespace {

/// Returns the direction of a lens's axis, Ry(tilt_y) Rx(tilt_x) applied to the z axis.
Vec3d axis_direction(const LensError& e) {
    const double x = e.tilt_deg[0] * degree, y = e.tilt_deg[1] * degree;
    return {std::sin(y) * std::cos(x), -std::sin(x), std::cos(y) * std::cos(x)};
}

}  // namespace

std::shared_ptr<const std::vector<MovedLens>> moved_lenses(const Display& d, const Geometry& built) {
    if (d.content.made_for != MadeFor::built || !is_irregular(d.errors)) return nullptr;
    const Lattice<double>& lattice = built.lattice;
    double wedge[3][3];
    wedge_of(d.errors, built, wedge);
    const auto columns = std::size_t(lattice.count[0]);
    const std::vector<LensError> errors = lenses_as_built(d, lattice);
    auto moved = std::make_shared<std::vector<MovedLens>>();
    moved->reserve(errors.size());
    for (std::size_t k = 0; k < errors.size(); ++k) {
        const LensError& e = errors[k];
        const auto place = optics::axis_in_array(lattice, optics::Cell<double>{double(k % columns), double(k / columns)});
        const Vec3d along = axis_direction(e);
        // Returns the point of the lens's axis at a height, displaced, tilted about the vertex, and wedged about the array's
        // centre in the vertex plane; relative to its position as described.
        const auto point = [&](double z_mm) {
            const double above = z_mm - built.vertex_plane_mm;
            const double from[3] = {place.x + e.aside_mm[0] + above * along[0], place.y + e.aside_mm[1] + above * along[1],
                                    e.height_mm + above * along[2]};
            double to[3] = {-place.x, -place.y, -above};
            for (int row = 0; row < 3; ++row)
                for (int column = 0; column < 3; ++column) to[row] += wedge[row][column] * from[column];
            return MovedLens::Point{to[0], to[1], to[2]};
        };
        moved->push_back({point(built.front_principal_mm), point(built.rear_principal_mm)});
    }
    return moved;
}

}  // namespace lfdsim
