// Elemental images made for the real lens.
#include "content/pickup/lens_mapping.h"
#include "content/pickup/pickup.h"
#include "small_world.h"

namespace {

using namespace small_world;

class TracedPickup : public testing::Test {
  protected:
    Picture shoot(Display d, PickupKind pickup, int threads = 0) const {
        d.content.pickup = pickup;
        Job job;
        const Geometry g = resolve(d);
        return elemental_images(d, g, ContentScene({load_model(model)}, d, g), threads, job);
    }
    Folder folder;
    fs::path model = write_patches(folder, {{-8, 8, -10, 10, 3, "white"}, {-5, 9, -9, 4, 20, "red"}, {-3, 8, -2, 10, 31, "green"}});
};

// A thin lens has no aberrations.
TEST_F(TracedPickup, IdealLensesOfEveryLatticeGetTheNodalPictures) {
    Display d = display();
    d.content.depth_mm = 30;
    d.content.viewing_distance_mm = 400;
    for (const LatticeKind lattice :
         {LatticeKind::square, LatticeKind::rectangle, LatticeKind::hexagon, LatticeKind::brick, LatticeKind::strips})
        for (const double turn_deg : {0., 8.}) {
            d.array.lattice = lattice;
            d.array.pitch_mm = lattice == LatticeKind::rectangle || lattice == LatticeKind::brick ? Pitch{4, 3} : Pitch{4};
            d.array.count.reset();
            const bool strips = lattice == LatticeKind::strips;
            d.array.rotation_deg = strips ? 0 : turn_deg;
            d.array.slant_deg.reset();
            if (strips) d.array.slant_deg = turn_deg;
            d.lens.kind = strips ? IdealLens{{}, 9.5} : IdealLens{1.5, 9.5};
            d.array.aperture = strips ? Aperture::cell : Aperture::circle;
            const Picture nodal = shoot(d, PickupKind::nodal), traced = shoot(d, PickupKind::traced);
            EXPECT_EQ(nodal.image.rgb, traced.image.rgb) << int(lattice) << " turned by " << turn_deg;
            EXPECT_EQ(nodal.rays, traced.rays);
            EXPECT_EQ(traced.dark, 0);
            EXPECT_GT(*std::max_element(nodal.image.rgb.begin(), nodal.image.rgb.end()), 0.5f);
        }
}

Display bent() {
    Display d = display();
    d.lens.kind = PlanoConvex{5.1, 1.9, 0.6, 1.52};
    d.content.depth_mm = 30;
    d.content.viewing_distance_mm = 400;
    return d;
}

// The way by columns and rows and the way of each pixel by itself, which a turn asks for, are one.
TEST_F(TracedPickup, ATurnTooSmallToSeeChangesNothing) {
    Display d = bent();
    const Picture straight = shoot(d, PickupKind::traced), nodal = shoot(d, PickupKind::nodal);
    d.array.rotation_deg = 1e-9;
    const Picture turned = shoot(d, PickupKind::traced);
    const auto differing = [&](const Picture& a, const Picture& b) {
        int count = 0;
        for (std::size_t k = 0; k < a.image.rgb.size(); k += 3)
            count += std::abs(a.image.rgb[k] - b.image.rgb[k]) + std::abs(a.image.rgb[k + 1] - b.image.rgb[k + 1]) > 1e-4f;
        return count;
    };
    EXPECT_LE(differing(straight, turned), 4);  // edges decided by rounding
    EXPECT_GT(differing(straight, nodal), 500);
}

TEST_F(TracedPickup, SameBitsOnAnyNumberOfThreads) {
    Display d = bent();
    d.content.pickup_rays = 5;
    for (const PickupKind pickup : {PickupKind::traced, PickupKind::integrated}) {
        const Picture one = shoot(d, pickup, 1), three = shoot(d, pickup, 3);
        EXPECT_EQ(one.image.rgb, three.image.rgb);
        EXPECT_EQ(one.rays, three.rays);
    }
}

// Integrated pixels are means: what fills the view stays as it is, and edges become slopes.
TEST_F(TracedPickup, IntegratedAveragesOverTheBundle) {
    Display d = bent();
    d.content.pickup_rays = 64;
    const Picture traced = shoot(d, PickupKind::traced), integrated = shoot(d, PickupKind::integrated);
    EXPECT_GT(integrated.rays, 50 * traced.rays);
    int same = 0, between = 0;
    double sum_traced = 0, sum_integrated = 0;
    for (std::size_t k = 0; k < traced.image.rgb.size(); k += 3) {
        const float a = traced.image.rgb[k], b = integrated.image.rgb[k];
        same += std::abs(a - b) < 1e-4f && a > 0.1f;
        between += b > 0.02f && b < 0.6f;
        sum_traced += double(a);
        sum_integrated += double(b);
    }
    EXPECT_GT(same, 500);
    EXPECT_GT(between, 500);
    EXPECT_NEAR(sum_integrated / sum_traced, 1, 0.04);
}

// Pixels at the border of a stopped lens's cell whose light meets the stop's rim from outside.
TEST_F(TracedPickup, PixelsWhoseLightNeverLeavesAreCountedAndBlack) {
    Display d = bent();
    d.lens.kind = PlanoConvex{5.1, 1.9, 0.6, 1.52, Facing::panel};
    d.lens.stop_radius_mm = 0.3;
    d.array.gap_mm = 6;
    const Geometry g = resolve(d);
    d.content.pickup = PickupKind::traced;
    const Pickup pickup(d, g);
    const LensMapping map(d, g, 550, 0, 1);
    const Picture picture = shoot(d, PickupKind::traced);
    std::int64_t dark = 0;
    for (int row = 0; row < 160; ++row)
        for (int column = 0; column < 240; ++column) {
            const NodalLine l = pickup.line(pickup.x_mm(column), pickup.y_mm(row));
            LineShift shift;
            if (!l.owned || map.shift(-1, pickup.x_mm(column) - l.x, pickup.y_mm(row) - l.y, shift)) continue;
            ++dark;
            EXPECT_EQ(picture.image.at(column, row)[0], 0);
        }
    EXPECT_EQ(picture.dark, dark);
    EXPECT_EQ(picture.rays + dark, 240 * 160);
}

}  // namespace
