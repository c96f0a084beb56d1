// Figures that `lfdsim check` derives for its reader, against closed forms.
#include "report/check.h"

#include <gtest/gtest.h>

#include "model/subpixels.h"

#include <cmath>

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

// Ideal lenses have no thickness. A depth z is within the intervals where D |1 - z/L| is at most p, or a pixel's image a |z|/g;
// none is behind the viewer, and half a cycle per pitch at the lenses is E/2p per radian.
TEST(Check, DepthsOfFieldAreThoseOfTheSpotAndEndAtTheViewer) {
    Display d;
    d.panel.pixels = {800, 600};
    d.array.pitch_mm = 2;
    d.array.gap_mm = 3.3;
    d.camera.position_mm = {0, 0, 600};
    for (const double f : {2.8, 3.2, 3.29, 3.3, 3.4, 4.})
        for (const double a : {0.02, 0.1, 0.3}) {
            d.panel.pixel_pitch_mm = a;
            d.lens.kind = IdealLens{0.9, f};
            const Json theory = check_json(d).at("theory");
            const double per_L = 1 / f - 1 / 3.3;
            const auto within = [&](const std::string& rule, double z) {
                for (const char* side : {"_behind_mm", "_in_front_mm"}) {
                    const Json& ends = theory.at(rule + side);
                    if (ends.is_null()) continue;
                    const double low = ends[0] == "-infinite" ? -INFINITY : ends[0].get<double>();
                    EXPECT_LE(ends[1].get<double>(), 600 - 3.3 + 1e-9);
                    if (low <= z && z <= ends[1].get<double>()) return true;
                }
                return false;
            };
            for (double z = -2000.3; z < 700; z += 7.7) {
                const double spot = 1.8 * std::abs(1 - z * per_L);
                EXPECT_EQ(within("by_lens", z), spot <= 2 && z < 600 - 3.3) << f << " " << z;
                EXPECT_EQ(within("by_pixel", z), spot <= a * std::abs(z) / 3.3 && z < 600 - 3.3) << f << " " << a << " " << z;
            }
            const double degree = std::acos(-1.) / 180;
            EXPECT_NEAR(theory.at("at_the_lenses_per_degree"), (600 - 3.3) / 4 * degree, 1e-9);
            const bool reaches_the_lenses = per_L == 0 || a / 3.3 / std::abs(per_L) >= 1.8;  // half of 2 |L| P_I / D, more than L
            EXPECT_EQ(theory.at("depth_of_field_mm").is_null(), reaches_the_lenses) << f << " " << a;
        }
}

}  // namespace
}  // namespace lfdsim
