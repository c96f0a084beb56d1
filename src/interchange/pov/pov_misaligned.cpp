#include "interchange/pov/pov_misaligned.h"

#include "interchange/peers/cell.h"
#include "interchange/pov/pov_lenses.h"
#include "interchange/pov/pov_limits.h"
#include "interchange/pov/pov_matter.h"
#include "interchange/pov/pov_surface.h"

#include <algorithm>
#include <array>
#include <cmath>

// In lfdsim a ray that has entered a lens meets that lens alone, and one that has left it meets no lens any more; but what
// POV-Ray's shapes do cannot depend on where a ray has been. So they do what is right for every ray that can reach them:
// - a lens's faces refract from above and are black from below, where only totally reflected light comes. The medium behind each is
//   that of the perfect lens: for light that is in that medium already a neighbour's face does nothing;
// - its wall is black from inside and not there from outside, where other lenses' light passes it;
// - what no lens covers is a black sheet at a height at which all lenses have walls, so that light that enters any lens is above it
//   and light that leaves any is below it. It follows the bow in steps;
// - a black sleeve on the outside of a wall reaches from the sheet to the lens's rim, where a lens protrudes from its neighbours.
// What they do is wrong only where lenses overlap, for light that enters one of them within the other's walls.
namespace lfdsim::peers {
namespace {

/// Writes the lenses. `Column` k is the space over lens k's aperture, `Body` k the part of it between its faces.
class Placed {
  public:
    Placed(const Display& d, const Geometry& g)
        : d_(d), g_(g), lenses_(d, g), walls_(*lenses_.walls()), gap_mm_(pov_gap_pitches * d.array.pitch_mm.least()) {}

    std::string all() const {
        std::string text = "#declare Through = texture { pigment { rgbt 1 } finish { ambient 0 diffuse 0 } }\n";
        if (!d_.lens.is_thin()) text += "#declare Lens = " + faces(g_.surfaces) + " }\n";
        for (std::size_t k = 0; k < lenses_.count(); ++k) {
            text += fmt::format("#declare Column{} = {}\n", k, lenses_.placed(k, lenses_.column(radius(), 0)));
            if (!d_.lens.is_thin()) text += fmt::format("#declare Body{} = {}\n", k, body(k));
        }
        for (std::size_t k = 0; k < lenses_.count(); ++k) {
            if (!d_.lens.is_thin()) {
                add(text, lens(k));
                add(text, wall(k));
                add(text, sleeve(k));
            }
            add(text, sheet(k));
        }
        return text + lenses_.stops();
    }

  private:
    /// Appends an object of the array's frame, given without its closing brace.
    static void add(std::string& text, const std::string& object) {
        if (!object.empty()) text += object + " transform { Place } no_reflection }\n";
    }

    /// Returns lens k's faces, without the closing brace. Lenses that differ in place and tilt alone are copies of one.
    std::string lens(std::size_t k) const {
        const std::string shape = lenses_.error(k).curvature == 0 ? "object { Lens" : faces(lenses_.surfaces(k));
        return shape + " " + lenses_.frame(k);
    }

    /// Returns the faces of a lens, without the closing brace.
    std::string faces(const std::vector<PlacedSurface>& surfaces) const {
        std::string parts;
        for (const PlacedSurface& s : surfaces) {
            if (g_.glued && g_.layers.empty() && s.z_mm == g_.surfaces.front().z_mm) continue;  // the panel itself lies there
            parts += fmt::format("  {} texture {{ {} }} interior_texture {{ {} }} interior {{ ior {} }} }}\n",
                                 pov_skin(s, d_.array, lenses_.cell()), pov_faces_up(s) ? "Clear" : "Black",
                                 pov_faces_up(s) ? "Black" : "Clear", text(s.index_below));
        }
        return "union {\n" + parts + " ";
    }

    bool filled() const { return d_.array.aperture == Aperture::cell; }
    double reach() const { return lenses_.cell().widest_half() + 2 * gap_mm_; }

