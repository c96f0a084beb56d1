// The nodal pick-up: which lens owns a panel pixel, and along which line that lens shows it. docs/model.md, "Elemental images".
#pragma once
#include "content/pickup/moved_lenses.h"
#include "display/display.h"
#include "geometry/geometry.h"
#include "geometry/resolve.h"
#include "optics/lattice.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace lfdsim {

/// The line { (x, y) + (z - z_rear) (mx, my) } on the viewer's side of the lens: from panel point P through the front nodal
/// point, then parallel to itself from the rear one. (x, y) is the lens's axis, unless it stands by itself. Or a line that is
/// shifted against it.
struct NodalLine {
    double x, y, mx, my;
    bool owned;         // false: the nearest elemental image belongs to no lens, the pixel stays black
    bool dark = false;  // none of its light leaves that lens: it stays black, too
};

class Pickup {
  public:
    /// The pick-up of elemental images made for a display, `g` its resolve().
    Pickup(const Display& d, const Geometry& g) : Pickup(d, IntendedGeometry{meant_geometry(d, g)}) { moved_ = moved_lenses(d, g); }

  private:
    struct IntendedGeometry {
        const Geometry g;
    };
    Pickup(const Display& d, const IntendedGeometry& meant)
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

    /// The line of the panel point (x, y). The line from the viewer at (0, 0, D) through the nodal points of the lens at C
    /// meets the panel at C scale, scale = 1 + g / (D - z_rear): the centre of its elemental image. The nearest centre is found
    /// in the array's own axes, where lens (i, j) covers the unit square from (i, j).
    NodalLine line(double x, double y) const {
        return line(x, y, [](double, double, Shift&) { return true; });
    }

    /// How a line differs from the nodal one, in the array's frame: where it passes the rear principal plane, and in slope.
    struct Shift {
        double x = 0, y = 0, mx = 0, my = 0;
    };

