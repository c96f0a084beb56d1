// Elemental images of patches whose places are known.
#include "content/pickup/pickup.h"
#include "small_world.h"

#include <atomic>

namespace {

using namespace small_world;

Picture shoot(const Display& d, const fs::path& model, int threads = 0) {
    Job job;
    const Geometry g = resolve(d);
    return elemental_images(d, g, ContentScene(load_model(model), d, g), threads, job);
}

// Every pixel of a patch at a depth, from the nodal line alone. Pixels within 1e-3 mm of the patch's border are left out:
// there the rounding of the ray tracer's single precision decides.
void expect_patch(const Display& d, const Picture& picture, double half_width, double half_height, double z) {
    const Pickup pickup(d, resolve(d));
    int inside_count = 0, outside_count = 0;
    for (int row = 0; row < picture.image.height; ++row) {
        for (int column = 0; column < picture.image.width; ++column) {
            const NodalLine l = pickup.line(pickup.x_mm(column), pickup.y_mm(row));
            const double x = std::abs(l.x + l.mx * (z - pickup.z_rear)) - half_width,
                         y = std::abs(l.y + l.my * (z - pickup.z_rear)) - half_height;
            if (std::abs(x) < 1e-3 || std::abs(y) < 1e-3) continue;
            const bool inside = l.owned && x < 0 && y < 0;
            ++(inside ? inside_count : outside_count);
            ASSERT_NEAR(picture.image.at(column, row)[0], inside ? facing_light : 0, 1e-6) << column << ", " << row;
        }
    }
    EXPECT_GT(inside_count, 1000);
    EXPECT_GT(outside_count, 1000);
}

TEST(ElementalImages, PatchAtSeveralDepthsAndViewingDistances) {
    Folder folder;
    const fs::path model = write_patches(folder, {{-8, 8, -10, 10, 0, "white"}});
    for (const double depth : {-60., 0., 25., 190.}) {
        for (const double distance : {400., std::numeric_limits<double>::infinity()}) {
            SCOPED_TRACE(testing::Message() << "depth " << depth << " mm, seen from " << distance << " mm");
            Display d = display();
            d.content.depth_mm = depth;
            d.content.viewing_distance_mm = distance;
            expect_patch(d, shoot(d, model), 8, 10, resolve(d).vertex_plane_mm + depth);
        }
    }
}

TEST(ElementalImages, TurnedAndMovedArray) {
    Folder folder;
    const fs::path model = write_patches(folder, {{-8, 8, -10, 10, 0, "white"}});
    Display d = display();
    d.array.rotation_deg = 17;
    d.array.offset_mm = {1.5, -0.7};
    d.content.depth_mm = 40;
    const Picture picture = shoot(d, model);
    expect_patch(d, picture, 8, 10, resolve(d).vertex_plane_mm + 40);
    EXPECT_LT(picture.rays, 240 * 160);  // the panel's corners belong to no lens
}

// The viewer's first surface is seen: in front of the lenses the nearest to the viewer, and any of those before whatever
// stands behind the lens plane; through a gap in the front one the next is seen.
TEST(ElementalImages, SceneAcrossTheLensPlane) {
    Folder folder;
    // Before the lenses a green left half stands behind a red upper half; behind them all, blue. Box: z -30 .. 30.
    const fs::path model =
        write_patches(folder, {{-10, 10, -10, 10, -30, "blue"}, {-10, 0, -10, 10, 15, "green"}, {-10, 10, 0, 10, 30, "red"}});
    Display d = display();
    const Geometry g = resolve(d);
    const Picture picture = shoot(d, model);
    const Pickup pickup(d, g);
    std::array<int, 4> seen{};
    for (int row = 0; row < picture.image.height; ++row) {
        for (int column = 0; column < picture.image.width; ++column) {
            const NodalLine l = pickup.line(pickup.x_mm(column), pickup.y_mm(row));
            const auto within = [&](double z, double x0, double x1, double y0, double y1, bool& unsure) {
                const double h = g.vertex_plane_mm + z - pickup.z_rear, x = l.x + h * l.mx, y = l.y + h * l.my;
                for (const double edge : {x - x0, x - x1, y - y0, y - y1}) unsure = unsure || std::abs(edge) < 1e-3;
                return x > x0 && x < x1 && y > y0 && y < y1;
            };
            bool unsure = false;
            const bool red = within(30, -10, 10, 0, 10, unsure), green = within(15, -10, 0, -10, 10, unsure),
                       blue = within(-30, -10, 10, -10, 10, unsure);
            if (unsure) continue;
            const int first = red ? 0 : green ? 1 : blue ? 2 : 3;
            ++seen[std::size_t(first)];
            for (int c = 0; c < 3; ++c) ASSERT_NEAR(picture.image.at(column, row)[c], c == first ? facing_light : 0, 1e-6);
        }
    }
    for (const int count : seen) EXPECT_GT(count, 500);
}

// The whole depth counts: what stands behind the panel is seen too.
TEST(ElementalImages, SceneBehindThePanel) {
    Folder folder;
    Display d = display();
    d.content.depth_mm = -200;
    d.content.height_mm = 24;
    const Picture picture = shoot(d, write_patches(folder, {{-12, 12, -12, 12, 0, "white"}}));
    expect_patch(d, picture, 12, 12, resolve(d).vertex_plane_mm - 200);
}

TEST(ElementalImages, RaysAreThePixelsWithAnOwner) {
    Folder folder;
    Display d = display();
    d.array.count = {10, 8};
    EXPECT_EQ(shoot(d, write_patches(folder, {{-1, 1, -1, 1, 0, "white"}})).rays, 10 * 8 * 400);
}

TEST(ElementalImages, SameBitsOnAnyNumberOfThreads) {
    Folder folder;
    const fs::path model =
        write_patches(folder, {{-8, 8, -10, 10, 3, "white"}, {-5, 9, -9, 4, 20, "red"}, {-8, 8, -10, 10, 3, "green"}});
    Display d = display();
    d.content.yaw_deg = 33;
    d.content.tilt_deg = 20;
    const Picture one = shoot(d, model, 1), four = shoot(d, model, 4);
    EXPECT_EQ(one.rays, four.rays);
    EXPECT_EQ(one.image.rgb, four.image.rgb);
}

struct StopAfter : Job {
    explicit StopAfter(std::int64_t limit) : most(limit) {}
    void stage(std::string_view, std::int64_t units) override { total = units; }
    void advance(std::int64_t units) override { done += units; }
    bool cancelled() const override { return done >= most; }
    std::int64_t most, total = 0;
    std::atomic<std::int64_t> done{0};
};

TEST(ElementalImages, StopsWhenAskedAndSaysSo) {
    Folder folder;
    const Display d = display();
    const Geometry g = resolve(d);
    const ContentScene scene(load_model(write_patches(folder, {{-10, 10, -10, 10, 0, "white"}})), d, g);
    StopAfter stop(2), run(1000);
    const Picture stopped = elemental_images(d, g, scene, 1, stop);
    EXPECT_FALSE(stopped.complete);
    EXPECT_EQ(stop.done, 2);
    EXPECT_EQ(stopped.rays, 2 * 64 * 64);
    const Picture whole = elemental_images(d, g, scene, 1, run);
    EXPECT_TRUE(whole.complete);
    EXPECT_EQ(run.done, run.total);
}

TEST(ElementalImages, BadThreadCountIsAnError) {
    Folder folder;
    const Display d = display();
    EXPECT_THROW(shoot(d, write_patches(folder, {{-1, 1, -1, 1, 0, "white"}}), -1), InputError);
}

}  // namespace
