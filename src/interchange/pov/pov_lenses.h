// Lenses that differ from each other, as shapes of POV-Ray: each lens's pose and surfaces, its part of what lies between lenses,
// and which others are near. Floor 2.
//
// There are two frames: the lens's, in which it is the perfect one, x and y from its axis, z from the panel; and the array's, x and
// y from its middle. In the array's a lens is moved and tilted about its viewer-side vertex.
// Lenses are numbered row by row from the lower left. A lens's column is the space over its aperture, its tile the part of the
// plane that belongs to it. Functions that return strings return shapes or transformations of POV-Ray.
#pragma once
#include "display/display.h"
#include "geometry/geometry.h"
#include "interchange/pov/pov_cell.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace lfdsim::peers {

/// The most lenses that may differ from each other in a scene, since each has separate shapes.
inline constexpr double most_pov_lenses = 20'000;

class PovLenses {
  public:
    PovLenses(const Display&, const Geometry&);

    std::size_t count() const { return lenses_.size(); }
    const PovCell& cell() const { return cell_; }
    bool at_border(std::size_t k) const;
    double low() const { return low_; }    // heights lower and higher than all that any lens reaches, in its own frame
    double high() const { return high_; }  // and in the array's
    const LensError& error(std::size_t k) const { return lenses_[k].error; }  // with the bow in its height
    double raised(std::size_t k) const { return lenses_[k].raised; }          // by the bow

    /// Returns the surfaces of lens k in its frame, with its curvature.
    std::vector<PlacedSurface> surfaces(std::size_t k) const;
    /// Returns the transformation from lens k's frame to the array's: Ry(tilt_y) Rx(tilt_x) about the vertex, then the shift.
    std::string frame(std::size_t k) const;
    /// Returns a column in the lens's frame, from low() to high(), its sides moved out by `wider`.
    std::string column(double radius, double wider) const;
    /// Returns a shape of lens k placed in the array's frame.
    std::string placed(std::size_t k, const std::string& shape) const;

    /// Returns the other lenses whose columns may meet lens k's column or tile.
    std::vector<std::size_t> near(std::size_t k) const;
    /// Returns whether columns of any two lenses may meet.
    bool overlap() const;

    /// Returns the tile of lens k, the rectangle about its lattice point, as wide as the pitch: x and y of two corners in the
    /// array's frame. Tiles of lenses at the array's border continue outwards without end. Tiles cover the plane.
    std::array<double, 4> tile(std::size_t k) const;
    /// Returns the tile of lens k as a box between two heights.
    std::string tile_box(std::size_t k, double low, double high) const;
    /// Returns the tile of lens k at one height, in the array's frame, less the holes, without the closing brace.
    std::string flat(std::size_t k, double z, const std::vector<std::string>& holes) const;

    /// Returns a box about all that belongs to lens k and its tile.
    std::string box(std::size_t k) const;
    /// Returns a box about all lenses from lens k to the end of its row.
    std::string row_box(std::size_t k) const;

    /// Returns the black sheet of the stops' holes, which are moved with the lenses but not tilted; nothing without stops.
    std::string stops() const;

    /// Returns the heights between which the walls of all lenses are, without the bow; nothing if there are none, or if they are
    /// less apart than four times what neighbours differ in height by the bow.
    std::optional<std::array<double, 2>> walls() const;
    /// Returns whether all lenses are at the same height.
    bool level() const;

  private:
    struct PovLens {
        std::int64_t i, j;
        std::array<double, 2> at;  // its lattice point, in the array's frame
        LensError error;
        double raised;
        double upright, aslant;  // of a unit vector along its axis: the part along the array's z, and the part across
        double reach;            // from the lattice point, as far as its column goes at heights of the lens
    };
    std::size_t number(std::int64_t i, std::int64_t j) const;
    std::string hole(std::size_t k) const;

    const Display& d_;
    const Geometry& g_;
    const PovCell cell_;
    double far_, low_, high_;
    std::vector<PovLens> lenses_;
};

}  // namespace lfdsim::peers
