// The nodal pick-up: the lens that owns a panel pixel, and the line along which that lens shows it. docs/model.md, "Elemental
// images".
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

/// The line { (x, y) + (z - z_rear) (mx, my) } on the viewer's side of a lens, in the display's frame, mm: from the panel point
/// through the front nodal point, then parallel to itself from the rear one. (x, y) is the lens's axis, unless the lens is
/// misaligned or the line is shifted by a traced pick-up.
struct NodalLine {
    double x, y, mx, my;
    bool owned;         // false: the nearest elemental image belongs to no lens, the pixel stays black
    bool dark = false;  // none of its light leaves the lens; its pixel is black, too
    optics::Cell<double> lens{};
};

/// The elemental images of a display. Panel points are in mm from the panel's centre.
class Pickup {
  public:
    /// The pick-up of elemental images made for a display, `g` its resolve(): of the display as described, or as built.
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
    /// Return the centre of panel pixel (column, row), mm.
    double x_mm(double column) const { return (left_ + column + 0.5) * pixel_; }
    double y_mm(double row) const { return (top_ - row - 0.5) * pixel_; }

    /// Return the column or row of the pixel that contains a panel point.
    double column(double x) const { return std::floor(x / pixel_ - left_); }
    double row(double y) const { return std::floor(top_ - y / pixel_); }

    /// Returns the line of the panel point P = (x, y), of slope (C - P)/g. The elemental image of the lens at C is centred at e
    /// C, with e = `scale` = 1 + g/(D' - z_rear), where the line from the viewer at (0, 0, D') through its nodal points meets the
    /// panel. The owner is therefore the lens whose cell contains P/e.
    NodalLine line(double x, double y) const {
        return line(x, y, [](double, double, Shift&) { return true; });
    }

    /// The difference of a line from the nodal one, in the array's frame: position in the plane of the rear principal point, mm,
    /// and slope.
    struct Shift {
        double x = 0, y = 0, mx = 0, my = 0;
    };

