// Content for arrays as they were built: lines through the nodal points of lenses that stand by themselves.
#include "content/pickup/moved_lenses.h"
#include "base/constants.h"
#include "content/pickup/pickup.h"
#include "small_world.h"

#include <random>

namespace {

using namespace small_world;

/// In any lattice, made for the display as built.
Display built(LatticeKind lattice, double viewer_mm) {
    Display d = display();
    d.array.lattice = lattice;
    if (lattice == LatticeKind::strips) d.array.count = {12, 1};
    d.array.rotation_deg = 7;
    d.array.offset_mm = {0.7, -0.4};
    d.content.viewing_distance_mm = viewer_mm;
    d.content.made_for = MadeFor::built;
    return d;
}

/// The same error of all lenses.
std::shared_ptr<const std::vector<GivenLensError>> all_alike(const Display& d, const LensError& error) {
    auto given = std::make_shared<std::vector<GivenLensError>>();
    for (std::int64_t j = 0; j < d.array.count->at(1); ++j)
        for (std::int64_t i = 0; i < d.array.count->at(0); ++i) given->push_back({i, j, error});
    return given;
}

// But for points so near the border of two cells that they belong to the other one: cells move as they are, those of an array at
// another gap grow.
void expect_the_same_lines(const Display& a, const Display& b) {
    ASSERT_TRUE(validate(a).empty());
    ASSERT_TRUE(validate(b).empty());
    const Pickup one(a, resolve(a)), other(b, resolve(b));
    EXPECT_TRUE(one.irregular());
    EXPECT_FALSE(other.irregular());
    std::mt19937 random(3);
    std::uniform_real_distribution<double> x(-22, 22), y(-15, 15);
    int compared = 0;
    for (int k = 0; k < 2000; ++k) {
        const double px = x(random), py = y(random);
        const NodalLine l = one.line(px, py), m = other.line(px, py);
        if (!l.owned || !m.owned || std::hypot(l.x - m.x, l.y - m.y) > 1) continue;
        ++compared;
        // Where lenses stand higher, lines are given by where they pass another plane.
        const double up = other.z_rear - one.z_rear;
        EXPECT_NEAR(l.x + l.mx * up, m.x, 1e-9);
        EXPECT_NEAR(l.y + l.my * up, m.y, 1e-9);
        EXPECT_NEAR(l.mx, m.mx, 1e-12);
        EXPECT_NEAR(l.my, m.my, 1e-12);
    }
    EXPECT_GT(compared, 1800);
}

// Lenses that are all off alike are an array that is: shifted, or at another gap.
TEST(MovedLenses, AllAlikeAreAMovedArray) {
    for (const LatticeKind lattice : {LatticeKind::square, LatticeKind::hexagon, LatticeKind::strips})
        for (const double viewer : {300., infinity}) {
            Display each = built(lattice, viewer), whole = each;
            const bool strips = lattice == LatticeKind::strips;
            const double aside[2] = {0.08, strips ? 0 : -0.05}, turn = 7 * degree;
            each.errors.given = all_alike(each, {{aside[0], aside[1]}, 0, {}, 0});
            whole.errors.shift_mm = {aside[0] * std::cos(turn) - aside[1] * std::sin(turn),
                                     aside[0] * std::sin(turn) + aside[1] * std::cos(turn)};
            expect_the_same_lines(each, whole);
            each.errors = whole.errors = {};
            each.errors.given = all_alike(each, {{}, 0.3, {}, 0});
            whole.errors.gap_mm = 0.3;
            expect_the_same_lines(each, whole);
        }
}

// The line of the middle of each elemental image goes to the viewer, and all panel points lie in the cells about these middles, but
// for what moves them against each other.
TEST(MovedLenses, ElementalImagesLookAtTheViewer) {
    for (const LatticeKind lattice : {LatticeKind::square, LatticeKind::brick, LatticeKind::strips}) {
        Display d = built(lattice, 300);
        d.errors.decenter_sd_mm = 0.03;
        d.errors.height_sd_mm = 0.05;
        d.errors.tilt_sd_deg = 0.5;
        d.errors.bow_mm = 0.4;
        if (lattice != LatticeKind::strips) d.errors.wedge_deg = {1, -0.5};
        ASSERT_TRUE(validate(d).empty());
        const Pickup pickup(d, resolve(d));
        const Lattice<double>& l = pickup.lattice();
        std::mt19937 random(4);
        std::uniform_real_distribution<double> x(-20, 20), y(-13, 13);
        for (int k = 0; k < 1000; ++k) {
            const double px = x(random), py = y(random);
            const Pickup::ElementalPosition p = pickup.place(px, py);
            if (!p.owned) continue;
            EXPECT_LT(std::abs(p.u), 0.53);
            EXPECT_LT(std::abs(p.v), 0.53);
            const auto off = optics::to_display(l, p.u * l.pitch[0] * pickup.scale, p.v * l.pitch[1] * pickup.scale);
            const NodalLine line = pickup.line(px - off.x, py - off.y);
            const double at[2] = {line.x + line.mx * (300 - pickup.z_rear), line.y + line.my * (300 - pickup.z_rear)};
            EXPECT_NEAR(at[0], 0, 1e-9);
            EXPECT_NEAR(at[1], 0, 1e-9);
        }
    }
}

}  // namespace
