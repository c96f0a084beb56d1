// The ideal thin lens of paraxial theory, without aberrations and losses, and the pinhole, which is one without power. Floor 1.
#pragma once
#include "optics/opaque_surround.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

/// Traces a ray through an ideal lens or a pinhole and on to the panel. The ray starts in the lens's plane, and its slope (dx/dz,
/// dy/dz) changes to slope + q/f, q its distance from the axis, mm; layers then refract it. Ends rays outside the aperture, the
/// stop or the array.
template <class F>
LFDSIM_FN PanelPoint<F> trace_ideal(const TracedDisplay<Scalar<F>>& display, const Extent<Scalar<F>>& extent,
                                    const PanelBase<Scalar<F>>& base, Passage<F> passage) {
    using S = Scalar<F>;
    const Vec3<F> at = passage.ray.at;
    passage.cell = cell_at(display.lattice, at.x, at.y);
    const Vec2<F> axis = axis_of(display.lattice, passage.cell);
    const F qx = at.x - axis.x, qy = at.y - axis.y, r = F(display.aperture_radius);
    const F across_y = across(display.lattice, qy), q2 = qx * qx + across_y * across_y;
    passage.alive = passage.alive && extent.holds(passage.cell);
    if (display.aperture == Aperture::circle) passage.alive = passage.alive && (q2 <= r * r);
    if (display.has_stop) passage.alive = passage.alive && (q2 <= F(display.stop_radius2));
    // The slope (dx/dz, dy/dz) below the lens, m + q/f
    const F fall = F(1) / passage.ray.to.z;
    const auto [mx, my] = bend(display, Vec2<F>{qx, qy}, Vec2<F>{passage.ray.to.x * fall, passage.ray.to.y * fall});
    if (display.layer_count > 0) {  // layers need the unit direction of a line of that slope that goes down
        const F per = F(1) / sqrt(F(1) + mx * mx + my * my);
        Vec3<F> to{-mx * per, -my * per, -per};
        const Vec2<F> end = down_to_panel(display, {qx, qy, F(display.ideal_z)}, F(0) > F(1), to, passage.weight, passage.alive);
        if (display.emission_exponent != S(0)) passage.weight = passage.weight * power(-to.z, display.emission_exponent);
        return panel_point(display, display.lattice, base, passage.cell, end.x, end.y, passage.weight, passage.alive);
    }
    // Without layers the line meets the panel, z = 0, at q - m z, and the cosine there is 1/sqrt(1 + m^2).
    if (display.emission_exponent != S(0)) {
        passage.weight = passage.weight * power(F(1) / sqrt(F(1) + mx * mx + my * my), display.emission_exponent);
    }
    return panel_point(display, display.lattice, base, passage.cell, qx - mx * F(display.ideal_z), qy - my * F(display.ideal_z),
                       passage.weight, passage.alive);
}

}  // namespace lfdsim::optics::inline LFDSIM_ISA
