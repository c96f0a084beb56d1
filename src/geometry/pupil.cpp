#include "geometry/pupil.h"

#include "geometry/resolve.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lfdsim {

Pupil pupil(const std::vector<PlacedSurface>& surfaces, std::optional<double> stop_radius_mm, double stop_z_mm) {
    Pupil found{std::numeric_limits<double>::infinity(), {}, 1};
    /// A ray that comes down from the viewer's side: how far from the axis it is, and by how much more so per mm further down.
    struct AxialRay {
        double height, slope;
    };
    AxialRay parallel{1, 0}, oblique{0, 1};  // the latter from the first vertex it meets
    const double first_z = surfaces.back().z_mm;
    double z = first_z;
    for (std::size_t k = surfaces.size(); k-- > 0;) {
        const PlacedSurface& s = surfaces[k];
        const bool thin = s.form == SurfaceForm::thin;
        // Going down, a surface with c < 0 is convex to the ray: n' slope' = n slope + c (n' - n) height.
        const double power = thin ? 0 : s.curvature_per_mm * (s.index_below - s.index_above);
        for (AxialRay* ray : {&parallel, &oblique}) ray->height += ray->slope * (z - s.z_mm);
        z = s.z_mm;
        const double height = std::abs(parallel.height);
        const bool first = k + 1 == surfaces.size();
        const auto narrow = [&](double radius) {
            if (!(radius < found.radius_mm * height)) return;
            found.radius_mm = radius / height;
            // A combination of both rays passes the aperture's middle. The middle is seen where that ray, extended from the first
            // vertex, crosses the axis.
            found.inner_z.reset();
            if (!first) found.inner_z = first_z - oblique.height / parallel.height;
        };
        narrow(s.semi_aperture_mm);
        if (stop_radius_mm && s.z_mm == stop_z_mm) narrow(*stop_radius_mm);
        found.cells = std::min(found.cells, 1 / height);
        for (AxialRay* ray : {&parallel, &oblique}) ray->slope = (s.index_above * ray->slope + power * ray->height) / s.index_below;
    }
    return found;
}

std::array<double, 2> light_width_mm(const Display& d, const Geometry& g) {
    // A ray that leaves the panel's point with a reduced slope of 1 is g from the axis in both principal planes and at the height h
    // in an aperture: D_L = 2 g min r/|h|.
    double height = 0, slope = 1, z = 0, index = 1;   // slope times index
    const auto climb = [&](double to_z, double in) {  // to the height to_z, in a medium of the index `in`
        height += slope * (to_z - z) / in;
        z = to_z;
    };
    std::array<double, 2> width;
    width.fill(std::numeric_limits<double>::infinity());
    for (const PlacedLayer& layer : g.layers) climb(z + layer.thickness_mm, layer.index);
    for (const PlacedSurface& s : g.surfaces) {
        climb(s.z_mm, index);
        double radius = s.semi_aperture_mm;
        if (d.lens.stop_radius_mm && s.z_mm == g.stop_z_mm) radius = std::min(radius, *d.lens.stop_radius_mm);
        for (std::size_t k = 0; k < 2; ++k) {
            const double half = d.array.aperture == Aperture::cell ? std::min(radius, 0.5 * lens_pitch_mm(g, k)) : radius;
            width[k] = std::min(width[k], 2 * g.gap_mm * half / std::abs(height));
        }
        const double power =
            s.form == SurfaceForm::thin ? 1 / s.focal_length_mm : s.curvature_per_mm * (s.index_above - s.index_below);
        slope -= power * height;
        index = s.index_above;
    }
    return width;
}

}  // namespace lfdsim
