#include "interchange/pov/pov_surface.h"

#include "geometry/prescription.h"
#include "interchange/peers/scene_text.h"

#include <algorithm>
#include <cmath>

namespace lfdsim::peers {
namespace {

constexpr double margin_mm = 1e-6;  // by which the clipping shape is larger than the surface

/// Returns z minus the sag, as a formula of x, z and, unless the surface is a cylinder along y, y. Beyond `reach` the sag is
/// constant, so that the bound on the slope holds everywhere.
std::string height_above(const PlacedSurface& s, const PovCell& cell, double reach) {
    const std::string s2 = fmt::format("min({},{})", cell.strips() ? "x*x" : "x*x+y*y", text(reach * reach));
    std::string polynomial;
    for (std::size_t i = s.even_asphere.size(); i-- > 0;)
        polynomial =
            polynomial.empty() ? text(s.even_asphere[i]) : fmt::format("({}+{}*({}))", text(s.even_asphere[i]), s2, polynomial);
    const double c = s.curvature_per_mm, bend = (1 + s.conic) * c * c;
    return fmt::format("z-({})-{}*(({})/(1+sqrt(max(0,1-({})*{})))+{}*({}))", text(s.z_mm), s2, text(c), text(bend), s2, s2,
                       polynomial);
}

/// Returns the largest gradient of height_above(), sqrt(1 + slope^2), from 1024 differences of the sag, with a margin.
double steepest(const PlacedSurface& s, double reach) {
    constexpr int steps = 1024;
    double slope = 0, before = 0;
    for (int i = 1; i <= steps; ++i) {
        const double sag = sag_mm(s, reach * i / steps);
        slope = std::max(slope, std::abs(sag - before) * steps / reach);
        before = sag;
    }
    return 1.05 * std::hypot(1, slope);
}

/// Returns the space above an asphere, or below it, in a box, without the closing brace. POV-Ray's isosurface is where its function
/// is negative or 0.
std::string isosurface(const PlacedSurface& s, const PovCell& cell, bool above, double wide, double low, double high) {
    const double reach = s.semi_aperture_mm + margin_mm, long_half = cell.strips() ? 1.1 * cell.half_length() : wide;
    const std::string height = height_above(s, cell, reach);
    return fmt::format(
        "isosurface {{ function {{ {} }} contained_by {{ box {{ {}, {} }} }} accuracy 1e-7 max_gradient {} all_intersections",
        above ? "-(" + height + ")" : height, vector(-wide, -long_half, low), vector(wide, long_half, high),
        text(steepest(s, reach)));
}

/// Returns a sphere through the vertex, of strips a cylinder along y that is longer than the strip, without the closing brace.
std::string ball(const PlacedSurface& s, const PovCell& cell, bool open) {
    const double radius = 1 / s.curvature_per_mm, z = s.z_mm + radius, y = 1.1 * cell.half_length();
    if (cell.strips())
        return fmt::format("cylinder {{ {}, {}, {}{}", vector(0, -y, z), vector(0, y, z), text(std::abs(radius)),
                           open ? " open" : "");
    return fmt::format("sphere {{ {}, {}", vector(0, 0, z), text(std::abs(radius)));
}

/// Returns the quadric c (x^2 + y^2 + (1 + k) z^2) - 2 z = 0 from the vertex, of a cylinder along y without y^2, without the
/// closing brace.
std::string quadric(const PlacedSurface& s, const PovCell& cell) {
    const double c = s.curvature_per_mm;
    return fmt::format("quadric {{ {}, <0,0,0>, <0,0,-2>, 0 translate {}", vector(c, cell.strips() ? 0 : c, c * (1 + s.conic)),
                       vector(0, 0, s.z_mm));
}

}  // namespace

std::string pov_skin(const PlacedSurface& s, const LensArray& array, const PovCell& cell) {
    const auto [low, high] = sag_range_mm(s);
    const double z0 = s.z_mm + low - margin_mm, z1 = s.z_mm + high + margin_mm, r = s.semi_aperture_mm;
    std::string clip = " clipped_by { " + cell.column(r, z0, z1);
    if (array.aperture == Aperture::cell) clip += " " + cell.prism(z0, z1, 0);
    clip += " }";
    if (is_plane(s))
        return fmt::format("disc {{ {}, z, {}", vector(0, 0, s.z_mm), text(cell.strips() ? std::hypot(r, cell.half_length()) : r)) +
               clip;
    if (has_aspheric_terms(s)) return isosurface(s, cell, false, r + margin_mm, z0, z1) + " open" + clip;
    return (s.conic == 0 ? ball(s, cell, true) : quadric(s, cell)) + clip;
}

bool pov_faces_up(const PlacedSurface& s) {
    return is_plane(s) || has_aspheric_terms(s) || (s.conic == 0 && s.curvature_per_mm < 0);
}

std::string pov_space(const PlacedSurface& s, const PovCell& cell, bool above, double reach, double low, double high) {
    if (is_plane(s))
        return above ? fmt::format("plane {{ -z, {} }}", text(-s.z_mm)) : fmt::format("plane {{ z, {} }}", text(s.z_mm));
    if (has_aspheric_terms(s)) return isosurface(s, cell, above, reach, low, high) + " }";
    if (s.conic != 0) return quadric(s, cell) + (above ? " }" : " inverse }");
    return ball(s, cell, false) + (above == (s.curvature_per_mm > 0) ? " }" : " inverse }");
}

}  // namespace lfdsim::peers
