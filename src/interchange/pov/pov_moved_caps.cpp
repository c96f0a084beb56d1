#include "interchange/pov/pov_moved_caps.h"

#include "geometry/prescription.h"
#include "interchange/meshed/cell_sides.h"
#include "interchange/pov/pov_lenses.h"
#include "interchange/pov/pov_matter.h"
#include "interchange/pov/pov_surface.h"

// The sheet's glass is the slab between the perfect lenses' rims and the bodies under the caps together. Of each body the scene has
// what protrudes from the slab and from its neighbours, of the slab's faces what no body covers: one shape, whose parts share their
// medium, so that light enters and leaves it in turn.
namespace lfdsim::peers {
namespace {

/// Writes the sheet. `Upper` k and `Lower` k are the bodies under lens k's caps.
class PovMovedCaps {
  public:
    PovMovedCaps(const Display& d, const Geometry& g) : d_(d), g_(g), lenses_(d, g) {}

    std::string all() const {
        const PlacedSurface &lower = g_.surfaces.front(), &upper = g_.surfaces.back();
        const auto columns = std::size_t(lenses_.cell().last(0) + 1);
        std::string parts, beside;  // rows in boxes, so that a ray is tested against few; and what goes on without end
        std::string declared;
        for (std::size_t first = 0; first < lenses_.count(); first += columns) {
            std::string row;
            for (std::size_t k = first; k < first + columns; ++k)
                for (const bool top : {false, true}) {
                    if (is_plane(top ? upper : lower)) continue;
                    declared += fmt::format("#declare {} = {} }}\n", name(k, top), glass(k, top));
                    row += cap(k, top);
                    (lenses_.at_border(k) ? beside : row) += "  " + flat(k, top) + (lenses_.at_border(k) ? "" : bounds(k)) + "}\n";
                }
            parts += fmt::format("union {{\n{}  bounded_by {{ {} }} }}\n", row, lenses_.row_box(first));
        }
        if (is_plane(lower) && !g_.glued) beside += face(lower.z_mm);
        if (is_plane(upper)) beside += face(upper.z_mm);
        return declared + fmt::format("union {{\n{}{}  {} transform {{ Place }}\n}}\n", parts, beside, medium(lower.index_above)) +
               lenses_.stops();
    }

  private:
    std::string face(double z) const { return fmt::format("disc {{ {}, z, {} }}\n", vector(0, 0, z), text(100 * sheet_half(g_))); }

    /// Returns the height at which the slab ends, that of the perfect rim.
    double slab_z(bool top) const { return rim_z_mm(top ? g_.surfaces.back() : g_.surfaces.front()); }

    /// Returns the body under a cap, as far into the slab and beyond as the column goes, without the closing brace.
    std::string glass(std::size_t k, bool top) const {
        const PlacedSurface own = top ? lenses_.surfaces(k).back() : lenses_.surfaces(k).front();
        const double reach = (d_.array.aperture == Aperture::cell ? lenses_.cell().widest_half() : own.semi_aperture_mm) + 0.01;
        const std::string rim =
            top ? fmt::format("plane {{ z, {} }}", text(rim_z_mm(own))) : fmt::format("plane {{ -z, {} }}", text(-rim_z_mm(own)));
        return fmt::format("intersection {{ {} merge {{ {} {} }} {}", lenses_.column(own.semi_aperture_mm, 0), rim,
                           pov_space(own, lenses_.cell(), !top, reach, lenses_.low(), lenses_.high()), lenses_.frame(k));
    }

    static std::string name(std::size_t k, bool top) { return fmt::format("{}{}", top ? "Upper" : "Lower", k); }

    /// Returns the faces of a body outside the slab and outside the bodies of near lenses.
    std::string cap(std::size_t k, bool top) const {
        std::string outside =
            top ? fmt::format("plane {{ -z, {} }}", text(-slab_z(top))) : fmt::format("plane {{ z, {} }}", text(slab_z(top)));
        for (const std::size_t m : lenses_.near(k)) outside += fmt::format(" object {{ {} inverse }}", name(m, top));
        return fmt::format("  {} clipped_by {{ {} }} {}}}\n", "object { " + name(k, top), outside, bounds(k));
    }

    std::string bounds(std::size_t k) const { return "bounded_by { " + lenses_.box(k) + " } "; }

    /// Returns the slab's face over lens k's tile, where no body covers it, without the closing brace.
    std::string flat(std::size_t k, bool top) const {
        std::vector<std::string> covered{name(k, top)};
        for (const std::size_t m : lenses_.near(k)) covered.push_back(name(m, top));
        return lenses_.flat(k, slab_z(top), covered);
    }

    const Display& d_;
    const Geometry& g_;
    const PovLenses lenses_;
};

}  // namespace

std::string pov_moved_caps(const Display& display, const Geometry& geometry) { return PovMovedCaps(display, geometry).all(); }

}  // namespace lfdsim::peers
