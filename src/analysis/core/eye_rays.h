// Lines of sight from an eye through points of the screen to the panel, one by one and in double precision. Floor 3.
#pragma once
#include "analysis/core/subject.h"
#include "engine/scene/traced_display.h"
#include "geometry/screen.h"
#include "optics/lattice.h"

#include <array>
#include <cstdint>
#include <vector>

namespace lfdsim {

/// Numbers in [-1, 1] that choose a line of sight: its place in the cell of a lens (0, 1), the diffuser's two angles (2, 3), and
/// which lens (4, 5); of all lenses together they fill the array's rectangle, along its own axes.
using Choice = std::array<double, 6>;

/// `count` choices spread evenly: the first points of a Sobol sequence, digitally shifted by random bits that depend on `set`
/// alone. Errors of sums over different sets are independent.
std::vector<Choice> even_choices(int count, std::uint32_t set = 0);

/// The end of a line of sight.
struct Sight {
    bool on_screen = true;  // it aims at a point in front of the panel; else it is not followed, and does not count
    double light = 0;       // radiance, 1 for a white panel's along its normal; 0: it is blocked, or ends beside the panel
    bool through = false;   // it gets through the array; else the rest is meaningless
    bool by_lens = false;   // it meets a lens on its way; among glass others pass between the caps
    double x = 0, y = 0;    // in the panel's plane, mm from its centre
    Vec3d lens{};           // where the axis of the cell that it came through meets the vertex plane
    bool operator==(const Sight&) const = default;
};

/// The display as eyes see it, or, without its diffuser, as light leaves the lenses.
class EyeRays {
  public:
    /// A valid display.
    EyeRays(const Display&, const Geometry&);
    const Lattice<double>& lattice() const { return scene_.lattice; }

    /// Traces a line of sight from an eye in front of the display. The line aims at a point of the array's rectangle in the
    /// vertex plane and is turned where it crosses the diffuser, as camera rays are. For each choice of lens and angles its place
    /// in the cell is shifted cyclically by as much as the diffuser moves it, which keeps all means and spreads lines evenly
    /// where they meet the lens; but not along strips, where light is as even as the panel's. Lines beside the screen
    /// (geometry/screen.h) are not followed.
    Sight look(const Vec3d& eye, const Choice&) const;

    /// The point of the vertex plane that this line aims at.
    Vec3d aim(const Vec3d& eye, const Choice&) const;

    /// Traces the line from an eye through a point, turned by the diffuser's angles for the numbers a and b.
    Sight look_through(const Vec3d& eye, const Vec3d& point, double a, double b) const;

    /// Traces the line that comes down to `at` along the unit vector `to`.
    Sight look_along(const Vec3d& at, const Vec3d& to, double a, double b) const;

    /// The point (x, y), mm in the array's own axes from its centre, in the vertex plane.
    Vec3d point(double x, double y) const;

    /// The factor by which means need more lines of sight where most of them are blocked or beside the screen: 1, 2, 4 or 8.
    int more_for(const Vec3d& eye) const;

  private:
    using Place = optics::Vec2<double>;

    StoredDisplay<double> scene_;
    double vertex_plane_, start_z_;
    PanelBehind panel_behind_;
    bool stop_first_;            // lines of sight meet the stop before all surfaces
    optics::Cell<double> base_;  // lenses are counted from this one in the middle
};

/// Distance of eyes from the panel. Throws InputError where that lies inside the display.
double checked_viewing_distance_mm(const Subject&);

}  // namespace lfdsim
