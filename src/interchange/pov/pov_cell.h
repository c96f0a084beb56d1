// A cell of the array as POV-Ray's shapes: its prism, the hole of a lens in it, its sides. Floor 2.
//
// Shapes are in the array's frame, x and y from the lens's axis, z from the panel, mm. Strips, which have no end, are cell_half()
// long to both sides.
#pragma once
#include "geometry/geometry.h"
#include "optics/lattice.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace lfdsim::peers {

/// The cell of an array's lenses. Functions that return strings return shapes of POV-Ray.
class PovCell {
  public:
    explicit PovCell(const Geometry&);

    /// Returns half the sides of the box about the cell.
    std::array<double, 2> half() const { return half_; }
    /// Returns the longer of them.
    double widest_half() const;
    /// Returns the distance of the cell's corners from the axis.
    double outer_radius() const { return outer_radius_; }
    double half_length() const { return half_[1]; }  // of a strip
    bool strips() const { return lattice_.strips; }

    /// Returns the space over the cell between two heights, its sides moved out by `wider`.
    std::string prism(double low, double high, double wider) const;
    /// Returns the box about that space.
    std::string box(double low, double high, double wider) const;
    /// Returns the space over a lens's aperture between two heights: a cylinder, of strips a box.
    std::string column(double radius, double low, double high) const;
    /// Returns the flat part of the cell outside a lens's aperture (0: all of it), a little wider than the cell, without the
    /// closing brace.
    std::string flat(double z, double radius) const;

    /// A side of the cell. Where there is a lens beyond it, that lens's axis is at `beyond`.
    struct PrismSide {
        std::array<double, 2> from, to, beyond;
        std::string at_border;  // POV-Ray's condition on I and J: no lens beyond it
    };
    std::vector<PrismSide> sides() const;

    /// Return the coordinates of the axis of lens (I, J), variables of POV-Ray, in the array's frame, as formulas.
    std::string axis_x() const;
    std::string axis_y() const;
    /// Returns the last number of lenses along x' (0) or y' (1).
    std::int64_t last(std::size_t axis) const { return std::int64_t(lattice_.count[axis]) - 1; }

  private:
    Lattice<double> lattice_;
    std::array<double, 2> half_;
    optics::CellCorners<double> corners_;
    double outer_radius_;
};

}  // namespace lfdsim::peers
