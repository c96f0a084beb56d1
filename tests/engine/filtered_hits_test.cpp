// Pixels that find out by themselves what they see of each lens aim their rays at it: what they see of a white panel, each once a
// fault. Aimed beside the edges of holes rays are lost, and more of them the nearer to the edges many strata bring them.
#include <gtest/gtest.h>

#include "files/description/display_file.h"
#include "image/compare/compare.h"
#include "pictures.h"

namespace lfdsim {
namespace {

/// Of pictures of a white panel: brightness relative to that of points, and the error of each pixel.
void expect_white(Display d, std::initializer_list<std::int64_t> samples, double most_off, double most_rmse) {
    const Texels white = uniform_panel(d, 1);
    const auto with = [&](Estimator e, std::int64_t n) {
        d.render.estimator = e;
        d.render.samples = n;
        return picture(d, white);
    };
    const auto mean = [](const Image& a) {
        double sum = 0;
        for (const float x : a.rgb) sum += x;
        return sum / double(a.rgb.size());
    };
    const Image truth = with(Estimator::point, 1 << 12);
    EXPECT_GT(mean(truth), 0.05);
    for (const std::int64_t n : samples) {
        const Image filtered = with(Estimator::filtered, n);
        EXPECT_NEAR(mean(filtered) / mean(truth), 1, most_off) << n << " samples";
        EXPECT_LT(compare(filtered, truth).rmse, most_rmse) << n << " samples";
    }
}

/// Round holes without glass, 4 mm apart, in pictures whose pixels are coarse beside them.
Display coarse_holes() {
    Display d = ideal_example();
    d.array.aperture = Aperture::circle;
    d.lens.as<IdealLens>().aperture_radius_mm = 1.9;
    d.camera.resolution = {60, 40};
    return d;
}

TEST(FilteredHits, LightBesideStripsIsBlack) {
    Display d = in_lattice(example(), LatticeKind::strips);
    d.lens.as<PlanoConvex>().aperture_radius_mm = 1.5;
    d.array.aperture = Aperture::circle;
    d.array.slant_deg = 20;
    d.diffuser = Diffuser{20, {14, 11}, Profile::box};
    d.camera.resolution = {60, 40};
    expect_white(d, {16, 64}, 2e-3, 0.015);
}

TEST(FilteredHits, ObliqueViewsOfRoundHolesAreNotDarkened) {
    Display d = coarse_holes();
    d.array.rotation_deg = 5;
    d.diffuser = Diffuser{60, {4, 4}, Profile::box};
    d.camera.position_mm = {170, 80, 470};
    expect_white(d, {16, 400}, 1e-3, 0.01);
}

TEST(FilteredHits, PixelsMayLeapOnThePanel) {
    Display d = coarse_holes();
    d.panel.pixels = {240, 200};
    d.panel.pixel_pitch_mm = 0.0065;
    d.lens.as<IdealLens>().focal_length_mm = 1.67;
    d.lens.as<IdealLens>().aperture_radius_mm = 0.118;
    d.array.pitch_mm = 0.2366;
    d.array.gap_mm = 2.864;
    d.array.count = {6, 5};
    d.diffuser = Diffuser{0.82, {18, 18}, Profile::box};
    d.camera.position_mm = {0, 0, 30.23};
    d.camera.frame_width_mm = 2.4;
    expect_white(d, {4, 16, 64}, 0.012, 0.03);  // footprints of rows and columns: 4 to 5 % dark
}

TEST(FilteredHits, PixelsMayBeWiderThanAQuarterOfAHole) {
    Display d = coarse_holes();
    d.diffuser = Diffuser{1, {0.45, 0.45}, Profile::box};
    d.camera.pixel_filter = PixelFilter::box;
    expect_white(d, {1, 16, 100}, 1e-3, 0.02);  // by rays through pixels' centres: 0.17
}

TEST(FilteredHits, AWeakDiffuserLeavesEdgesSharp) {
    Display d = coarse_holes();
    d.array.rotation_deg = 5;
    for (const double angle : {0.45, 30.0}) {  // the second one spans a part of a pixel
        d.diffuser = Diffuser{1, {angle, angle}, Profile::box};
        expect_white(d, {16, 64}, 2e-3, 0.02);
    }
}

TEST(FilteredHits, LensesTiltAboutTheirVertices) {
    Display d = example();
    d.camera.resolution = {60, 40};
    d.diffuser = Diffuser{40, {5.7, 5.7}, Profile::box};
    d.errors.tilt_sd_deg = 1;
    expect_white(d, {64, 400}, 2e-3, 0.01);
}

TEST(FilteredHits, BlocksMayBeWideBesideTheDiffusersHeight) {
    Display d = ideal_example();
    d.panel.pixels = {734, 626};
    d.panel.pixel_pitch_mm = 0.713;
    d.lens.as<IdealLens>().focal_length_mm = 37;
    d.lens.as<IdealLens>().aperture_radius_mm = 3.4;
    d.array.aperture = Aperture::circle;
    d.array.pitch_mm = 19.36;
    d.array.gap_mm = 37.55;
    d.array.count = {27, 23};
    d.diffuser = Diffuser{40.2, {28, 12.7}, Profile::box};
    d.camera.position_mm = {0, 0, 1154};
    for (const std::int64_t columns : {96, 240}) {
        d.camera.resolution = {columns, columns * 2 / 3};
        d.camera.frame_width_mm = columns == 96 ? 700 : 400;
        expect_white(d, {4, 36}, columns == 96 ? 0.035 : 5e-3, 0.015);  // by the rays of one side: 2 to 10 % dark
    }
}

TEST(FilteredHits, GapsOfThePanelAlongLeaningStrips) {
    Display d = read_display(LFDSIM_SOURCE_DIR "/displays/tablet-lenticular.toml");
    d.camera.resolution = {60, 40};
    for (const double width : {7.0, 35.0}) {  // mm: pixels of 1.4 and 7 panel pixels
        d.camera.frame_width_mm = width;
        expect_white(d, {4, 25}, 6e-3, width > 10 ? 0.07 : 0.035);  // of two boxes in line: 2 and 5 % dark
    }
}

TEST(FilteredHits, WeakDiffusersSeenFromAnyAngle) {
    Display d = read_display(LFDSIM_SOURCE_DIR "/displays/hexagon.toml");
    d.camera.position_mm = {404, 404, 700};  // 30 degrees to the right and above
    d.camera.resolution = {48, 32};
    d.camera.frame_width_mm = 8.9;
    expect_white(d, {36, 100}, 4e-3, 0.045);  // random rays: 0.08
    d.camera.pixel_filter = PixelFilter::center;
    d.camera.pupil_diameter_mm.reset();
    expect_white(d, {4}, 4e-3, 0.07);  // as if the diffuser's two turns were independent, or random rays: 0.12
    expect_white(d, {36}, 2e-3, 0.016);
}

}  // namespace
}  // namespace lfdsim
