#include "engine/scene/misalignment.h"

#include "base/constants.h"
#include "engine/devices/memory.h"
#include "geometry/lens_misalignment.h"
#include "geometry/prescription.h"
#include "geometry/resolve.h"
#include "optics/lattice.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

/// The extremes of the errors over all lenses.
struct Extremes {
    // Largest displacement aside, least and greatest height, mm; largest |tilt_x| + |tilt_y|, radians; least and greatest 1 + e
    double aside = 0, low = 0, high = 0, tilt = 0, curvature[2] = {1, 1};

    void add(const LensError& e) {
        aside = std::max(aside, std::hypot(e.aside_mm[0], e.aside_mm[1]));
        low = std::min(low, e.height_mm);
        high = std::max(high, e.height_mm);
        tilt = std::max(tilt, (std::abs(e.tilt_deg[0]) + std::abs(e.tilt_deg[1])) * degree);
        curvature[0] = std::min(curvature[0], 1 + e.curvature);
        curvature[1] = std::max(curvature[1], 1 + e.curvature);
    }
};

template <class S>
optics::MisalignedLens<S> placed(const LensError& e) {
    const double x = e.tilt_deg[0] * degree, y = e.tilt_deg[1] * degree;
    return {{S(e.aside_mm[0]), S(e.aside_mm[1]), S(e.height_mm), S(1 + e.curvature)},
            {S(std::cos(x)), S(std::sin(x)), S(std::cos(y)), S(std::sin(y))}};
}

/// Returns the lowest and the highest sag of a surface over all lenses, mm from its vertex. Sag is monotonic in the curvature, so
/// the least and the greatest curvature bound it.
std::array<double, 2> sags(const PlacedSurface& surface, const Extremes& all) {
    std::array<double, 2> range{0, 0};
    if (surface.form == SurfaceForm::thin) return range;
    for (const double factor : all.curvature) {
        PlacedSurface s = surface;
        s.curvature_per_mm *= factor;
        const auto [low, high] = sag_range_mm(s);
        range = {std::min(range[0], low), std::max(range[1], high)};
    }
    return range;
}

/// Returns z of the highest rim of a lens whose curvatures are multiplied by `factor`, mm from the vertex plane.
double highest_rim_mm(const Geometry& g, double factor) {
    double rim = -infinity;
    for (const PlacedSurface& s : g.surfaces)
        rim = std::max(rim, s.z_mm + sag_mm(factor * s.curvature_per_mm, s.conic, s.even_asphere, s.semi_aperture_mm));
    return rim - g.vertex_plane_mm;
}

}  // namespace

std::vector<LensError> lenses_as_built(const Display& d, const Lattice<double>& lattice) {
    // The list, and the lenses that the tracer reads.
    const double count = double(lattice.count[0]) * double(lattice.count[1]), bytes = count * (2 * sizeof(LensError));
    constexpr double small_bytes = 1 << 20;
    if (bytes > small_bytes)
        require_memory("array.count", fmt::format("[errors] of {:.0f} individually misaligned lenses", count), bytes);
    std::vector<LensError> all = lens_errors(d, lattice);
    if (d.errors.bow_mm == 0) return all;
    const auto columns = std::size_t(lattice.count[0]);
    for (std::size_t k = 0; k < all.size(); ++k) {
        const auto axis = optics::axis_in_array(lattice, optics::Cell<double>{double(k % columns), double(k / columns)});
        all[k].height_mm += raised_mm(d.errors, lattice, axis.x, axis.y);
    }
    return all;
}

