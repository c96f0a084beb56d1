// Light along rays from grids of views whose pictures have a closed form.
#include "content/pictures/light_field.h"

#include "base/constants.h"
#include "content/pickup/pickup.h"
#include "content/pictures/field_picture.h"
#include "content/pictures/view_order.h"
#include "small_world.h"

#include <cmath>
#include <functional>
#include <random>

namespace {

using namespace small_world;
using Line = LightField::FieldLine;
using Answer = LightField::Answer;

constexpr LightField::Width thin{0, 0};

ViewGrid grid_of(int columns, int rows, double step = 20, double distance = 400) {
    return {columns, rows, camera_places(even_places(columns, step), even_places(rows, -1.5 * step)), distance, 60, 40, 0};
}

/// Light of the point of the plane `height` over the focus that a line from a camera (c) through the focus (x, y) meets.
using Light = std::function<double(double x, double y)>;
Image view_of(const ViewGrid& grid, std::size_t k, int width, int height, double z, const Light& light) {
    Image image(width, height);
    const auto& [cx, cy] = grid.camera_mm[k];
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i) {
            const double x = ((i + 0.5) / width - 0.5) * grid.width_mm, y = (0.5 - (j + 0.5) / height) * grid.height_mm;
            const double share = z / grid.distance_mm;
            const double value = light(x + (cx - x) * share, y + (cy - y) * share);
            for (int c = 0; c < 3; ++c) image.at(i, j)[c] = float(value);
        }
    return image;
}
std::vector<Image> views_of(const ViewGrid& grid, int width, int height, double z, const Light& light) {
    std::vector<Image> views;
    for (std::size_t k = 0; k < grid.views(); ++k) views.push_back(view_of(grid, k, width, height, z, light));
    return views;
}
std::vector<KappaMap> maps_of(const ViewGrid& grid, int width, int height, double z) {
    const float kappa = float(z / (grid.distance_mm - z));
    return std::vector<KappaMap>(grid.views(), KappaMap{width, height, std::vector<float>(std::size_t(width * height), kappa)});
}

double linear(double x, double y) { return 0.5 + 0.004 * x - 0.006 * y; }

// Of light that is linear over a plane, at whatever depth, bilinear means over pixels and over cameras are exact.
TEST(LightField, LinearLightIsExactAtAnyDepthAndOnUnevenGrids) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-1, 1);
    for (const double z : {-150., 0., 90.})
        for (const bool uneven : {false, true}) {
            ViewGrid grid = grid_of(5, 4);
            if (uneven)
                for (auto& at : grid.camera_mm) at = {at[0] + 4 * any(random), at[1] + 4 * any(random)};
            const LightField field(grid, views_of(grid, 90, 60, z, linear));
            for (int n = 0; n < 2000; ++n) {
                const double x = 27 * any(random), y = 18 * any(random), cx = 35 * any(random), cy = 40 * any(random);
                float light[3];
                ASSERT_EQ(field.light(Line{float(x), float(y), float(cx), float(cy)}, thin, light), Answer::seen);
                const double share = z / grid.distance_mm;
                ASSERT_NEAR(double(light[1]), linear(x + (cx - x) * share, y + (cy - y) * share), 2e-6)
                    << x << " " << y << " " << z;
            }
        }
}

