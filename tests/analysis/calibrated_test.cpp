// Calibrated content, against the tracer: what an eye sees through lenses that stand by themselves is what was made for it.
#include "analysis/core/eye_rays.h"
#include "base/constants.h"
#include "content/pickup/pickup.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lfdsim::calibrated {
namespace {

constexpr double eye_mm = 600;

/// Ideal lenses that are sharp where the eye is: all lines from there through one lens end in one point of the panel.
Display sharp_at_the_eye(LatticeKind lattice) {
    Display d;
    d.panel.pixels = {960, 640};
    d.panel.pixel_pitch_mm = 0.1;
    d.lens.kind = IdealLens{0.9, 1 / (1 / 5. + 1 / (eye_mm - 5))};
    d.array.lattice = lattice;
    d.array.pitch_mm = 2;
    d.array.gap_mm = 5;
    d.array.rotation_deg = 3;
    d.camera.position_mm = {0, 0, eye_mm};
    d.content.viewing_distance_mm = eye_mm;
    return d;
}

/// How far beside the eye the viewers are for whom it sees light, root mean square; of strips across them.
double miss_mm(const Display& d) {
    const Geometry g = resolve(d);
    const EyeRays rays(d, g);
    const Pickup pickup(d, g);
    double squares = 0;
    int seen = 0;
    for (Choice choice : even_choices(20000)) {
        choice[0] = choice[1] = 0;  // near the lenses' middles: lenses at another height are not sharp at the eye
        const Sight s = rays.look(d.camera.position_mm, choice);
        if (!(s.light > 0)) continue;
        const NodalLine line = pickup.line(s.x, s.y);
        if (!line.owned) continue;
        const double reach = eye_mm - pickup.z_rear;
        const auto at = optics::to_array(pickup.lattice(), line.x + line.mx * reach, line.y + line.my * reach);
        squares += at.x * at.x + optics::across(pickup.lattice(), at.y * at.y);
        ++seen;
    }
    EXPECT_GT(seen, 5000);
    return std::sqrt(squares / seen);
}

TEST(CalibratedContent, IsSeenByTheEyeThatItIsMadeFor) {
    for (const LatticeKind lattice : {LatticeKind::square, LatticeKind::hexagon, LatticeKind::strips}) {
        Display d = sharp_at_the_eye(lattice);
        EXPECT_LT(miss_mm(d), 1e-6) << int(lattice);
        d.errors.decenter_sd_mm = 0.02;
        d.errors.height_sd_mm = 0.02;
        d.errors.tilt_sd_deg = 0.3;
        d.errors.bow_mm = 0.2;
        if (lattice != LatticeKind::strips) d.errors.wedge_deg = {0.1, 0.2};
        // Decentres of 20 um at a gap of 5 mm: 2.4 mm at the eye along each axis.
        const double as_described = miss_mm(d);
        d.content.made_for = MadeFor::built;
        const double calibrated = miss_mm(d);
        EXPECT_GT(as_described, 2) << int(lattice);
        EXPECT_LT(calibrated, 0.1 * as_described) << int(lattice);
    }
}

}  // namespace
}  // namespace lfdsim::calibrated
