// The nodal pick-up: which lens owns a panel pixel, and along which line that lens shows it. docs/model.md, "Elemental images".
#pragma once
#include "model/display.h"
#include "model/geometry.h"
#include "optics/lattice.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace lfdsim {

/// The line { (x, y) + (z - z_rear) (mx, my) } on the viewer's side of the lens: from panel point P through the front nodal point,
/// then parallel to itself from the rear one. (x, y) is the lens's axis. Or a line that is shifted against it.
struct NodalLine {
    double x, y, mx, my;
    bool owned;         // false: the nearest elemental image belongs to no lens, the pixel stays black
    bool dark = false;  // none of its light leaves that lens: it stays black, too
};

class Pickup {
  public:
    /// Of elemental images made for a display, `g` its resolve().
    Pickup(const Display& d, const Geometry& g) : Pickup(d, Meant{meant_geometry(d, g)}) {}

  private:
    struct Meant {
        const Geometry g;
    };
    Pickup(const Display& d, const Meant& meant)
        : lattice_(meant.g.lattice),
          viewer_(d.content.viewing_distance_mm),
          top_z_(meant.g.vertex_plane_mm),
          reduced_top_(meant.g.reduced_vertex_plane_mm),
          inverse_gap_(1 / meant.g.gap_mm),
          pixel_(d.panel.pixel_pitch_mm),
          left_(-0.5 * double(d.panel.pixels[0])),
          top_(0.5 * double(d.panel.pixels[1])),
          z_rear(meant.g.rear_principal_mm),
          scale(std::isinf(d.content.viewing_distance_mm) ? 1 : 1 + meant.g.gap_mm / (d.content.viewing_distance_mm - z_rear)),
          inverse_scale_(1 / scale) {}

  public:
    /// Centre of panel pixel (column, row), mm.
    double x_mm(double column) const { return (left_ + column + 0.5) * pixel_; }
    double y_mm(double row) const { return (top_ - row - 0.5) * pixel_; }

    /// The pixel whose column or row a panel point is in.
    double column(double x) const { return std::floor(x / pixel_ - left_); }
    double row(double y) const { return std::floor(top_ - y / pixel_); }

    /// The line of the panel point (x, y). The line from the viewer at (0, 0, D) through the nodal points of the lens at C meets
    /// the panel at C scale, scale = 1 + g / (D - z_rear): the centre of its elemental image. The nearest centre is found in the
    /// array's own axes, where lens (i, j) covers the unit square from (i, j).
    NodalLine line(double x, double y) const {
        return line(x, y, [](double, double, Shift&) { return true; });
    }

    /// How a line differs from the nodal one, in the array's frame: where it passes the rear principal plane, and in slope.
    struct Shift {
        double x = 0, y = 0, mx = 0, my = 0;
    };

    /// The same line, shifted by what shift(ux, uy, out) says of the panel point's place from its lens's axis, in the array's
    /// frame. It answers whether light of that point leaves the lens. Of strips its x and mx count.
    template <class ShiftOf>
    NodalLine line(double x, double y, const ShiftOf& shift_of) const {
        const auto at =
            optics::to_array(lattice_, x * inverse_scale_ - lattice_.offset[0], y * inverse_scale_ - lattice_.offset[1]);
        if (lattice_.strips) return line_of_strip(x, y, at.x, shift_of);
        const optics::Cell<double> lens =
            lattice_.staggered ? optics::lens_at(lattice_, at.x, at.y) : optics::Cell<double>{number(at.x, 0), number(at.y, 1)};
        const auto c = optics::in_display(lattice_, optics::axis_in_array(lattice_, lens));
        const auto u = optics::to_array(lattice_, x - c.x, y - c.y);
        Shift shift;
        const bool lit = shift_of(u.x, u.y, shift);
        const auto place = optics::to_display(lattice_, shift.x, shift.y), slope = optics::to_display(lattice_, shift.mx, shift.my);
        return {c.x + place.x,
                c.y + place.y,
                (c.x - x) * inverse_gap_ + slope.x,
                (c.y - y) * inverse_gap_ + slope.y,
                optics::holds(lattice_, lens),
                !lit};
    }

    const Lattice<double>& lattice() const { return lattice_; }

    /// Where the panel point (x, y) lies in its elemental image: in the array's axes, units of the elemental pitch, 0 at the
    /// centre, -0.5 .. 0.5.
    struct Place {
        double u, v;
        bool owned;
    };
    Place place(double x, double y) const {
        const NodalLine l = line(x, y);
        const auto off = optics::to_array(lattice_, x - l.x * scale, y - l.y * scale);
        return {off.x / (lattice_.pitch[0] * scale), lattice_.strips ? 0 : off.y / (lattice_.pitch[1] * scale), l.owned};
    }

  private:
    /// Strips show a panel point in the plane through their rear nodal line, in which the viewer's eyes, on a level with the
    /// panel's middle at the distance D, see it from one place. Along the strip its light passes plane plates: in the array's frame
    /// it rises by m_y for each mm of their reduced thickness.
    template <class ShiftOf>
    NodalLine line_of_strip(double x, double y, double owner_x, const ShiftOf& shift_of) const {
        const optics::Cell<double> lens{number(owner_x, 0), 0};
        const double axis = optics::axis_in_array(lattice_, lens).x, c = lattice_.cos_turn, s = lattice_.sin_turn;
        const auto p = optics::to_array(lattice_, x - lattice_.offset[0], y - lattice_.offset[1]);
        Shift shift;
        const bool lit = shift_of(p.x - axis, 0., shift);
        const double centre = axis + shift.x, mx = (axis - p.x) * inverse_gap_ + shift.mx;
        double my = -s / c * mx;
        if (!std::isinf(viewer_)) {
            // The eye is on the display's line y = 0, where it crosses the strip's plane of light; from the array's middle.
            const double eye_x = (centre + mx * (viewer_ - z_rear) + s * lattice_.offset[1]) / c;
            const auto eye = optics::to_array(lattice_, eye_x, -lattice_.offset[1]);
            my = (eye.y - p.y) / (reduced_top_ + viewer_ - top_z_);
        }
        const double rise = p.y + my * (reduced_top_ - top_z_ + z_rear);
        const auto at = optics::in_display(lattice_, optics::Place<double>{centre, rise});
        const auto slope = optics::to_display(lattice_, mx, my);
        return {at.x, at.y, slope.x, slope.y, optics::holds(lattice_, lens), !lit};
    }

    // The column or row of the lens at a place, from the array's middle; outside the count where there is none. Rounding down
    // without the library's floor is twice as fast.
    double number(double place, int axis) const {
        const double count = lattice_.count[axis], x = place * lattice_.per_pitch[axis] + count / 2;
        const double near = std::min(std::max(x, -1.), count), whole = double(std::int64_t(near));
        return whole > near ? whole - 1 : whole;
    }

    Lattice<double> lattice_;
    double viewer_, top_z_, reduced_top_;  // the viewer's distance, the vertex plane's, and its reduced one, from the panel, mm
    double inverse_gap_, pixel_, left_, top_;

  public:
    double z_rear;
    double scale;  // elemental pitch / lens pitch

  private:
    double inverse_scale_;
};

}  // namespace lfdsim
