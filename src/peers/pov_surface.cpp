#include "peers/pov_surface.h"

#include "model/prescription.h"
#include "peers/cell.h"
#include "peers/text.h"

#include <algorithm>
#include <cmath>

namespace lfdsim::peers {
namespace {

constexpr double margin_mm = 1e-6;  // by which the clipping shape is larger than the surface

bool is_conic(const PlacedSurface& s) {
    return std::all_of(s.even_asphere.begin(), s.even_asphere.end(), [](double a) { return a == 0; });
}

// z minus the sag, as a formula of x, y, z. Beyond `reach` the sag is constant, so that the bound on the slope holds everywhere.
std::string height_above(const PlacedSurface& s, double reach) {
    const std::string s2 = fmt::format("min(x*x+y*y,{})", text(reach * reach));
    std::string polynomial;
    for (std::size_t i = s.even_asphere.size(); i-- > 0;)
        polynomial =
            polynomial.empty() ? text(s.even_asphere[i]) : fmt::format("({}+{}*({}))", text(s.even_asphere[i]), s2, polynomial);
    const double c = s.curvature_per_mm, bend = (1 + s.conic) * c * c;
    return fmt::format("z-({})-{}*(({})/(1+sqrt(max(0,1-({})*{})))+{}*({}))", text(s.z_mm), s2, text(c), text(bend), s2, s2,
                       polynomial);
}

// The largest gradient of height_above(): from differences of the sag between 1024 points, with a margin.
double steepest(const PlacedSurface& s, double reach) {
    constexpr int steps = 1024;
    double slope = 0, before = 0;
    for (int i = 1; i <= steps; ++i) {
        const double sag = sag_mm(s.curvature_per_mm, s.conic, s.even_asphere, reach * i / steps);
        slope = std::max(slope, std::abs(sag - before) * steps / reach);
        before = sag;
    }
    return 1.05 * std::hypot(1, slope);
}

std::string isosurface(const PlacedSurface& s, bool above, double wide, double low, double high) {
    const double reach = s.semi_aperture_mm + margin_mm;
    const std::string height = height_above(s, reach);
    return fmt::format(
        "isosurface {{ function {{ {} }} contained_by {{ box {{ {}, {} }} }} accuracy 1e-7 max_gradient {} all_intersections",
        above ? "-(" + height + ")" : height, vector(-wide, -wide, low), vector(wide, wide, high), text(steepest(s, reach)));
}

std::string sphere(const PlacedSurface& s) {
    const double radius = 1 / s.curvature_per_mm;
    return fmt::format("sphere {{ {}, {}", vector(0, 0, s.z_mm + radius), text(std::abs(radius)));
}

// c (x^2 + y^2 + (1 + k) z^2) - 2 z = 0 from the vertex
std::string quadric(const PlacedSurface& s) {
    const double c = s.curvature_per_mm;
    return fmt::format("quadric {{ {}, <0,0,0>, <0,0,-2>, 0 translate {}", vector(c, c, c * (1 + s.conic)), vector(0, 0, s.z_mm));
}

}  // namespace

std::string pov_skin(const PlacedSurface& s, const LensArray& array) {
    const auto [low, high] = sag_range_mm(s);
    const double half_x = array.pitch_mm[0] / 2, half_y = array.pitch_mm[1] / 2, z0 = s.z_mm + low - margin_mm,
                 z1 = s.z_mm + high + margin_mm;
    std::string clip =
        fmt::format(" clipped_by {{ cylinder {{ {}, {}, {} }} }}", vector(0, 0, z0), vector(0, 0, z1), text(s.semi_aperture_mm));
    if (array.aperture == Aperture::cell)
        clip = fmt::format(" clipped_by {{ cylinder {{ {}, {}, {} }} box {{ {}, {} }} }}", vector(0, 0, z0), vector(0, 0, z1),
                           text(s.semi_aperture_mm), vector(-half_x, -half_y, z0), vector(half_x, half_y, z1));
    if (is_plane(s)) return fmt::format("disc {{ {}, z, {}", vector(0, 0, s.z_mm), text(s.semi_aperture_mm)) + clip;
    if (!is_conic(s)) return isosurface(s, false, s.semi_aperture_mm + margin_mm, z0, z1) + " open" + clip;
    return (s.conic == 0 ? sphere(s) : quadric(s)) + clip;
}

std::string pov_space(const PlacedSurface& s, bool above, double reach, double low, double high) {
    if (is_plane(s))
        return above ? fmt::format("plane {{ -z, {} }}", text(-s.z_mm)) : fmt::format("plane {{ z, {} }}", text(s.z_mm));
    if (!is_conic(s)) return isosurface(s, above, reach, low, high) + " }";
    if (s.conic != 0) return quadric(s) + (above ? " }" : " inverse }");
    return sphere(s) + (above == (s.curvature_per_mm > 0) ? " }" : " inverse }");
}

}  // namespace lfdsim::peers
