// A first design, taken backwards through the theory, gives what was asked for.
#include "checks/first_order.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

#include "base/input_error.h"
#include "geometry/geometry.h"

namespace lfdsim {
namespace {

double between(double low, double high) { return low * std::pow(high / low, *rc::gen::inRange(0, 1 << 20) / double(1 << 20)); }

DesignRequest any_request() {
    DesignRequest r;
    r.panel_inch = between(0.3, 200);
    r.pixels = {*rc::gen::inRange<std::int64_t>(40, 8000), *rc::gen::inRange<std::int64_t>(40, 8000)};
    r.fov_deg = between(3, 110);
    r.distance_mm = between(10, 2e4);
    if (*rc::gen::arbitrary<bool>()) r.depth_mm = (*rc::gen::arbitrary<bool>() ? 1 : -1) * between(1, 5e4);
    if (*rc::gen::arbitrary<bool>()) r.lens = LensType::ideal;
    return r;
}

TEST(FirstOrder, TheoryGivesBackWhatWasAskedFor) {
    int made = 0;
    rc::check([&] {
        const DesignRequest r = any_request();
        FirstOrder o;
        try {
            o = first_order(r);
        } catch (const InputError&) {
            return;
        }
        ++made;
        const Geometry g = resolve(o.display);  // throws unless it is valid
        const Theory t = theory(o.display, g);
        // Lengths are rounded to a nanometre, the radius before it is divided by n - 1. The wall's height is told to three digits
        // and known when the gap is sought, so it takes no part.
        const double rounding = 1.1e-6, L = *o.request.depth_mm;
        if (r.depth_mm) RC_ASSERT(L == *r.depth_mm);
        RC_ASSERT(std::abs(t.central_depth_mm - L) <= L * L * rounding / (t.gap_mm * t.gap_mm) * 4 + 1e-9 * std::abs(L));
        RC_ASSERT(std::abs(t.along[0].fov_elemental_deg - r.fov_deg) <= 1e-3 + 60 * rounding / t.gap_mm);
        // Whole pixels behind each lens, whole elemental images on the panel, and no room for more of them.
        RC_ASSERT(std::abs(t.along[0].views - o.views) < 1e-3);
        const double across[] = {g.panel_width_mm, g.panel_height_mm};
        for (std::size_t k = 0; k < 2; ++k) {
            RC_ASSERT(double(o.display.array.count->at(k)) * t.along[0].elemental_pitch_mm <= across[k] * (1 + 1e-5));
            RC_ASSERT(double(o.display.array.count->at(k) + 1) * t.along[0].elemental_pitch_mm > across[k] * (1 - 1e-5));
        }
        // The diffuser's own distance spreads light over a lens pitch.
        if (const std::optional<Diffuser>& d = o.display.diffuser)
            RC_ASSERT(
                std::abs(2 * d->distance_mm * std::tan(d->angle_deg[0] * std::acos(-1.0) / 360) / o.display.array.pitch_mm[0] - 1) <
                0.01);
    });
    EXPECT_GT(made, 20);
}

TEST(FirstOrder, ResolutionOfLensesAndPixelsIsBalanced) {
    const FirstOrder o = first_order({8, {2560, 1600}, 30, 500, 50, LensType::ideal});
    EXPECT_EQ(o.pitch_rule, PitchRule::balanced);
    const double lens = o.display.array.pitch_mm[0] / o.eye_mm, pixel = o.theory.pixel_image_mm / (o.eye_mm - 50);
    EXPECT_NEAR(lens / pixel, 1, 0.05);  // half a pixel of 21 is a fortieth
}

// A depth of its own choice is never what a design is refused for.
TEST(FirstOrder, NearEyesHaveACentralDepthPlaneAtAMetreAtMost) {
    EXPECT_EQ(*first_order({0.7, {1920, 1080}, 30, 20, {}}).request.depth_mm, -1000);
    EXPECT_EQ(*first_order({0.7, {1920, 1080}, 25, 15, {}}).request.depth_mm, -750);
}

// The nearest possible value that a refusal names is possible, and near.
TEST(FirstOrder, RefusalsNameAPossibleValue) {
    struct Case {
        DesignRequest request;
        const char* where;
        double DesignRequest::*field;
        double low, high;
    };
    const Case cases[] = {
        {{0.7, {1920, 1080}, 10, 20, {}}, "--fov-deg", &DesignRequest::fov_deg, 10, 15},
        {{0.7, {1920, 1080}, 10, 20, {}}, "--fov-deg", &DesignRequest::distance_mm, 20, 30},
        {{8, {2560, 1600}, 119, 500, {}}, "--fov-deg", &DesignRequest::fov_deg, 70, 119},
    };
    for (const Case& c : cases) {
        try {
            first_order(c.request);
            FAIL() << c.where;
        } catch (const InputError& e) {
            ASSERT_EQ(e.problems.size(), 1u);
            EXPECT_EQ(e.problems[0].where, c.where);
            const std::string name = c.field == &DesignRequest::fov_deg ? "--fov-deg " : "--distance-mm ";
            const std::size_t at = e.problems[0].what.find(name, e.problems[0].what.find("nearest"));
            ASSERT_NE(at, std::string::npos) << e.what();
            DesignRequest possible = c.request;
            possible.*c.field = std::stod(e.problems[0].what.substr(at + name.size()));
            EXPECT_GT(possible.*c.field, c.low);
            EXPECT_LT(possible.*c.field, c.high);
            EXPECT_NO_THROW(first_order(possible));
        }
    }
}

TEST(FirstOrder, RefusesWhatCannotBe) {
    const auto where = [](const DesignRequest& r) {
        try {
            first_order(r);
        } catch (const InputError& e) {
            std::vector<std::string> all;
            for (const Problem& p : e.problems) all.push_back(p.where);
            return all;
        }
        return std::vector<std::string>{};
    };
    const double nan = std::nan("");
    using testing::ElementsAre;
    EXPECT_THAT(where({0, {2560, 1600}, 0.5, nan, 1e7}), ElementsAre("--panel-inch", "--fov-deg", "--distance-mm", "--depth-mm"));
    EXPECT_THAT(where({8, {39, 1600}, 30, 500, {}}), ElementsAre("--pixels"));
    EXPECT_THAT(where({8, {2560, 1600}, 30, 500, 251}), ElementsAre("--depth-mm"));  // more than half-way to the eye
    EXPECT_THAT(where({8, {2560, 1600}, 30, 500, 0.5}), ElementsAre("--depth-mm"));  // within the lenses
    EXPECT_THAT(where({8, {2560, 1600}, 30, 500, 0}), ElementsAre("--depth-mm"));
    EXPECT_THAT(where({8, {2560, 1600}, 30, 500, -1e5}), ElementsAre("--depth-mm"));  // as good as at infinity
    EXPECT_THAT(where({8, {2560, 1600}, 30, 500, {}, LensType::surfaces}), ElementsAre("--lens"));
}

}  // namespace
}  // namespace lfdsim
