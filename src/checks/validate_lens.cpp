// Checks of the lens: it can be made, and it fits its cell. docs/model.md, "Lenses" and "Apertures and stops".

#include <cmath>

#include "checks/findings.h"
#include "display/colour.h"
#include "display/keys.h"
#include "geometry/lattice.h"
#include "geometry/prescription.h"

namespace lfdsim {
namespace {

// The checks of each kind of lens.
class LensCheck {
  public:
    LensCheck(const Display& d, Findings& f) : display(d), lens(d.lens), array(d.array), findings(f) {}

    void check() {
        std::visit([&](const auto& kind) { check(kind); }, lens.kind);
    }

  private:
    void check(const PlanoConvex& ball) {
        if (!check_radius(ball.aperture_radius_mm)) return;
        if (findings.sound("lens.sphere_radius_mm")) check_ball(ball);
        check_stop();
    }
    void check(const IdealLens& ideal) {
        if (check_radius(ideal.aperture_radius_mm)) check_stop();
    }
    void check(const Pinhole& hole) {
        if (array.aperture == Aperture::cell)
            findings.add("array.aperture", "is \"cell\", but a pinhole is a hole in a black sheet; take \"circle\"");
        if (lens.stop_radius_mm)
            findings.add("lens.stop_radius_mm", "has no meaning for a lens of type \"pinhole\", which is a stop; leave it out");
        if (findings.sound("lens.aperture_radius_mm") && findings.sound("array.aperture"))
            check_width("lens.aperture_radius_mm", hole.aperture_radius_mm);
    }
    // Widths and sags one by one, then each pair of neighbours: the medium between them must have a thickness everywhere.
    void check(const SurfaceLens& given) {
        const std::vector<PlacedSurface> surfaces = prescription(lens, array, display.panel.wavelengths_nm[green_channel]);
        for (std::size_t i = 0; i < surfaces.size(); ++i) {
            if (!findings.sound(fmt::format("lens.surface.{}.", i))) continue;
            check_width(fmt::format("lens.surface.{}.semi_aperture_mm", i), surfaces[i].semi_aperture_mm);
            check_sag(i, surfaces[i]);
        }
        check_stop();
        if (!findings.sound("lens.")) return;
        for (std::size_t i = 0; i + 1 < surfaces.size(); ++i)
            if (const double clear = clearance_mm(surfaces[i], surfaces[i + 1]); !(clear >= -rounding_mm))
                findings.add(fmt::format("lens.surface.{}.distance_mm", i),
                             "{} mm makes this surface and the next one cross within the aperture; give at least {:.6g} mm",
                             given.surfaces[i].distance_mm, given.surfaces[i].distance_mm - clear);
    }

    // Checks the width of a lens that may do without a radius. Returns whether there is a radius, or none is needed.
    bool check_radius(const std::optional<double>& radius) {
        if (!findings.sound("lens.aperture_radius_mm")) return false;
        if (array.aperture == Aperture::cell) return true;
        if (radius)
            check_width("lens.aperture_radius_mm", *radius);
        else
            findings.add("lens.aperture_radius_mm", "is missing; only lenses of array.aperture = \"cell\" do not need it");
        return radius.has_value();
    }

    // Round lenses must not overlap; lenses that fill their cells are cut by the borders.
    void check_width(const std::string& where, double radius) {
        if (array.aperture == Aperture::circle && radius > inner_radius_mm(array))
            findings.add(where, "{} mm makes the lens wider than array.pitch_mm = {} mm; give at most {} mm, or a larger pitch",
                         radius, array.pitch_mm.least(), inner_radius_mm(array));
    }

    // The stops of neighbours are holes in one sheet; they must not overlap.
    void check_stop() {
        if (lens.stop_radius_mm && findings.sound("lens.stop_radius_mm") && *lens.stop_radius_mm > inner_radius_mm(array))
            findings.add("lens.stop_radius_mm",
                         "{} mm makes the holes of neighbours overlap at array.pitch_mm = {} mm; give at most {} mm, or none",
                         *lens.stop_radius_mm, array.pitch_mm.least(), inner_radius_mm(array));
    }

    // Checks a plano-convex lens: its cap is a part of a sphere that must cover the aperture, R >= r, and not reach the flat
    // face, h <= 2 sqrt(R^2 - r^2).
    void check_ball(const PlanoConvex& ball) {
        const double R = ball.sphere_radius_mm, r = glass_radius_mm(ball.aperture_radius_mm, array), h = ball.cylinder_height_mm;
        const bool corner = r > ball.aperture_radius_mm.value_or(0);
        const double highest = 2 * std::sqrt((R - r) * (R + r));
        if (R < r)
            findings.add("lens.sphere_radius_mm",
                         "R = {} mm is smaller than {} = {} mm, so the sphere does not cover the aperture; give at least that", R,
                         corner ? "the cell's circumradius" : "the aperture radius r", r);
        else if (findings.sound("lens.cylinder_height_mm") && h > highest)
            findings.add("lens.cylinder_height_mm",
                         "h = {} mm, but the sphere of R = {} mm would cut the flat face; give at most 2 sqrt(R^2 - r^2) = {} mm, "
                         "and the rest as a [[panel.layer]] under it",
                         h, R, highest);
    }

    // Checks that a surface is defined over its whole semi-aperture, and stays within bounds.
    void check_sag(std::size_t i, const PlacedSurface& s) {
        const std::string where = fmt::format("lens.surface.{}.semi_aperture_mm", i);
        // A conic ends where 1 - (1 + k) c^2 s^2 = 0.
        const double edge = std::sqrt(1 / std::max((1 + s.conic) * s.curvature_per_mm * s.curvature_per_mm, 0.0));
        const auto [low, high] = sag_range_mm(s);
        if (s.semi_aperture_mm > edge)
            findings.add(where,
                         "{} mm, but the surface of curvature {} per mm and conic {} ends {} mm from the axis; give at most that",
                         s.semi_aperture_mm, s.curvature_per_mm, s.conic, edge);
        else if (!(low >= -longest_mm && high <= longest_mm))
            findings.add(where, "{} mm, within which the sag reaches {:.6g} mm; allowed is {}", s.semi_aperture_mm,
                         high > -low ? high : low, any_length.text());
    }

    const Display& display;
    const Lens& lens;
    const LensArray& array;
    Findings& findings;
};

}  // namespace

void validate_lens(const Display& d, Findings& findings) {
    if (findings.sound("lens.type") && findings.sound("array.pitch_mm") && findings.sound("array.aperture"))
        LensCheck(d, findings).check();
}

}  // namespace lfdsim