// The same through the pick-up: every panel pixel has the light of the point that its nodal line meets.
TEST(LightField, ElementalImagesShowThePointOfTheNodalLine) {
    Display d = display();
    d.content.viewing_distance_mm = 420;
    const Geometry g = resolve(d);
    for (const double z : {-30., 25.}) {
        ViewGrid grid = grid_of(9, 9, 30);
        grid.depth_mm = 8;
        const LightField field(grid, views_of(grid, 240, 160, z, linear));
        Job job;
        const FieldPicture made = elemental_images(d, g, field, 1, job), again = elemental_images(d, g, field, 3, job);
        EXPECT_EQ(made.picture.image.rgb, again.picture.image.rgb);
        const Pickup pickup(d, g);
        const double focus = g.vertex_plane_mm + grid.depth_mm, plane = focus + z;
        std::int64_t beside_cameras = 0, beside_focus = 0, seen = 0;
        for (int row = 0; row < 160; ++row)
            for (int column = 0; column < 240; ++column) {
                const NodalLine l = pickup.line(pickup.x_mm(column), pickup.y_mm(row));
                if (!l.owned) continue;
                const auto at = [&](double height) {
                    return std::array{l.x + l.mx * (height - pickup.z_rear), l.y + l.my * (height - pickup.z_rear)};
                };
                const auto [x, y] = at(focus);
                const auto [cx, cy] = at(focus + grid.distance_mm);
                const auto [px, py] = at(plane);
                const double out = std::max(std::abs(cx) - 4.5 * 30, std::abs(cy) - 4.5 * 45),
                             off = std::max(std::abs(x) - 30, std::abs(y) - 20);
                if (std::abs(out) < 1e-3 || std::abs(off) < 1e-3) continue;
                beside_cameras += out > 0;
                beside_focus += out < 0 && off > 0;
                const bool clamped = std::abs(cx) > 120 || std::abs(cy) > 180 || std::abs(x) > 29.5 || std::abs(y) > 19.5;
                if (out > 0 || off > 0) {
                    ASSERT_EQ(made.picture.image.at(column, row)[0], 0);
                } else if (!clamped) {
                    ++seen;
                    ASSERT_NEAR(double(made.picture.image.at(column, row)[0]), linear(px, py), 1e-5) << column << ", " << row;
                }
            }
        EXPECT_EQ(made.beside_cameras, beside_cameras);
        EXPECT_EQ(made.beside_focus, beside_focus);
        EXPECT_GT(seen, 10000);
    }
}

TEST(LightField, BesideTheCamerasTheOutermostStandForHalfAStep) {
    const ViewGrid grid = grid_of(3, 2);  // x -20, 0, 20; y 15, -15
    const LightField field(grid, views_of(grid, 30, 20, 100, linear));
    float light[3], edge[3];
    ASSERT_EQ(field.light({0, 0, 20, 0}, thin, edge), Answer::seen);
    EXPECT_EQ(field.light({0, 0, 29.99f, 0}, thin, light), Answer::seen);
    EXPECT_EQ(light[0], edge[0]);  // the nearest view
    for (const Line& line : {Line{0, 0, 30.01f, 0}, Line{0, 0, -30.01f, 0}, Line{0, 0, 0, 30.01f}, Line{0, 0, 0, -30.01f}}) {
        EXPECT_EQ(field.light(line, thin, light), Answer::beside_cameras);
        EXPECT_EQ(light[0], 0);
    }
    EXPECT_EQ(field.light({30.01f, 0, 0, 0}, thin, light), Answer::beside_focus);
    EXPECT_EQ(field.light({29.99f, 0, 0, 0}, thin, light), Answer::seen);
}

TEST(LightField, ARowHasParallaxAlongItselfOnly) {
    const ViewGrid grid = grid_of(7, 1);
    const LightField field(grid, views_of(grid, 90, 60, 100, linear));
    float level[3], above[3];
    ASSERT_EQ(field.light({3, 5, 11, 0}, thin, level), Answer::seen);
    ASSERT_EQ(field.light({3, 5, 11, 5000}, thin, above), Answer::seen);
    EXPECT_EQ(level[0], above[0]);
    EXPECT_NEAR(double(level[0]), linear(3 + (11 - 3) * 0.25, 5 + (0 - 5) * 0.25), 1e-6);
}

