// Lines of sight from an eye through points of the screen to the panel, in double precision. Floor 3. docs/measures.md, "Lines of
// sight".
#pragma once
#include "analysis/core/subject.h"
#include "engine/scene/traced_display.h"
#include "geometry/screen.h"
#include "optics/lattice.h"

#include <array>
#include <cstdint>
#include <vector>

namespace lfdsim {

/// Six numbers in [-1, 1] that choose a line of sight: the position in the cell of a lens along x' and y' (0, 1), the diffuser's
/// two angles (2, 3), and the column and the row of the lens (4, 5). Positions in the cells of all lenses together fill the
/// array's rectangle.
using Choice = std::array<double, 6>;

/// Returns `count` evenly spread choices: the first points of a Sobol sequence, digitally shifted by random bits that depend on
/// `set` alone. Sums over different sets are independent of each other.
std::vector<Choice> even_choices(int count, std::uint32_t set = 0);

/// Returns the axis of the lens that a choice gives, in the array's frame, mm; each column and each row is as probable.
optics::Vec2<double> chosen_axis(const Lattice<double>&, const Choice&);

/// The end of a line of sight.
struct Sight {
    bool on_screen = true;        // it aims at a point in front of the panel; if not, it is not followed and does not count
    double light = 0;             // radiance, 1 along a white panel's normal; 0: it is blocked, or ends beside the panel
    bool through = false;         // it gets through the array; if not, the members below have no meaning
    bool by_lens = false;         // it meets a lens on its way; in `clear` and `plate` others pass between the caps
    double x = 0, y = 0;          // end in the panel's plane, mm from its centre, display frame
    Vec3d lens{};                 // where the axis of the cell that it passes meets the vertex plane, mm, display frame
    optics::Cell<double> cell{};  // that cell's column and row
    double cosines = 1;           // with ideal lenses: the cosine to the lens's axis below the lens over that above it
};

/// Returns where a line ends on the panel, pixels to the right of and below its top left corner.
std::array<double, 2> pixel_place(const Panel&, const Sight&);

/// Lines of sight of a display, with its diffuser if it has one. Eyes and points are in the display's frame, mm, if nothing else
/// is stated.
class EyeRays {
  public:
    /// The display must be valid; without a diffuser in it, lines start as light leaves the lenses.
    EyeRays(const Display&, const Geometry&);
    const Lattice<double>& lattice() const { return scene_.lattice; }

    /// Traces a line of sight from an eye in front of the display. The line aims at a point of the array's rectangle in the
    /// vertex plane and is turned where it crosses the diffuser, as camera rays are. For given lens and angles the position in
    /// the cell is shifted cyclically by the displacement that the diffuser gives the line, which changes no mean and spreads
    /// lines evenly where they meet the lens; along strips, where the light is as even as the panel's, it is not shifted. Lines
    /// that aim beside the screen (geometry/screen.h) are not followed.
    Sight look(const Vec3d& eye, const Choice&) const;

    /// Returns the point of the vertex plane that look() aims at.
    Vec3d aim(const Vec3d& eye, const Choice&) const;

    /// Traces the line from an eye through a point, turned at the diffuser by the angles for the numbers a and b in [-1, 1]. It
    /// is followed also beside the screen.
    Sight look_through(const Vec3d& eye, const Vec3d& point, double a, double b) const;

    /// Traces the line that passes `at` in the direction of the unit vector `to`, to.z < 0.
    Sight look_along(const Vec3d& at, const Vec3d& to, double a, double b) const;

    /// Returns the point (x, y) of the vertex plane, given in the array's frame, mm, in the display's frame.
    Vec3d point(double x, double y) const;

    /// Returns the factor, 1, 2, 4 or 8, by which means need more lines of sight since most of them are blocked or beside the
    /// screen: with it at least half as many lines as asked for get through, if 8 suffices.
    int more_for(const Vec3d& eye) const;

  private:
    using Place = optics::Vec2<double>;

    StoredDisplay<double> scene_;
    double vertex_plane_, start_z_;  // z, mm; start_z_: the first plane that a line meets, of the diffuser or of the lenses
    PanelBehind panel_behind_;
    bool stop_first_;            // lines of sight meet the stop before all surfaces
    optics::Cell<double> base_;  // the lens in the middle, to which the tracer's coordinates and lens numbers are relative
};

/// Returns the viewing distance, mm from the panel. Throws InputError if it lies inside the display.
double checked_viewing_distance_mm(const Subject&);

}  // namespace lfdsim