    /// Returns the space below the lens's highest rim or, where cells are filled, below its glass, too; above_bottom() that above.
    std::string below_top(const std::vector<PlacedSurface>& surfaces) const {
        const std::string rim = fmt::format("plane {{ z, {} }}", text(rims(surfaces).high));
        if (!filled()) return rim;
        return "union { " + rim + " " + pov_space(surfaces.back(), lenses_.cell(), false, reach(), lenses_.low(), lenses_.high()) +
               " }";
    }
    std::string above_bottom(const std::vector<PlacedSurface>& surfaces) const {
        const std::string rim = fmt::format("plane {{ -z, {} }}", text(-rims(surfaces).low));
        if (!filled()) return rim;
        return "union { " + rim + " " + pov_space(surfaces.front(), lenses_.cell(), true, reach(), lenses_.low(), lenses_.high()) +
               " }";
    }

    /// Returns the space within a lens's walls, in the array's frame.
    std::string body(std::size_t k) const {
        const std::vector<PlacedSurface> surfaces = lenses_.surfaces(k);
        return lenses_.placed(k, fmt::format("intersection {{ {} {} {} }}", lenses_.column(rims(surfaces).radius, 0),
                                             below_top(surfaces), above_bottom(surfaces)));
    }

    double radius() const { return d_.lens.is_thin() ? g_.surfaces.front().semi_aperture_mm : rims(g_.surfaces).radius; }

    /// Returns lens k's wall. Of lenses that fill their cells it is a little inside the cell, as walls would lie in each other's
    /// planes.
    std::string wall(std::size_t k) const {
        const std::vector<PlacedSurface> surfaces = lenses_.surfaces(k);
        const std::string sides =
            fmt::format("object {{ object {{ {} clipped_by {{ {} {} }} }} {}", lenses_.column(radius(), filled() ? -gap_mm_ : 0),
                        below_top(surfaces), above_bottom(surfaces), lenses_.frame(k));
        const std::string seen = "texture { Through } interior_texture { Black }";
        std::string others, beside;
        for (const std::size_t m : lenses_.near(k)) {
            others += fmt::format(" object {{ Body{} }}", m);
            beside += fmt::format(" object {{ Body{} inverse }}", m);
        }
        if (others.empty()) return sides + " " + seen;
        // Within a neighbour it is met in glass.
        return fmt::format("union {{ {} clipped_by {{{} }} {} }}\n  {} clipped_by {{ union {{{} }} }} {} interior {{ ior {} }} }}",
                           sides, beside, seen, sides, others, seen, text(g_.surfaces.back().index_below));
    }

    /// Returns the sleeve on the outside of lens k's wall, without the closing brace.
    std::string sleeve(std::size_t k) const {
        const std::vector<PlacedSurface> surfaces = lenses_.surfaces(k);
        const std::string outer =
            lenses_.placed(k, fmt::format("intersection {{ {} {} }}", lenses_.column(radius(), gap_mm_), below_top(surfaces)));
        std::string others;
        for (const std::size_t m : lenses_.near(k)) others += fmt::format(" object {{ Body{} }}", m);
        return fmt::format("difference {{ intersection {{ {} plane {{ -z, {} }} }} object {{ Column{} }}{} {}", outer,
                           text(-middle(k)), k, others, black());
    }

    /// Returns the middle of the heights that all walls share, at lens k.
    double middle(std::size_t k) const { return (walls_[0] + walls_[1]) / 2 + lenses_.raised(k); }

    /// Returns the black sheet over lens k's tile: as thick as half of the walls' common height, about its middle, to overlap with
    /// that of neighbours where a bow makes steps; flat if there is almost no common height.
    std::string sheet(std::size_t k) const {
        std::vector<std::string> columns{fmt::format("Column{}", k)};
        for (const std::size_t m : lenses_.near(k)) columns.push_back(fmt::format("Column{}", m));
        const double quarter = (walls_[1] - walls_[0]) / 4;
        if (quarter < gap_mm_) return lenses_.flat(k, std::max(middle(k), gap_mm_), columns) + black();
        std::string holes;
        for (const std::string& column : columns) holes += " object { " + column + " }";
        return fmt::format("difference {{ {}{} {}", lenses_.tile_box(k, middle(k) - quarter, middle(k) + quarter), holes, black());
    }

    const Display& d_;
    const Geometry& g_;
    const PovLenses lenses_;
    const std::array<double, 2> walls_;
    const double gap_mm_;
};

}  // namespace

std::string pov_placed(const Display& display, const Geometry& geometry) { return Placed(display, geometry).all(); }

}  // namespace lfdsim::peers
