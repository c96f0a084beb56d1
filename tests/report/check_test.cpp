// Figures that `lfdsim check` derives for its reader, against closed forms.
#include "report/folder/check.h"

#include <gtest/gtest.h>

#include "geometry/subpixels.h"

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

// Cells that lenses fill have no gaps to close; round lenses, and a stop in the cells, leave some.
TEST(Check, NoDiffuserClosesGapsOfLensesThatFillTheirCells) {
    Display d;
    d.panel.pixels = {800, 600};
    d.panel.pixel_pitch_mm = 0.1;
    d.array.pitch_mm = 2;
    d.array.gap_mm = 3.3;
    d.diffuser = Diffuser{50, {1, 1}, Profile::box};
    for (const LatticeKind lattice : {LatticeKind::square, LatticeKind::hexagon, LatticeKind::strips}) {
        d.array.lattice = lattice;
        d.array.aperture = Aperture::cell;
        d.lens = {IdealLens{0.9, 3.2}, {}};
        const Json filled = check_json(d);
        for (const char* name : {"gap_closing_diffuser_deg", "gap_closing_here_deg"}) {
            EXPECT_TRUE(filled.at("theory").at(name).is_null());
            EXPECT_NE(filled.at("notes").at(std::string("theory.") + name).get<std::string>().find("no gaps"), std::string::npos);
        }
        d.lens.stop_radius_mm = 0.9;
        EXPECT_TRUE(check_json(d).at("theory").at("gap_closing_here_deg").is_number());
        d.lens.stop_radius_mm.reset();
        d.array.aperture = Aperture::circle;
        EXPECT_TRUE(check_json(d).at("theory").at("gap_closing_here_deg").is_number());
    }
}

// Two pixels are behind each lens of a display for an eye at 600 mm, though the lens is less than two pixels wide.
TEST(Check, ViewsAreAlsoCountedByWholeElementalImages) {
    Display d;
    d.panel.pixels = {800, 600};
    d.panel.pixel_pitch_mm = 0.1;
    d.lens.kind = IdealLens{0.09, 1.4};
    d.array.lattice = LatticeKind::strips;
    d.array.aperture = Aperture::cell;
    d.array.gap_mm = 1.4;
    d.array.pitch_mm = 0.2 / (1 + 1.4 / (600 - 1.4));
    d.content.viewing_distance_mm = 600;
    const Json theory = check_json(d).at("theory");
    EXPECT_NEAR(theory.at("views_elemental"), 2, 1e-12);
    EXPECT_NEAR(theory.at("views"), 2 * (600 - 1.4) / 600, 1e-12);
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
