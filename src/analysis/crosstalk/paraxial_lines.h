// Lines of sight through paraxial lenses, one by one: what theory sums where the sums have no closed form. Floor 3.
#pragma once
#include "analysis/core/eye_rays.h"
#include "analysis/spots/aperture_wave.h"

#include <optional>

namespace lfdsim {

/// A line that has passed the diffuser and comes down to a lens. Positions are in the array's frame from its centre, mm.
struct ParaxialLine {
    optics::Vec2<double> axis;   // of the lens; of strips its x' only
    optics::Vec2<double> at;     // in the plane of H'
    optics::Vec2<double> slope;  // dx'/dz and dy'/dz above the lens
    optics::Vec2<double> seen;   // on the panel
    bool through;                // it meets the clear aperture; if not, `seen` has no meaning
};

/// Lines of sight through lenses without thickness: a line's slope changes by q/f in the plane of H', q from the lens's axis, and
/// it ends g further down (docs/measures.md, "Moire" and "Crosstalk"). Strips do so across themselves; along them they are plane
/// plates, which count with thickness over index. Below thin lenses the layers refract lines by Snell's law.
class ParaxialLines {
  public:
    /// `eye`: in front of the display and its diffuser, mm, display frame.
    ParaxialLines(const Display&, const Geometry&, const Vec3d& eye);

    /// Follows the line that aims at (x, y), mm in the display's frame, turned at the diffuser by the angles for the numbers a
    /// and b in [-1, 1]. Nothing if it meets the plane of H' beside all lenses, or is turned away from the panel.
    std::optional<ParaxialLine> look(double x, double y, double a, double b) const;

    /// Returns the point to aim at so that the line comes down to the lenses at (x, y), to first order of the diffuser's
    /// displacement.
    std::optional<optics::Vec2<double>> aim_at(double x, double y, double a, double b) const;

    /// Returns whether a point, given as ParaxialLine::seen, lies on the panel.
    bool on_panel(const optics::Vec2<double>&) const;

  private:
    struct LineSlopes {
        std::array<double, 2> before, turned;  // by the diffuser: dx/dz, dy/dz
    };
    std::optional<LineSlopes> slopes(double x, double y, double a, double b) const;
    double angle(double number, std::size_t axis) const;  // of the diffuser, radians
    /// Returns the lateral displacement, mm, per unit of slope of lines between the lenses and the panel, along x' and y': g, and
    /// more for steep lines in layers.
    optics::Vec2<double> reach_mm(double slope_squared) const;

    const Display& display_;
    const Geometry& geometry_;
    Vec3d eye_;
    ApertureShape aperture_;
    double above_ = 0, power_per_mm_ = 0;  // the diffuser's height above H'; 1/f
};

}  // namespace lfdsim
