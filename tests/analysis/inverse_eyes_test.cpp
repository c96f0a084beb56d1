// The eyes that the inverse pick-up serves by default: those of the viewing zone, of both its directions.
#include "analysis/core/subject.h"
#include "analysis/pictures/shown_content.h"
#include "analysis/zone/zone_search.h"
#include "lenses.h"

#include <gtest/gtest.h>

namespace lfdsim {
namespace {

std::vector<EyeBox> eyes_of(const Display& d) {
    Job job;
    return inverse_eyes(d, resolve(d), 2, job);
}

// Right before the eye the zone is a few mm high, and eyes beyond it see neighbouring lenses' images; of a desktop display it is
// higher than heads move.
TEST(InverseEyes, AreWithinTheZoneUpAndDownToo) {
    Display d;
    d.panel.pixels = {240, 160};
    d.panel.pixel_pitch_mm = 0.04;
    d.lens.kind = PlanoConvex{2, {}, 0.3, 1.5, Facing::viewer};
    d.array.pitch_mm = Pitch(1.6);
    d.array.gap_mm = 3.9;
    d.array.aperture = Aperture::cell;
    d.camera.position_mm = {0, 0, 30};
    d.content.viewing_distance_mm = 30;
    const std::vector<EyeBox> near = eyes_of(d);
    ASSERT_EQ(near.size(), 1u);
    const Subject s(d, {}, {});
    const double eye = 30 - s.geometry().rear_principal_mm;
    for (const std::size_t axis : {0u, 1u}) {
        const double most = eye * paraxial_zone(s, axis).half_fov;
        EXPECT_GT(near[0].high[axis], 0.2 * most) << axis;
        EXPECT_LT(near[0].high[axis], most) << axis;
        EXPECT_NEAR(near[0].low[axis], -near[0].high[axis], 0.1 * most) << axis;
    }
    const std::vector<EyeBox> far = eyes_of(lens_examples::shipped("desktop-asphere"));
    EXPECT_EQ(far.at(0).high[1], 20);
    EXPECT_EQ(far.at(0).low[1], -20);
}

}  // namespace
}  // namespace lfdsim