// The wedge is about the panel's axes, the frame of the tracer is turned about z: its matrix there is Rz^-1 Ry Rx Rz, Rz the
// array's rotation.
void wedge_of(const Errors& e, const Geometry& g, double (&wedge)[3][3]) {
    const double cx = std::cos(e.wedge_deg[0] * degree), sx = std::sin(e.wedge_deg[0] * degree),
                 cy = std::cos(e.wedge_deg[1] * degree), sy = std::sin(e.wedge_deg[1] * degree);
    const double about[3][3] = {{cy, sy * sx, sy * cx}, {0, cx, -sx}, {-sy, cy * sx, cy * cx}};
    const double c = g.lattice.cos_turn, s = g.lattice.sin_turn;
    const double turn[3][3] = {{c, -s, 0}, {s, c, 0}, {0, 0, 1}};
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column) {
            wedge[row][column] = 0;
            for (int k = 0; k < 3; ++k)
                for (int l = 0; l < 3; ++l) wedge[row][column] += turn[k][row] * about[k][l] * turn[l][column];
        }
}

template <class S>
void place_lenses(const Display& d, const Geometry& g, StoredDisplay<S>& scene) {
    optics::MisalignedArray<S>& misaligned = scene.misaligned;
    misaligned.wedged = is_wedged(d.errors);
    misaligned.given = is_irregular(d.errors);
    if (!misaligned.given) return;

    // The poses, and how far they differ
    Extremes all;
    if (lenses_differ(d.errors)) {
        const std::vector<LensError> errors = lenses_as_built(d, g.lattice);
        auto lenses = std::make_shared<std::vector<optics::MisalignedLens<S>>>();
        lenses->reserve(errors.size());
        for (const LensError& e : errors) {
            all.add(e);
            lenses->push_back(placed<S>(e));
        }
        misaligned.lens = lenses->data();
        scene.lenses = std::move(lenses);
    }
    misaligned.tilted = all.tilt != 0;
    misaligned.curved = all.curvature[0] != 1 || all.curvature[1] != 1;
    misaligned.lowest = S(all.low);
    misaligned.highest = S(all.high);
    misaligned.vertex_z = S(g.vertex_plane_mm);
    double wedge[3][3];
    wedge_of(d.errors, g, wedge);
    for (int k = 0; k < 9; ++k) misaligned.wedge[k / 3][k % 3] = S(wedge[k / 3][k % 3]);

    // The range of z in which rays meet the first surface of a lens at its lattice position
    if (misaligned.curved && !scene.ideal)
        for (int k = 0; k < scene.surface_count; ++k) {
            const auto [lowest, highest] = sags(g.surfaces[g.surfaces.size() - 1 - std::size_t(k)], all);
            scene.surface[k].low = S(lowest);
            scene.surface[k].high = S(highest);
        }
    const PlacedSurface& first = g.surfaces.back();
    const auto [low, high] = sags(first, all);
    const double entrance = first.z_mm - g.vertex_plane_mm;
    double top = entrance + high, bottom = entrance + low;
    if (scene.concave_front) {  // the entrance is the rim
        const auto [lowest, highest] = std::minmax({highest_rim_mm(g, all.curvature[0]), highest_rim_mm(g, all.curvature[1])});
        top = std::max(top, highest);
        bottom = lowest;
    }
    // Tilted by t about its vertex, a lens moves aside by sin(t) times what it extends above or below that, and up and down by
    // sin(t) times its semi-aperture.
    const double swing = std::sin(all.tilt) * std::max(std::abs(top), std::abs(bottom)),
                 sway = std::sin(all.tilt) * first.semi_aperture_mm;
    constexpr double rounding = 1e-4;  // mm, of single precision near a lens
    const double aside = all.aside + swing + rounding;
    const bool round = d.array.aperture == Aperture::circle;
    misaligned.overhang =
        S(aside + (round ? first.semi_aperture_mm - std::min(g.lattice.half_pitch[0], g.lattice.half_pitch[1]) : 0));
    misaligned.radius = S(aside + (round ? first.semi_aperture_mm : outer_radius_mm(d, g)));
    misaligned.search_top = S(top + all.high + sway + rounding);
    misaligned.search_bottom = S(bottom + all.low - sway - rounding);
}

template void place_lenses<float>(const Display&, const Geometry&, StoredDisplay<float>&);
template void place_lenses<double>(const Display&, const Geometry&, StoredDisplay<double>&);

}  // namespace lfdsim