// By depth a picture with detail is read where the line meets the plane; without, four ghosts of it are mixed.
TEST(LightField, DepthFindsThePlane) {
    const auto waves = [](double x, double y) { return 0.5 + 0.25 * std::sin(0.9 * x) + 0.2 * std::cos(0.8 * y); };
    const ViewGrid grid = grid_of(4, 3);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> any(-1, 1);
    for (const double z : {-200., 120.}) {
        const std::vector<Image> views = views_of(grid, 600, 400, z, waves);
        const LightField flat(grid, views), deep(grid, views, maps_of(grid, 150, 100, z));
        std::vector<KappaMap> one = maps_of(grid, 150, 100, z);
        for (std::size_t k = 0; k < one.size(); ++k)
            if (k != 5) one[k] = {};
        const LightField by_one(grid, views, one);
        double worst = 0, worst_one = 0, worst_flat = 0;
        for (int n = 0; n < 3000; ++n) {
            const Line line{float(15 * any(random)), float(10 * any(random)), float(30 * any(random)), float(30 * any(random))};
            const double share = z / grid.distance_mm,
                         expected = waves(double(line.focus_x) + double(line.camera_x - line.focus_x) * share,
                                          double(line.focus_y) + double(line.camera_y - line.focus_y) * share);
            const auto error = [&](const LightField& field) {
                float light[3];
                EXPECT_EQ(field.light(line, thin, light), Answer::seen);
                return std::abs(double(light[0]) - expected);
            };
            worst = std::max(worst, error(deep));
            worst_one = std::max(worst_one, error(by_one));
            worst_flat = std::max(worst_flat, error(flat));
        }
        // Bilinear in pixels of 0.1 mm at the focus: (0.1 mm)^2 / 8 of the second derivatives, at most doubled by the plane's
        // depth.
        EXPECT_LT(worst, 2.5 * 0.01 / 8 * (0.25 * 0.81 + 0.2 * 0.64) * 4);
        EXPECT_LT(worst_one, 2.5 * 0.01 / 8 * (0.25 * 0.81 + 0.2 * 0.64) * 4);
        EXPECT_GT(worst_flat, 0.3);
    }
}

// A square before a wall: a line that meets it shows it, however the cameras around the line see past its edges.
TEST(LightField, DepthKnowsWhatHidesWhat) {
    const ViewGrid grid = grid_of(3, 3, 40);
    const double near = 60, far = -120, side = 8;
    const int width = 480, height = 320;
    std::vector<Image> views;
    std::vector<KappaMap> maps;
    for (const auto& [cx, cy] : grid.camera_mm) {
        Image view(width, height);
        KappaMap map{width, height, std::vector<float>(std::size_t(width * height))};
        for (int j = 0; j < height; ++j)
            for (int i = 0; i < width; ++i) {
                const double x = ((i + 0.5) / width - 0.5) * grid.width_mm, y = (0.5 - (j + 0.5) / height) * grid.height_mm;
                const double share = near / grid.distance_mm;
                const bool front = std::abs(x + (cx - x) * share) < side && std::abs(y + (cy - y) * share) < side;
                view.at(i, j)[front ? 0 : 2] = 1;
                const double z = front ? near : far;
                map.kappa[std::size_t(j * width + i)] = float(z / (grid.distance_mm - z));
            }
        views.push_back(std::move(view));
        maps.push_back(std::move(map));
    }
    const LightField field(grid, std::move(views), std::move(maps));
    std::mt19937 random(3);
    std::uniform_real_distribution<double> any(-1, 1);
    int fronts = 0, backs = 0, wrong = 0;
    for (int n = 0; n < 20000; ++n) {
        const double x = 14 * any(random), y = 5 * any(random), cx = 40 * any(random), cy = 60 * any(random);
        const double share = near / grid.distance_mm, px = x + (cx - x) * share, py = y + (cy - y) * share;
        if (std::min(std::abs(std::abs(px) - side), std::abs(std::abs(py) - side)) < 0.3) continue;  // two pixels of the edge
        const bool front = std::abs(px) < side && std::abs(py) < side;
        float light[3];
        ASSERT_EQ(field.light({float(x), float(y), float(cx), float(cy)}, thin, light), Answer::seen);
        (front ? fronts : backs)++;
        wrong += std::abs(light[0] - float(front)) > 0.02f;
    }
    EXPECT_GT(fronts, 2000);
    EXPECT_GT(backs, 2000);
    EXPECT_LE(wrong, (fronts + backs) / 500);
}

// Detail that is finer than a line's width becomes its mean, not noise.
TEST(LightField, FineDetailIsAveraged) {
    const ViewGrid grid = grid_of(1, 1);
    Image chequered(512, 512);
    for (int j = 0; j < 512; ++j)
        for (int i = 0; i < 512; ++i)
            for (int c = 0; c < 3; ++c) chequered.at(i, j)[c] = float((i + j) % 2);
    const LightField field(grid, {chequered});
    float light[3];
    float least = 1, most = 0;
    for (int n = 0; n < 50; ++n) {
        // A line 8 pixels wide at the focus: 0.01 for each mm from a waist 60/512*8*100 mm below.
        ASSERT_EQ(field.light({float(0.37 * n - 9), float(0.21 * n - 5), 0, 0}, {0.01f, float(60. / 512 * 8 * 100)}, light),
                  Answer::seen);
        least = std::min(least, light[0]);
        most = std::max(most, light[0]);
    }
    EXPECT_NEAR(least, 0.5, 1e-6);
    EXPECT_NEAR(most, 0.5, 1e-6);
}

