// A cell of the array as POV-Ray's shapes: its prism, the hole of a lens in it, its sides. Floor 2.
//
// The array's frame, x and y from the lens's axis, z from the panel, mm. Strips, which have no end, are cell_half() long to either
// side.
#pragma once
#include "display/display.h"
#include "geometry/geometry.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace lfdsim::peers {

class PovCell {
  public:
    PovCell(const Display&, const Geometry&);

    /// Half the sides of the box about the cell, the longer of them, and how far the cell's corners are from the axis.
    std::array<double, 2> half() const { return half_; }
    double widest_half() const;
    double outer_radius() const { return outer_radius_; }
    double half_length() const { return half_[1]; }  // of a strip
    bool strips() const { return lattice_.strips; }

    /// The space over the cell between two heights, its sides moved out by `wider`.
    std::string prism(double low, double high, double wider) const;
    /// The box about it.
    std::string box(double low, double high, double wider) const;
    /// The space over a lens's aperture: a cylinder, of strips a box.
    std::string column(double radius, double low, double high) const;
    /// The flat part of the cell outside a lens's aperture (0: all of it), a little wider than the cell. Without the closing brace.
    std::string flat(double z, double radius) const;

    /// A side of the cell. Where there is a lens beyond it, that lens's axis is at `beyond`.
    struct PrismSide {
        std::array<double, 2> from, to, beyond;
        std::string at_border;  // POV-Ray's condition on I and J: no lens beyond it
    };
    std::vector<PrismSide> sides() const;

    /// The place of lens (I, J), variables of POV-Ray, in the array's frame: x, and y.
    std::string axis_x() const;
    std::string axis_y() const;
    std::int64_t last(std::size_t axis) const { return std::int64_t(lattice_.count[axis]) - 1; }

  private:
    Lattice<double> lattice_;
    std::array<double, 2> half_;
    double outer_radius_;
};

}  // namespace lfdsim::peers
