// Lines of sight through paraxial lenses, one by one: what theory sums where the sums have no closed form. Floor 3.
#pragma once
#include "analysis/core/eye_rays.h"
#include "analysis/spots/aperture_wave.h"

#include <optional>

namespace lfdsim {

/// A line that the diffuser has turned and that comes down to a lens. Places in the array's own axes from its middle, mm.
struct ParaxialLine {
    optics::Vec2<double> axis;   // of the lens; of strips on x' alone
    optics::Vec2<double> at;     // in the plane of H'
    optics::Vec2<double> slope;  // dx/dz and dy/dz as it comes down there
    optics::Vec2<double> seen;   // on the panel
    bool through;                // it meets the clear aperture; else `seen` has no meaning
};

/// The lenses have no thickness: lines bend by q/f in the plane of H', q from the axis (docs/measures.md, "Moire" and "Crosstalk").
/// Strips bend what runs across them; along them there are plane plates, whose thickness counts over its index. Below thin lenses
/// the layers bend lines by Snell's law itself.
class ParaxialLines {
  public:
    /// An eye in front of the display and its diffuser, mm.
    ParaxialLines(const Display&, const Geometry&, const Vec3d& eye);

    /// Follows the line that aims at (x, y), mm in the display's frame, turned by the diffuser's angles for the numbers a and b,
    /// -1 to 1. Nothing: it comes down beside all lenses, or not at all.
    std::optional<ParaxialLine> look(double x, double y, double a, double b) const;

    /// The aim of the line that comes down to the lenses at (x, y), to first order of the diffuser's shift.
    std::optional<optics::Vec2<double>> aim_at(double x, double y, double a, double b) const;

    /// Whether the panel reaches there; a place as `seen`.
    bool on_panel(const optics::Vec2<double>&) const;

  private:
    struct LineSlopes {
        std::array<double, 2> before, turned;  // by the diffuser: dx/dz, dy/dz
    };
    std::optional<LineSlopes> slopes(double x, double y, double a, double b) const;
    double angle(double number, std::size_t axis) const;  // of the diffuser, radians
    /// The lateral displacement of lines below the lenses per slope, along the array's x and y.
    optics::Vec2<double> reach_mm(double slope_squared) const;

    const Display& display_;
    const Geometry& geometry_;
    Vec3d eye_;
    ApertureShape aperture_;
    double above_ = 0, power_per_mm_ = 0;  // the diffuser's height above H'; 1/f
};

}  // namespace lfdsim
