#include "report/drawings/section.h"

#include "geometry/prescription.h"
#include "optics/lattice.h"

#include <algorithm>
#include <utility>

namespace lfdsim {
namespace {

/// Returns the lens cut at the borders of its cell on either side, half a pitch from the axis.
LensKind cut(LensKind kind, double half_mm, double glass_radius_mm) {
    if (auto* ball = std::get_if<PlanoConvex>(&kind)) {
        const double R = ball->sphere_radius_mm, r = std::min(glass_radius_mm, half_mm);
        // A narrower cap ends higher, and the wall below it reaches up to its rim.
        ball->cylinder_height_mm += sag_mm(1 / R, 0, {}, glass_radius_mm) - sag_mm(1 / R, 0, {}, r);
        ball->aperture_radius_mm = r;
    }
    if (auto* lens = std::get_if<SurfaceLens>(&kind))
        for (Surface& s : lens->surfaces) s.semi_aperture_mm = std::min(s.semi_aperture_mm, half_mm);
    if (auto* ideal = std::get_if<IdealLens>(&kind)) ideal->aperture_radius_mm = std::min(glass_radius_mm, half_mm);
    return kind;
}

}  // namespace

bool shows_a_row(const Display& d) { return is_staggered(d.array) || is_strips(d.array); }

Subject section_of(const Subject& s) {
    Display d = s.display();
    if (!shows_a_row(d)) return {std::move(d), {}, s.options()};
    const Geometry& g = s.geometry();
    // The row's direction x' becomes the y of the new display, which has one column of lenses.
    const auto along = [&](double x, double y) { return optics::to_array(g.lattice, x, y).x; };
    d.lens.kind = cut(d.lens.kind, g.lattice.pitch[0] / 2, g.glass_radius_mm);
    d.array = LensArray{};
    d.array.count = {1, std::int64_t(g.lattice.count[0])};
    d.array.pitch_mm = g.lattice.pitch[0];
    d.array.base_z_mm = g.base_z_mm;
    d.array.surround = s.display().array.surround;
    d.array.offset_mm = {0, along(g.lattice.offset[0], g.lattice.offset[1])};
    std::swap(d.panel.pixels[0], d.panel.pixels[1]);
    if (d.diffuser) std::swap(d.diffuser->angle_deg[0], d.diffuser->angle_deg[1]);
    for (Vec3d* place : {&d.camera.position_mm, &d.camera.target_mm}) *place = {0, along((*place)[0], (*place)[1]), (*place)[2]};
    d.camera.up = {1, 0, 0};
    return {std::move(d), {}, s.options()};
}

}  // namespace lfdsim
