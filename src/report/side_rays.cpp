#include "report/side_rays.h"

#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

/// dz/ds of a surface; the derivative of sag_mm().
double slope(const PlacedSurface& f, double s) {
    const double c = f.curvature_per_mm;
    double sum = c * s / std::sqrt(1 - (1 + f.conic) * c * c * s * s), power = s * s * s;
    for (std::size_t i = 0; i < f.even_asphere.size(); ++i) {
        sum += double(2 * (i + 2)) * f.even_asphere[i] * power;
        power *= s * s;
    }
    return sum;
}

/// Newton's method from the vertex plane; beyond the rim the surface goes on flat. False: it is not met within the rim.
bool meet(const PlacedSurface& f, double rim, SideRay& ray) {
    double t = (f.z_mm - ray.z) / ray.dz;
    for (int step = 0; step < 60; ++step) {
        const double y = ray.y + t * ray.dy, s = std::clamp(y, -rim, rim);
        const double above = ray.z + t * ray.dz - f.z_mm - sag_mm(f.curvature_per_mm, f.conic, f.even_asphere, std::abs(s));
        const double change = above / (ray.dz - (s == y ? slope(f, s) * ray.dy : 0));
        if (!std::isfinite(change)) return false;
        t -= change;
        if (std::abs(change) > 1e-12 * (1 + std::abs(t))) continue;
        ray.y += t * ray.dy;
        ray.z += t * ray.dz;
        return std::abs(ray.y) <= rim;
    }
    return false;
}

bool refract(const PlacedSurface& f, SideRay& ray) {
    const double sense = ray.dz > 0 ? -1 : 1, tilt = slope(f, ray.y), per = sense / std::hypot(1, tilt);
    const double ny = -tilt * per, nz = per;  // against the ray
    const double eta = ray.dz > 0 ? f.index_below / f.index_above : f.index_above / f.index_below;
    const double cosine = -(ray.dy * ny + ray.dz * nz), rest = 1 - eta * eta * (1 - cosine * cosine);
    if (!(rest > 0) || !(cosine > 0)) return false;
    const double m = eta * cosine - std::sqrt(rest);
    ray.dy = eta * ray.dy + m * ny;
    ray.dz = eta * ray.dz + m * nz;
    return true;
}

}  // namespace

SideRay side_ray(double y, double z, double to_y, double to_z) {
    const double length = std::hypot(to_y - y, to_z - z);
    return {y, z, (to_y - y) / length, (to_z - z) / length};
}

SidePath through_lens(const Display& d, const Geometry& g, const SideRay& start) {
    SidePath path{{{start.y, start.z}}, start, true};
    SideRay& ray = path.last;
    const bool up = start.dz > 0;
    const double cell = d.array.aperture == Aperture::square ? d.array.pitch_mm[1] / 2 : INFINITY;
    const auto end = [&] {
        path.through = false;
        return path;
    };
    // Whether the way from where the ray stands to another height leads past the stop's hole; the path then ends there.
    const auto stopped = [&](double to_z) {
        if (!d.lens.stop_radius_mm || (ray.z - g.stop_z_mm) * (to_z - g.stop_z_mm) > 0) return false;
        const double y = ray.y_at(g.stop_z_mm);
        if (std::abs(y) <= *d.lens.stop_radius_mm) return false;
        path.points.push_back({y, g.stop_z_mm});
        return true;
    };
    if (g.surfaces.empty()) {
        const double y = ray.y_at(g.vertex_plane_mm), incline = ray.dy / ray.dz;
        const double after = incline + (up ? -1 : 1) * y / g.focal_length_mm, sense = up ? 1 : -1;
        path.points.push_back({y, g.vertex_plane_mm});
        ray = {y, g.vertex_plane_mm, sense * after / std::hypot(1, after), sense / std::hypot(1, after)};
        path.through = std::abs(y) <= 0.5 * g.clear_aperture_mm[1];
        return path;
    }
    for (std::size_t k = 0; k < g.surfaces.size(); ++k) {
        const PlacedSurface& surface = g.surfaces[up ? k : g.surfaces.size() - 1 - k];
        const double rim = std::min(surface.semi_aperture_mm, cell);
        SideRay next = ray;
        const bool met = meet(surface, rim, next);
        // A ray beside the lens ends as high as the rim.
        const double z = met ? next.z : surface.z_mm + sag_mm(surface.curvature_per_mm, surface.conic, surface.even_asphere, rim);
        if (stopped(z)) return end();
        if (!met) next = {ray.y_at(z), z, ray.dy, ray.dz};
        ray = next;
        path.points.push_back({ray.y, ray.z});
        if (!met || !refract(surface, ray)) return end();
    }
    if (stopped(up ? INFINITY : -INFINITY)) return end();
    return path;
}

}  // namespace lfdsim
