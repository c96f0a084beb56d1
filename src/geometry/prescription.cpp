#include "geometry/prescription.h"

#include "display/colour.h"
#include "geometry/lattice.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lfdsim {
namespace {

/// Returns the least value of f over [0, end]: a scan finds the valley, golden section its floor. An asphere of 8 terms has at most
/// 9 valleys, far wider than a step unless its coefficients cancel one another beyond any real lens. NaN anywhere gives NaN.
template <class Function>
double lowest(Function f, double end) {
    constexpr int steps = 256;
    int best = 0;
    double least = f(0.0);
    for (int i = 1; i <= steps; ++i) {
        const double value = f(end * i / steps);
        if (std::isnan(value)) return value;
        if (value < least) least = value, best = i;
    }
    double low = end * std::max(best - 1, 0) / steps, high = end * std::min(best + 1, steps) / steps;
    constexpr double golden = 0.6180339887498949;
    for (int i = 0; i < 60; ++i) {
        const double a = high - golden * (high - low), b = low + golden * (high - low);
        const double fa = f(a), fb = f(b);
        least = std::min({least, fa, fb});
        (fa < fb ? high : low) = fa < fb ? b : a;
    }
    return least;
}

}  // namespace

double sag_mm(double curvature, double conic, const std::vector<double>& even_asphere, double s) {
    // This form of the conic holds for c = 0, a plane. The polynomial by Horner's rule in s^2.
    const double s2 = s * s;
    double polynomial = 0;
    for (std::size_t i = even_asphere.size(); i-- > 0;) polynomial = polynomial * s2 + even_asphere[i];
    double root2 = 1 - (1 + conic) * curvature * curvature * s2;
    if (root2 < 0 && root2 > -1e-12) root2 = 0;  // rounding at the rim of a half ball
    return curvature * s2 / (1 + std::sqrt(root2)) + polynomial * s2 * s2;
}

bool has_aspheric_terms(const PlacedSurface& s) {
    return std::any_of(s.even_asphere.begin(), s.even_asphere.end(), [](double a) { return a != 0; });
}

bool is_plane(const PlacedSurface& s) { return s.curvature_per_mm == 0 && !has_aspheric_terms(s); }

double sag_mm(const PlacedSurface& s, double distance_mm) {
    return sag_mm(s.curvature_per_mm, s.conic, s.even_asphere, distance_mm);
}

double rim_z_mm(const PlacedSurface& s) { return s.z_mm + sag_mm(s, s.semi_aperture_mm); }

std::array<double, 2> sag_range_mm(const PlacedSurface& s) {
    return {lowest([&](double x) { return sag_mm(s, x); }, s.semi_aperture_mm),
            -lowest([&](double x) { return -sag_mm(s, x); }, s.semi_aperture_mm)};
}

double clearance_mm(const PlacedSurface& lower, const PlacedSurface& upper) {
    const auto distance = [&](double x) { return upper.z_mm + sag_mm(upper, x) - lower.z_mm - sag_mm(lower, x); };
    return lowest(distance, std::min(lower.semi_aperture_mm, upper.semi_aperture_mm));
}

Cardinal cardinal_points(const std::vector<PlacedSurface>& surfaces) {
    if (surfaces.front().form == SurfaceForm::thin)
        return {surfaces.front().focal_length_mm, surfaces.front().z_mm, surfaces.front().z_mm};
    // The system matrix of (height y, optical slope n u): a surface subtracts c (n' - n) y from n u, a medium adds d/n (n u) to y.
    double a = 1, b = 0, c = 0, d = 1;
    double z = surfaces.front().z_mm;
    for (const PlacedSurface& s : surfaces) {
        const double reduced = (s.z_mm - z) / s.index_below, power = s.curvature_per_mm * (s.index_above - s.index_below);
        a += reduced * c, b += reduced * d;
        c -= power * a, d -= power * b;
        z = s.z_mm;
    }
    // With (y', n u') = (a, b; c, d) (y, n u) and air on both sides: f = -1/c, H is (d - 1)/c from the first vertex and H' is
    // (1 - a)/c from the last one. An afocal lens shifts a parallel pencil: a ray to z leaves as if from z + (length - b), b the
    // reduced thickness.
    const double front = surfaces.front().z_mm;
    if (c == 0) return {std::numeric_limits<double>::infinity(), front, z - b};
    return {-1 / c, front + (d - 1) / c, z + (1 - a) / c};
}

