// Lenses that differ from each other, in POV-Ray's words: each one's place and turn, its own surfaces, its part of what lies
// between lenses, and which others are near. Floor 2.
//
// Two frames: the lens's own, in which it is the perfect one, x and y from its axis, z from the panel; and the array's, x and y
// from its middle.
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

class PovStands {
  public:
    PovStands(const Display&, const Geometry&);

    std::size_t count() const { return stands_.size(); }
    const PovCell& cell() const { return cell_; }
    bool at_border(std::size_t k) const;
    double low() const { return low_; }    // heights lower and higher than all that any lens reaches, in its own frame
    double high() const { return high_; }  // and in the array's
    const LensError& error(std::size_t k) const { return stands_[k].error; }  // with the bow in its height
    double raised(std::size_t k) const { return stands_[k].raised; }          // by the bow

    /// Returns the surfaces of lens k in its own frame, with its own curvature.
    std::vector<PlacedSurface> surfaces(std::size_t k) const;
    /// The transformation from its own frame to the array's.
    std::string frame(std::size_t k) const;
    /// The space over its aperture in its own frame, from low() to high(), its sides moved out by `wider`.
    std::string column(double radius, double wider) const;
    /// Returns a shape of lens k placed in the array's frame.
    std::string placed(std::size_t k, const std::string& shape) const;

    /// Other lenses whose columns may meet its own or its tile.
    std::vector<std::size_t> near(std::size_t k) const;
    /// Whether columns of any two lenses may meet.
    bool overlap() const;

    /// The rectangle about its lattice point, as wide as the pitch: x and y of two corners in the array's frame. Those of lenses at
    /// the array's border go on outwards without end. Tiles cover the plane.
    std::array<double, 4> tile(std::size_t k) const;
    /// Returns the tile of lens k as a box between two heights.
    std::string tile_box(std::size_t k, double low, double high) const;
    /// Returns the tile of lens k at one height, in the array's frame, less the holes, without the closing brace.
    std::string flat(std::size_t k, double z, const std::vector<std::string>& holes) const;

    /// Boxes about all that belongs to a lens and its tile, and about all lenses of its row.
    std::string box(std::size_t k) const;
    std::string row_box(std::size_t k) const;

    /// The black sheet of the stops' holes, which are moved with the lenses but do not turn; nothing without stops.
    std::string stops() const;

    /// Heights between which the walls of all lenses are, when the bow is taken off: absent if there are none, or if they are less
    /// than four times what neighbours differ in height by the bow.
    std::optional<std::array<double, 2>> walls() const;
    /// Whether all lenses stand equally high.
    bool level() const;

  private:
    struct PovPose {
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
    std::vector<PovPose> stands_;
};

}  // namespace lfdsim::peers
