// The ideal thin lens of paraxial theory, without aberrations and losses, and the pinhole, which is one without power. Floor 1.
#pragma once
#include "optics/opaque_surround.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

/// From the plane of the lens to the panel: slope on the panel's side = slope on the viewer's side + q / f.
template <class F>
LFDSIM_FN PanelPoint<F> trace_ideal(const Scene<Scalar<F>>& scene, const Extent<Scalar<F>>& extent,
                                    const PanelBase<Scalar<F>>& base, Passage<F> way) {
    using S = Scalar<F>;
    const Vec3<F> at = way.ray.at;
    way.cell = cell_at(scene.lattice, at.x, at.y);
    const Place<F> axis = axis_of(scene.lattice, way.cell);
    const F qx = at.x - axis.x, qy = at.y - axis.y, r = F(scene.aperture_radius);
    const F across_y = across(scene.lattice, qy), q2 = qx * qx + across_y * across_y;
    way.alive = way.alive && extent.holds(way.cell);
    if (scene.aperture == Aperture::circle) way.alive = way.alive && (q2 <= r * r);
    if (scene.has_stop) way.alive = way.alive && (q2 <= F(scene.stop_radius2));
    const F fall = F(1) / way.ray.to.z;
    const auto [mx, my] = bend(scene, Place<F>{qx, qy}, Place<F>{way.ray.to.x * fall, way.ray.to.y * fall});
    if (scene.layer_count > 0) {
        const F per = F(1) / sqrt(F(1) + mx * mx + my * my);
        Vec3<F> to{-mx * per, -my * per, -per};
        const Place<F> end = down_to_panel(scene, {qx, qy, F(scene.ideal_z)}, F(0) > F(1), to, way.weight, way.alive);
        if (scene.emission_exponent != S(0)) way.weight = way.weight * power(-to.z, scene.emission_exponent);
        return panel_point(scene, scene.lattice, base, way.cell, end.x, end.y, way.weight, way.alive);
    }
    if (scene.emission_exponent != S(0)) {
        way.weight = way.weight * power(F(1) / sqrt(F(1) + mx * mx + my * my), scene.emission_exponent);
    }
    return panel_point(scene, scene.lattice, base, way.cell, qx - mx * F(scene.ideal_z), qy - my * F(scene.ideal_z), way.weight,
                       way.alive);
}

}  // namespace lfdsim::optics::inline LFDSIM_ISA