TEST(LightField, RefusesWhatDoesNotFit) {
    const ViewGrid grid = grid_of(2, 1);
    EXPECT_THROW(LightField(grid, {Image(4, 4)}), InputError);
    EXPECT_THROW(LightField(grid, {Image(4, 4), Image(4, 5)}), InputError);
    EXPECT_THROW(LightField(grid, {Image(4, 4), Image(4, 4)}, {KappaMap{}}), InputError);
    ViewGrid crossed = grid;
    std::swap(crossed.camera_mm[0], crossed.camera_mm[1]);
    EXPECT_THROW(LightField(crossed, {Image(4, 4), Image(4, 4)}), InputError);
    ViewGrid absurd = grid_of(2, 1, 1e5);
    EXPECT_THROW(LightField(absurd, {Image(4, 4), Image(4, 4)}), InputError);
}

// What a view shows is what a camera there photographs, and its depth the distance of the patch's plane.
TEST(SceneViews, AreTheMiddlePartOfAPhotograph) {
    Folder folder;
    const ContentParts parts{load_model(write_patches(folder, {{-8, 8, -10, 10, 0, "white"}, {-2, 6, -6, 3, 7, "red"}}))};
    Display d = display();
    d.content.depth_mm = 30;
    const Geometry g = resolve(d);
    const ContentScene scene(parts, d, g);
    ViewGrid grid{3, 1, camera_places({-50, 0, 50}, {0}), 400, 48, 32, 12};
    Job job;
    const Picture view = scene_view(scene, g, grid, 1, 0, {240, 160, 1}, job);
    d.camera.position_mm = {0, 0, g.vertex_plane_mm + 12 + 400};
    d.camera.target_mm = {0, 0, g.vertex_plane_mm + 12};
    d.camera.frame_width_mm = 48;
    d.camera.resolution = {240, 160};
    const Picture photo = reference_photograph(d, resolve(d), scene, 0, {}, job);
    int differ = 0;
    for (std::size_t i = 0; i < photo.image.rgb.size(); ++i) differ += std::abs(photo.image.rgb[i] - view.image.rgb[i]) > 1e-6f;
    EXPECT_LE(differ, 30);  // on edges
    EXPECT_GT(*std::max_element(view.image.rgb.begin(), view.image.rgb.end()), 0.5f);

    // From aside a point moves by -kappa for each mm of the camera's.
    const Picture depth = scene_view_depth(scene, g, grid, 0, 0, {240, 160, 1}, job);
    const double front = 30 + 7. * 20 / 20 - 3.5, back = 30 - 3.5;  // 20 mm high as in its file; its box's middle is at 30
    for (const auto& [x, y, z] : {std::array{2., -1., front}, {-6., 8., back}}) {
        const double share = 400. / (412 - z), fx = -50 + (x + 50) * share, fy = y * share;
        const int column = int((fx / 48 + 0.5) * 240), row = int((0.5 - fy / 32) * 160);
        EXPECT_NEAR(depth.image.at(column, row)[0], 412 - z, 1e-3);
    }
    EXPECT_EQ(depth.image.at(0, 0)[0], 0);
}

