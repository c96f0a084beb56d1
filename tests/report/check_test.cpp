// Figures that `lfdsim check` derives for its reader, against closed forms.
#include "report/check.h"

#include <gtest/gtest.h>

#include "model/subpixels.h"

namespace lfdsim {
namespace {

// A stripe lies a third of a pixel a aside, and a pixel steps a D/g as seen from the distance D of the lenses, however the array is
// stretched; the middle one lies in the middle.
TEST(Check, SubpixelsShiftAsPixelsStep) {
    Display d;
    d.panel.pixels = {800, 600};
    d.panel.pixel_pitch_mm = 0.085;
    d.panel.subpixels = SubpixelLayout::rgb_stripe;
    d.panel.aperture_ratio = 0.6;
    d.lens.kind = IdealLens{{}, 1.4};
    d.array.pitch_mm = 0.7;
    d.array.gap_mm = 1.4;
    d.array.aperture = Aperture::cell;
    d.camera.position_mm = {0, 0, 450};
    d.content.viewing_distance_mm = 450;
    for (const double ppm : {0., 300., -5000.}) {
        d.errors.pitch_ppm = ppm;
        const Json shift = check_json(d).at("theory").at("subpixel_shift_mm");
        const double aside = 0.085 / 3 * (450 - 1.4) / 1.4;
        EXPECT_NEAR(shift.at(0), aside, 1e-9 * aside) << ppm;
        EXPECT_EQ(shift.at(1), 0) << ppm;
        EXPECT_NEAR(shift.at(2), aside, 1e-9 * aside) << ppm;
    }
}

}  // namespace
}  // namespace lfdsim