double glass_radius_mm(const std::optional<double>& aperture_radius_mm, const LensArray& array) {
    const double given = aperture_radius_mm.value_or(0);
    return array.aperture == Aperture::cell ? std::max(given, outer_radius_mm(array)) : given;
}

namespace {

std::vector<PlacedSurface> placed(const PlanoConvex& lens, const LensArray& array, double wavelength_nm) {
    const double R = lens.sphere_radius_mm, r = glass_radius_mm(lens.aperture_radius_mm, array);
    const double n = index_at(lens.index, lens.glass, wavelength_nm);
    // T = h + R - sqrt(R^2 - r^2): the sphere's centre lies sqrt(R^2 - r^2) below the wall's end, its apex R above the centre. The
    // form (R - r)(R + r) avoids cancellation.
    const double thickness = lens.cylinder_height_mm + R - std::sqrt((R - r) * (R + r));
    if (lens.facing == Facing::viewer) return {{0, 0, 0, {}, r, 1, n}, {thickness, -1 / R, 0, {}, r, n, 1}};
    return {{0, 1 / R, 0, {}, r, 1, n}, {thickness, 0, 0, {}, r, n, 1}};
}

std::vector<PlacedSurface> placed(const SurfaceLens& lens, const LensArray&, double wavelength_nm) {
    std::vector<PlacedSurface> placed;
    double z = 0, below = 1;
    for (const Surface& s : lens.surfaces) {
        const bool last = &s == &lens.surfaces.back();
        const double above = last ? 1 : index_at(s.index, s.glass, wavelength_nm);
        placed.push_back({z, s.curvature_per_mm, s.conic, s.even_asphere, s.semi_aperture_mm, below, above});
        z += s.distance_mm;
        below = above;
    }
    return placed;
}

std::vector<PlacedSurface> placed(const IdealLens& lens, const LensArray& array, double) {
    return {{0, 0, 0, {}, glass_radius_mm(lens.aperture_radius_mm, array), 1, 1, SurfaceForm::thin, lens.focal_length_mm}};
}

std::vector<PlacedSurface> placed(const Pinhole& hole, const LensArray&, double) {
    return {{0, 0, 0, {}, hole.aperture_radius_mm, 1, 1, SurfaceForm::thin, std::numeric_limits<double>::infinity()}};
}

}  // namespace

std::vector<PlacedSurface> prescription(const Lens& lens, const LensArray& array, double wavelength_nm) {
    return std::visit([&](const auto& kind) { return placed(kind, array, wavelength_nm); }, lens.kind);
}

Geometry turned_over(Geometry g) {
    std::reverse(g.surfaces.begin(), g.surfaces.end());
    for (PlacedSurface& s : g.surfaces) {
        s.z_mm = -s.z_mm;
        s.curvature_per_mm = -s.curvature_per_mm;
        for (double& a : s.even_asphere) a = -a;
        std::swap(s.index_below, s.index_above);
    }
    std::swap(g.base_z_mm, g.top_z_mm);
    std::swap(g.front_principal_mm, g.rear_principal_mm);
    for (double* z : {&g.base_z_mm, &g.top_z_mm, &g.vertex_plane_mm, &g.front_principal_mm, &g.rear_principal_mm, &g.stop_z_mm})
        *z = -*z;
    g.entrance_z_mm = g.surfaces.back().z_mm;
    return g;
}

}  // namespace lfdsim