// From views with depth maps the elemental images are those of the mesh, but at edges.
TEST(SceneViews, ReadBackTheyShowTheScene) {
    Folder folder;
    const ContentParts parts{load_model(write_patches(folder, {{-8, 8, -10, 10, 0, "white"}, {-2, 6, -6, 3, 7, "red"}}))};
    Display d = display();
    d.content.depth_mm = 20;
    const Geometry g = resolve(d);
    const ContentScene scene(parts, d, g);
    ViewGrid grid{5, 5, camera_places(even_places(5, 60), even_places(5, -60)), 480, 60, 44, 20};
    Job job;
    std::vector<Image> views;
    std::vector<KappaMap> maps;
    for (int row = 0; row < 5; ++row)
        for (int column = 0; column < 5; ++column) {
            const ViewMaking making{480, 352, 4};
            views.push_back(scene_view(scene, g, grid, column, row, making, job).image);
            const Image depth = scene_view_depth(scene, g, grid, column, row, making, job).image;
            KappaMap map{480, 352, {}};
            for (std::size_t i = 0; i < depth.rgb.size(); i += 3)
                map.kappa.push_back(depth.rgb[i] > 0 ? float(480 / double(depth.rgb[i]) - 1)
                                                     : std::numeric_limits<float>::infinity());
            maps.push_back(std::move(map));
        }
    const FieldPicture made = elemental_images(d, g, LightField(grid, views, maps), 0, job);
    const Picture truth = elemental_images(d, g, scene, 0, job);
    EXPECT_EQ(made.beside_cameras, 0);
    // A pixel from an edge, whose picture in the views is as wide as a ray, they are the same.
    int same_around = 0, differ = 0;
    for (int row = 2; row < 158; ++row)
        for (int column = 2; column < 238; ++column) {
            const float* const at = truth.image.at(column, row);
            bool uniform = at[0] > 0;
            for (int k = 0; k < 25; ++k) {
                const float* const near = truth.image.at(column - 2 + k % 5, row - 2 + k / 5);
                uniform = uniform && near[0] == at[0] && near[1] == at[1];
            }
            if (!uniform) continue;
            ++same_around;
            for (int c = 0; c < 3; ++c) differ += std::abs(made.picture.image.at(column, row)[c] - at[c]) > 0.01f;
        }
    EXPECT_GT(same_around, 2000);
    EXPECT_LE(differ, same_around / 500);
}

// The order of views is doubted where it is surely wrong, and not where nothing can be told.
TEST(ViewOrder, IsDoubtedWhereMovesSaySo) {
    std::mt19937 random(5);
    std::vector<double> noise(64 * 64);
    for (double& value : noise) value = std::uniform_real_distribution<double>(0, 1)(random);
    const auto texture = [&](double x, double y) {  // random values 2 mm apart, bilinear between them
        const double u = x / 2 + 32, v = y / 2 + 32;
        const int i = int(std::floor(u)), j = int(std::floor(v));
        const auto at = [&](int a, int b) { return noise[std::size_t((b & 63) * 64 + (a & 63))]; };
        const double s = u - i, t = v - j;
        return (1 - t) * ((1 - s) * at(i, j) + s * at(i + 1, j)) + t * ((1 - s) * at(i, j + 1) + s * at(i + 1, j + 1));
    };
    for (const double z : {-60., 45.}) {
        const ViewGrid grid = grid_of(3, 3, 8);
        const std::vector<Image> views = views_of(grid, 240, 160, z, texture);
        const std::vector<KappaMap> maps = maps_of(grid, 240, 160, z);
        const auto doubt = [&](std::vector<Image> pictures, const std::vector<KappaMap>& depth) {
            return order_doubt(grid, pictures, depth);
        };
        EXPECT_FALSE(doubt(views, maps).axes_disagree);
        EXPECT_FALSE(doubt(views, maps).against_depth);
        const std::vector<Image> reversed(views.rbegin(), views.rend());
        EXPECT_FALSE(doubt(reversed, {}).axes_disagree);  // a scene behind its mirror image looks the same
        EXPECT_FALSE(doubt(reversed, {}).against_depth);
        EXPECT_TRUE(doubt(reversed, maps).against_depth);
        std::vector<Image> rows_reversed;
        for (int j = 2; j >= 0; --j)
            for (int i = 0; i < 3; ++i) rows_reversed.push_back(views[std::size_t(j * 3 + i)]);
        EXPECT_TRUE(doubt(rows_reversed, {}).axes_disagree);
        // Nothing moves, or nothing is to be seen.
        EXPECT_FALSE(doubt(views_of(grid, 240, 160, 0, texture), maps).against_depth);
        EXPECT_FALSE(doubt(std::vector<Image>(9, Image(240, 160)), maps).against_depth);
        // Noise that is another one in each view.
        std::vector<Image> noisy(9, Image(240, 160));
        for (Image& picture : noisy)
            for (float& value : picture.rgb) value = std::uniform_real_distribution<float>(0, 1)(random);
        EXPECT_FALSE(doubt(noisy, maps).against_depth || doubt(noisy, maps).axes_disagree);
    }
}

}  // namespace
