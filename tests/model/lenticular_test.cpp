// Designs of lenticular sheets give back, by the theory of check, what was asked for.
#include "checks/lenticular.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <limits>

#include "base/constants.h"
#include "base/input_error.h"
#include "checks/first_order.h"

namespace lfdsim {
namespace {

double drawn(double low, double high) { return low * std::pow(high / low, *rc::gen::inRange(0, 1 << 20) / double(1 << 20)); }

TEST(Lenticular, TheoryGivesBackWhatWasAskedFor) {
    int made = 0;
    rc::check([&] {
        LenticularRequest r;
        r.panel_inch = drawn(3, 100);
        r.pixels = {*rc::gen::inRange<std::int64_t>(300, 8000), *rc::gen::inRange<std::int64_t>(300, 5000)};
        r.distance_mm = drawn(200, 5000);
        if (*rc::gen::arbitrary<bool>()) r.views = drawn(2, 40);
        if (!r.views && *rc::gen::arbitrary<bool>()) r.pitch_mm = drawn(0.3, 10);
        if (*rc::gen::arbitrary<bool>()) r.slant_deg = drawn(1, 40) * (*rc::gen::arbitrary<bool>() ? 1 : -1);
        if (*rc::gen::arbitrary<bool>()) r.fov_deg = drawn(5, 90);
        if (*rc::gen::arbitrary<bool>()) r.lens = LensType::ideal;
        if (!r.fov_deg && r.lens != LensType::ideal && *rc::gen::arbitrary<bool>()) r.sheet_mm = drawn(0.3, 20);
        Lenticular o;
        try {
            o = lenticular(r);
        } catch (const InputError&) {
            return;
        }
        ++made;
        const Geometry g = resolve(o.display);
        const Theory t = theory(o.display, g);
        const double a = o.display.panel.pixel_pitch_mm, cos = g.lattice.cos_turn, nanometre = 1.1e-6;
        RC_ASSERT(std::abs(t.gap_mm - o.gap_mm) <= 4 * nanometre);
        RC_ASSERT(std::isinf(t.central_depth_mm));  // they focus on the panel
        RC_ASSERT(std::abs(t.along[0].view_step_deg * t.along[0].views - t.fov_of_eyes_deg) <= 1e-9);
        if (r.sheet_mm) RC_ASSERT(std::abs(g.vertex_plane_mm - *r.sheet_mm) <= 4 * nanometre);
        if (r.pitch_mm) RC_ASSERT(std::abs(o.display.array.pitch_mm[0] - *r.pitch_mm) <= nanometre);
        // Elemental images, which are N pixels of a row apart for the eye; the field of view is that of a whole one, along the
        // rows.
        const double behind = t.along[0].elemental_pitch_mm / cos;
        if (r.views) RC_ASSERT(std::abs(behind / a - *r.views) <= 4 * nanometre * (1 / a + *r.views / t.gap_mm));
        if (r.fov_deg)
            RC_ASSERT(std::abs(2 * std::atan(behind / (2 * t.gap_mm)) / degree - *r.fov_deg) <= 200 * nanometre / t.gap_mm);
    });
    EXPECT_GT(made, 20);
}

// Two views: each eye one, a distance of eyes apart; the borders of elemental images fall between pixels, of panels of all widths.
TEST(Lenticular, TwoViewsStandBeforeTwoEyes) {
    for (const std::int64_t columns : {1280, 1281, 1282, 1283})
        for (const double views : {2., 3., 4.}) {
            LenticularRequest r{8, {columns, 800}, 400, views, {}, 0};
            const Lenticular o = lenticular(r);
            const Display& d = o.display;
            const double a = d.panel.pixel_pitch_mm, border = 0.5 * double(d.array.count->at(0) % 2) * views * a,
                         offset = d.array.offset_mm[0] * (1 + o.gap_mm / o.eye_mm);
            const double pixels = (border + offset) / a + 0.5 * double(columns);  // from the panel's left side
            EXPECT_NEAR(pixels, std::round(pixels), 1e-4) << columns << ' ' << views;
            EXPECT_GE(double(d.array.count->at(0)) * views, double(columns) - 1);
            if (views == 2) {
                EXPECT_NEAR(a * o.eye_mm / o.gap_mm, 65, 0.01);
            }
        }
}

// The limit that a refusal names is possible, and hardly less is not.
TEST(Lenticular, RefusalsNameALimit) {
    const auto limit = [](const LenticularRequest& r, const std::string& option) {
        try {
            lenticular(r);
        } catch (const InputError& e) {
            const std::string& what = e.problems[0].what;
            const std::size_t at = what.find(option);
            if (at != std::string::npos) return std::stod(what.substr(at + option.size()));
        }
        return std::numeric_limits<double>::quiet_NaN();
    };
    LenticularRequest wide{8, {2560, 1600}, 500, 8.};
    wide.fov_deg = 80;
    wide.fov_deg = limit(wide, "--fov-deg of at most ");
    EXPECT_GT(*wide.fov_deg, 50);
    EXPECT_NO_THROW(lenticular(wide));
    LenticularRequest thin{8, {2560, 1600}, 500, 8.};
    thin.sheet_mm = 0.2;
    thin.sheet_mm = limit(thin, "--sheet-mm of at least ");
    EXPECT_NO_THROW(lenticular(thin));
    LenticularRequest near{8, {2560, 1600}, 100, 2.};
    near.distance_mm = limit(near, "--distance-mm of at least ");
    EXPECT_NO_THROW(lenticular(near));
    LenticularRequest finer{8, {2560, 1600}, 500, {}, 0.1};
    EXPECT_THROW(lenticular(finer), InputError);  // less than two pixels
}

}  // namespace
}  // namespace lfdsim
