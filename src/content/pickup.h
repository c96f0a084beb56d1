// The nodal pick-up: which lens owns a panel pixel, and along which line that lens shows it. docs/model.md, "Elemental images".
#pragma once
#include "model/display.h"
#include "model/geometry.h"
#include "model/numbers.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace lfdsim {

/// The line { (x, y) + (z - z_rear) (mx, my) } on the viewer's side of the lens: from panel point P through the front nodal point,
/// then parallel to itself from the rear one. (x, y) is the lens's axis.
struct NodalLine {
    double x, y, mx, my;
    bool owned;  // false: the nearest elemental image belongs to no lens, the pixel stays black
};

class Pickup {
  public:
    Pickup(const Display& d, const Geometry& g)
        : nx_(double(d.array.count[0])),
          ny_(double(d.array.count[1])),
          pitch_(d.array.pitch_mm),
          cos_(std::cos(d.array.rotation_deg * degree)),
          sin_(std::sin(d.array.rotation_deg * degree)),
          offset_x_(d.array.offset_mm[0]),
          offset_y_(d.array.offset_mm[1]),
          inverse_gap_(1 / g.gap_mm),
          inverse_pitch_(1 / pitch_),
          pixel_(d.panel.pixel_pitch_mm),
          left_(-0.5 * double(d.panel.pixels[0])),
          top_(0.5 * double(d.panel.pixels[1])),
          z_rear(g.rear_principal_mm),
          scale(std::isinf(d.content.viewing_distance_mm) ? 1 : 1 + g.gap_mm / (d.content.viewing_distance_mm - z_rear)),
          inverse_scale_(1 / scale) {}

    /// Centre of panel pixel (column, row), mm.
    double x_mm(double column) const { return (left_ + column + 0.5) * pixel_; }
    double y_mm(double row) const { return (top_ - row - 0.5) * pixel_; }

    /// The line of the panel point (x, y). The line from the viewer at (0, 0, D) through the nodal points of the lens at C meets
    /// the panel at C scale, scale = 1 + g / (D - z_rear): the centre of its elemental image. The nearest centre is found in the
    /// array's own axes, where lens (i, j) covers the unit square from (i, j).
    NodalLine line(double x, double y) const {
        const double ax = x * inverse_scale_ - offset_x_, ay = y * inverse_scale_ - offset_y_;
        const double i = cell((cos_ * ax + sin_ * ay) * inverse_pitch_ + nx_ / 2, nx_),
                     j = cell((cos_ * ay - sin_ * ax) * inverse_pitch_ + ny_ / 2, ny_);
        const double u = (i + 0.5 - nx_ / 2) * pitch_, v = (j + 0.5 - ny_ / 2) * pitch_;
        const double cx = cos_ * u - sin_ * v + offset_x_, cy = sin_ * u + cos_ * v + offset_y_;
        return {cx, cy, (cx - x) * inverse_gap_, (cy - y) * inverse_gap_, i >= 0 && i < nx_ && j >= 0 && j < ny_};
    }

    /// Where the panel point (x, y) lies in its elemental image: in the array's axes, units of the elemental pitch, 0 at the
    /// centre, -0.5 .. 0.5.
    struct Place {
        double u, v;
        bool owned;
    };
    Place place(double x, double y) const {
        const NodalLine l = line(x, y);
        const double dx = x - l.x * scale, dy = y - l.y * scale, unit = pitch_ * scale;
        return {(cos_ * dx + sin_ * dy) / unit, (cos_ * dy - sin_ * dx) / unit, l.owned};
    }

  private:
    // floor(x) where 0 <= x < count, else something outside: without a call to the library's floor, twice as fast.
    static double cell(double x, double count) {
        const double near = std::min(std::max(x, -1.), count), whole = double(std::int64_t(near));
        return whole > near ? whole - 1 : whole;
    }

    double nx_, ny_, pitch_, cos_, sin_, offset_x_, offset_y_, inverse_gap_, inverse_pitch_, pixel_, left_, top_;

  public:
    double z_rear;
    double scale;  // elemental pitch / lens pitch

  private:
    double inverse_scale_;
};

}  // namespace lfdsim