    /// Returns the line of a panel point, shifted by what shift_of(ux, uy, out) writes for the panel point's position u from its
    /// lens's axis, in the array's frame. shift_of() returns whether light of that point leaves the lens. Of strips only x and mx
    /// of the shift count.
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
                !lit,
                lens};
    }

    const Lattice<double>& lattice() const { return lattice_; }
    /// Returns whether lenses differ, so that pixels of a column or row have nothing in common.
    bool irregular() const { return moved_ != nullptr; }

    /// Returns the centre of a lens's elemental image on the panel, in the display's frame, mm: e C; of a misaligned lens
    /// F - g (V - R)/(D' - z_R), V = (0, 0) the viewer.
    optics::Vec2<double> image_centre(optics::Cell<double> lens) const {
        if (!moved_) {
            const auto axis = optics::in_display(lattice_, optics::axis_in_array(lattice_, lens));
            return {axis.x * scale, axis.y * scale};
        }
        const Nodal at = nodal(lens);
        const auto front = optics::in_display(lattice_, at.front), rear = optics::in_display(lattice_, at.rear);
        const double slope = 1 / (viewer_ - z_rear - at.up) / at.per_gap;  // 0 of a viewer at infinity
        return {front.x + rear.x * slope, front.y + rear.y * slope};
    }

    /// Returns the centre of a lens's elemental image; of a strip's, the point of its middle line beside the panel point (x, y).
    optics::Vec2<double> image_centre_beside(optics::Cell<double> lens, double x, double y) const {
        const auto centre = image_centre(lens);
        if (!lattice_.strips) return centre;
        const auto along = optics::to_display(lattice_, 0., optics::to_array(lattice_, x - centre.x, y - centre.y).y);
        return {centre.x + along.x, centre.y + along.y};
    }

    /// The position of a panel point in its elemental image: along the array's axes, in widths and heights of the image, 0 at the
    /// centre, -0.5 to 0.5.
    struct ElementalPosition {
        double u, v;
        bool owned;  // false: no lens owns the panel point; its pixel is black
    };
    ElementalPosition place(double x, double y) const {
        const NodalLine l = line(x, y);
        const auto centre = moved_ ? image_centre(l.lens) : optics::Vec2<double>{l.x * scale, l.y * scale};
        const auto off = optics::to_array(lattice_, x - centre.x, y - centre.y);
        return {off.x / (lattice_.pitch[0] * scale), lattice_.strips ? 0 : off.y / (lattice_.pitch[1] * scale), l.owned};
    }

    /// Returns whether a panel point is nearer than `margin` mm to the border of an elemental image.
    bool near_border(double x, double y, double margin) const {
        const ElementalPosition at = place(x, y);
        return !optics::in_cell(lattice_, at.u * lattice_.pitch[0], at.v * lattice_.pitch[1], -margin / scale);
    }

  private:
    /// The nodal points of a lens from the array's centre, in the array's frame, mm; 1/g of that lens; and the height of its rear
    /// nodal point over that of lenses as described.
    struct Nodal {
        optics::Vec2<double> front, rear;
        double per_gap, up;
    };

    /// Returns the lens of that number, or the nearest one if it does not exist.
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

    /// Returns the lens that would own a panel point if no lens were misaligned.
    optics::Cell<double> lens_near(double x, double y) const {
        const auto at =
            optics::to_array(lattice_, x * inverse_scale_ - lattice_.offset[0], y * inverse_scale_ - lattice_.offset[1]);
        return optics::lens_at(lattice_, at.x, at.y);
    }

    /// Returns the lens in whose cell, moved to the centre of its elemental image, a panel point lies; found by a few iterations,
    /// which end when the lens does not change.
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
        // The slope is (F - P)/g; the line passes R, at the height `up`.
        const double mx = (at.front.x - p.x) * at.per_gap + shift.mx, my = (at.front.y - p.y) * at.per_gap + shift.my;
        const auto through =
            optics::in_display(lattice_, optics::Vec2<double>{at.rear.x + shift.x - mx * at.up, at.rear.y + shift.y - my * at.up});
        const auto slope = optics::to_display(lattice_, mx, my);
        return {through.x, through.y, slope.x, slope.y, optics::holds(lattice_, lens), !lit, lens};
    }

    /// Returns the line of a panel point under a strip: it lies in the plane of light of the slope m_x = (x'_c - x'_P)/g through
    /// the strip's rear nodal line, and there goes to the viewers' eyes on the line y = 0, z = D' of the display, or x = 0 where
    /// strips lie flat (geometry/lattice.h). Along the strip its light passes plane plates: m_y = (y'_E - y'_P)/l, with l the
    /// reduced thickness up to the vertex plane and the distance from there to the eye.
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
        const bool flat = line_of_eyes(lattice_) == 1;
        double my = flat ? c / s * mx : -s / c * mx;
        if (!std::isinf(viewer_)) {
            // The eye E: where the plane of light crosses the display's line y = 0 or x = 0; from the array's centre, in the
            // display's frame.
            const double at_eye = centre + mx * (viewer_ - z_rear);
            const auto eye = flat ? optics::to_array(lattice_, -lattice_.offset[0], (at_eye + c * lattice_.offset[0]) / s)
                                  : optics::to_array(lattice_, (at_eye + s * lattice_.offset[1]) / c, -lattice_.offset[1]);
            my = (eye.y - p.y) / (reduced_top_ + viewer_ - top_z_);
        }
        // The line in the plane of H': m_y applies to the reduced thickness below the vertex plane.
        const double rise = p.y + my * (reduced_top_ - top_z_ + z_rear);
        const auto at = optics::in_display(lattice_, optics::Vec2<double>{centre, rise});
        const auto slope = optics::to_display(lattice_, mx, my);
        return {at.x, at.y, slope.x, slope.y, optics::holds(lattice_, lens), !lit, lens};
    }

    // Returns the column or row of the lens at a position from the array's centre; outside the count where there is none.
    // Rounding down without the library's floor is twice as fast.
    double number(double place, int axis) const {
        const double count = lattice_.count[axis], x = place * lattice_.per_pitch[axis] + count / 2;
        const double near = std::min(std::max(x, -1.), count), whole = double(std::int64_t(near));
        return whole > near ? whole - 1 : whole;
    }

    std::shared_ptr<const std::vector<MovedLens>> moved_;  // null if all lenses are alike in the lattice
    Lattice<double> lattice_;
    double viewer_, top_z_, reduced_top_;      // D', the vertex plane's height, and its reduced height, mm
    double inverse_gap_, pixel_, left_, top_;  // 1/g; a; the panel's left and upper border, pixels

  public:
    double z_rear;  // of H', mm from the panel
    double scale;   // e: elemental pitch over lens pitch

  private:
    double inverse_scale_;
};

}  // namespace lfdsim