    /// The line of a panel point, shifted by what shift(ux, uy, out) says of the panel point's place from its lens's axis, in
    /// the array's frame. It answers whether light of that point leaves the lens. Of strips its x and mx count.
    template <class ShiftOf>
    NodalLine line(double x, double y, const ShiftOf& shift_of) const {
        if (moved_) return line_of_moved(x, y, shift_of);
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
    /// Whether lenses stand by themselves: columns and rows then have nothing in common.
    bool irregular() const { return moved_ != nullptr; }

    /// Where the panel point (x, y) lies in its elemental image: in the array's axes, units of the elemental pitch, 0 at the
    /// centre, -0.5 .. 0.5.
    struct ElementalPosition {
        double u, v;
        bool owned;
    };
    ElementalPosition place(double x, double y) const {
        const NodalLine l = line(x, y);
        auto off = optics::to_array(lattice_, x - l.x * scale, y - l.y * scale);
        if (moved_) {
            const auto centre = image_centre(owner_of_moved(x, y));
            off = optics::to_array(lattice_, x - centre.x, y - centre.y);
        }
        return {off.x / (lattice_.pitch[0] * scale), lattice_.strips ? 0 : off.y / (lattice_.pitch[1] * scale), l.owned};
    }

    /// Whether the panel point (x, y) is nearer than `margin` mm to the border of an elemental image.
    bool near_border(double x, double y, double margin) const {
        const ElementalPosition at = place(x, y);
        return !optics::in_cell(lattice_, at.u * lattice_.pitch[0], at.v * lattice_.pitch[1], -margin / scale);
    }

  private:
    /// A lens's nodal points from the array's middle, in the array's frame, mm; 1/g of that lens; how far its rear one is above
    /// those of lenses as described.
    struct Nodal {
        optics::Vec2<double> front, rear;
        double per_gap, up;
    };

    /// The lens at that number, or where there is none the nearest.
    optics::Cell<double> nearest(optics::Cell<double> lens) const {
        return {std::clamp(lens.i, 0., lattice_.count[0] - 1), std::clamp(lens.j, 0., lattice_.count[1] - 1)};
    }

    /// The nodal points of a misaligned lens.
    Nodal nodal(optics::Cell<double> lens) const {
        lens = nearest(lens);
        const MovedLens& moved = (*moved_)[std::size_t(lens.j * lattice_.count[0] + lens.i)];
        const auto at = optics::axis_in_array(lattice_, lens);
        return {{at.x + moved.front.x, at.y + moved.front.y},
                {at.x + moved.rear.x, at.y + moved.rear.y},
                1 / (1 / inverse_gap_ + moved.front.z),
                moved.rear.z};
    }

    /// Where on the panel the middle of that lens's elemental image is: its line goes to the viewer.
    optics::Vec2<double> image_centre(optics::Cell<double> lens) const {
        const Nodal at = nodal(lens);
        const auto front = optics::in_display(lattice_, at.front), rear = optics::in_display(lattice_, at.rear);
        const double slope = 1 / (viewer_ - z_rear - at.up) / at.per_gap;  // 0 of a viewer at infinity
        return {front.x + rear.x * slope, front.y + rear.y * slope};
    }

    optics::Cell<double> lens_near(double x, double y) const {
        const auto at =
            optics::to_array(lattice_, x * inverse_scale_ - lattice_.offset[0], y * inverse_scale_ - lattice_.offset[1]);
        return optics::lens_at(lattice_, at.x, at.y);
    }

    /// The lens in whose cell, moved to where its elemental image is, a panel point lies: found in a few steps.
    optics::Cell<double> owner_of_moved(double x, double y) const {
        optics::Cell<double> lens = lens_near(x, y);
        for (int step = 0; step < 8; ++step) {
            const optics::Cell<double> near = nearest(lens);
            const auto centre = image_centre(near), described = optics::in_display(lattice_, optics::axis_in_array(lattice_, near));
            const auto next = lens_near(x - (centre.x - described.x * scale), y - (centre.y - described.y * scale));
            if (next.i == lens.i && next.j == lens.j) break;
            lens = next;
        }
        return lens;
    }

    template <class ShiftOf>
    NodalLine line_of_moved(double x, double y, const ShiftOf& shift_of) const {
        const optics::Cell<double> lens = owner_of_moved(x, y);
        const Nodal at = nodal(lens);
        if (lattice_.strips) return line_of_strip(x, y, lens, at, shift_of);
        const auto p = optics::to_array(lattice_, x - lattice_.offset[0], y - lattice_.offset[1]);
        Shift shift;
        const bool lit = shift_of(p.x - at.front.x, p.y - at.front.y, shift);
        const double mx = (at.front.x - p.x) * at.per_gap + shift.mx, my = (at.front.y - p.y) * at.per_gap + shift.my;
        const auto through =
            optics::in_display(lattice_, optics::Vec2<double>{at.rear.x + shift.x - mx * at.up, at.rear.y + shift.y - my * at.up});
        const auto slope = optics::to_display(lattice_, mx, my);
        return {through.x, through.y, slope.x, slope.y, optics::holds(lattice_, lens), !lit};
    }

    /// Strips show a panel point in the plane through their rear nodal line, in which the viewer's eyes, on a level with the
    /// panel's middle at the distance D, see it from one place. Along the strip its light passes plane plates: in the array's
    /// frame it rises by m_y for each mm of their reduced thickness.
    template <class ShiftOf>
    NodalLine line_of_strip(double x, double y, double owner_x, const ShiftOf& shift_of) const {
        const optics::Cell<double> lens{number(owner_x, 0), 0};
        const double axis = optics::axis_in_array(lattice_, lens).x;
        return line_of_strip(x, y, lens, {{axis, 0}, {axis, 0}, inverse_gap_, 0}, shift_of);
    }

    template <class ShiftOf>
    NodalLine line_of_strip(double x, double y, optics::Cell<double> lens, const Nodal& at_lens, const ShiftOf& shift_of) const {
        const double c = lattice_.cos_turn, s = lattice_.sin_turn;
        const auto p = optics::to_array(lattice_, x - lattice_.offset[0], y - lattice_.offset[1]);
        Shift shift;
        const bool lit = shift_of(p.x - at_lens.front.x, 0., shift);
        const double mx = (at_lens.front.x - p.x) * at_lens.per_gap + shift.mx, centre = at_lens.rear.x + shift.x - mx * at_lens.up;
        double my = -s / c * mx;
        if (!std::isinf(viewer_)) {
            // The eye is on the display's line y = 0, where it crosses the strip's plane of light; from the array's middle.
            const double eye_x = (centre + mx * (viewer_ - z_rear) + s * lattice_.offset[1]) / c;
            const auto eye = optics::to_array(lattice_, eye_x, -lattice_.offset[1]);
            my = (eye.y - p.y) / (reduced_top_ + viewer_ - top_z_);
        }
        const double rise = p.y + my * (reduced_top_ - top_z_ + z_rear);
        const auto at = optics::in_display(lattice_, optics::Vec2<double>{centre, rise});
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

    std::shared_ptr<const std::vector<MovedLens>> moved_;  // none where all stand in the lattice alike
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
