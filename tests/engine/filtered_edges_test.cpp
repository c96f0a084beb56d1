// Edges of the filtered estimator, each once a fault: diffusers that hardly turn a ray or turn it past the horizontal, places that
// no 32-bit number holds, an error told from equal pictures, and one that is never reached.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cmath>

#include "engine/scene/traced_display.h"
#include "image/compare/compare.h"
#include "pictures.h"

namespace lfdsim {
namespace {

double mean(const Image& a) {
    double sum = 0;
    for (const float x : a.rgb) sum += x;
    return sum / double(a.rgb.size());
}

/// Round holes without glass.
Display round_ideal() {
    Display d = ideal_example();
    d.array.aperture = Aperture::circle;
    d.lens.as<IdealLens>().aperture_radius_mm = 2;
    d.render.estimator = Estimator::filtered;
    d.render.samples = 100;
    return d;
}

void expect_brute_force(Display d, const Texels& panel, double tolerance) {
    const double filtered = mean(picture(d, panel));
    d.render.estimator = Estimator::point;
    const double truth = mean(picture(d, panel));
    EXPECT_GT(truth, 0.05);
    EXPECT_NEAR(filtered / truth, 1, tolerance)
        << d.diffuser->angle_deg[0] << " x " << d.diffuser->angle_deg[1] << " degrees, " << d.diffuser->distance_mm << " mm";
}

TEST(FilteredEdges, ADiffuserMayTurnRaysAlongOneAxisOrNone) {
    for (const std::array<double, 2>& angles : {std::array{0.0, 0.0}, {0.0, 5.7}, {5.7, 0.0}, {1e-5, 0.0}, {1e-3, 1e-3}}) {
        for (const double distance : {40.0, 1e-6}) {
            Display d = round_ideal();
            d.diffuser = Diffuser{distance, angles, Profile::box};
            expect_brute_force(d, noise_panel(d), 3e-3);
        }
    }
}

TEST(FilteredEdges, APixelOnTheAxisOfALensSeesAllOfItsLight) {
    Display d = round_ideal();
    d.array.count = {1, 1};
    d.camera.resolution = {1, 1};
    for (const double angle : {0.0, 1e-4}) {
        d.diffuser = Diffuser{10, {angle, angle}, Profile::box};
        d.render.samples = 1;
        EXPECT_NEAR(mean(picture(d, uniform_panel(d, 1))), 1, 1e-6) << angle;
    }
}

TEST(FilteredEdges, RaysTurnedPastTheHorizontalAreLost) {
    for (const Profile profile : {Profile::box, Profile::gaussian}) {
        Display d = ideal_example();
        d.render.estimator = Estimator::filtered;
        d.render.samples = 1024;
        d.camera.resolution = {40, 28};
        look_from(d, 5, 400);
        d.diffuser = Diffuser{10, {179, 0}, profile};
        expect_brute_force(d, uniform_panel(d, 1), 0.01);
    }
}

TEST(FilteredEdges, AnArrayMayStandFarBesideAFinePanel) {
    Display d = round_ideal();
    d.panel.pixel_pitch_mm = 1e-6;
    d.array.offset_mm = {1e6, -1e6};
    d.camera.position_mm = {1e6, -1e6, 400};
    d.camera.target_mm = {1e6, -1e6, 0};
    d.diffuser = Diffuser{40, {5.7, 5.7}, Profile::box};
    EXPECT_EQ(mean(picture(d, uniform_panel(d, 1))), 0);
    d.render.estimator = Estimator::point;
    EXPECT_EQ(mean(picture(d, uniform_panel(d, 1))), 0);
}

TEST(FilteredEdges, TheErrorIsToldWhereAllCutsLieOnBordersOfLenses) {
    for (const double borders : {1.0, 1.5, 2.0, 3.0, 3.5}) {
        Display d = example();
        const double angle = 2 * std::atan(borders * 2 / 41.0) / degree;
        d.diffuser = Diffuser{40, {angle, angle}, Profile::box};
        d.camera.frame_width_mm = 8;
        d.render.samples = 1 << 12;
        const Texels panel = noise_panel(d);
        const RenderOptions part{0, "", Rect{48, 32, 96, 64}};
        const Image truth = picture(d, panel, part);
        d.render.estimator = Estimator::filtered;
        d.render.samples.reset();
        RenderOptions options = part;
        options.target_error = 0.02;
        Job job;
        const Rendering r = render(d, resolve(d), panel, options, job);
        double said = 0, true_error = 0;
        for (std::size_t i = 0; i < truth.rgb.size(); ++i) {
            said += double(r.error.rgb[i]) * r.error.rgb[i];
            true_error += (double(r.image.rgb[i]) - truth.rgb[i]) * (double(r.image.rgb[i]) - truth.rgb[i]);
        }
        EXPECT_LT(std::sqrt(true_error), 1.4 * std::sqrt(said)) << borders;
    }
}

TEST(FilteredEdges, AnErrorThatIsNeverReachedMayBeCancelled) {
    struct Impatient : Job {
        bool cancelled() const override { return ++asked > 20; }
        mutable std::atomic<int> asked{0};
    };
    for (const Estimator estimator : {Estimator::filtered, Estimator::point}) {
        Display d = round_ideal();
        d.diffuser = Diffuser{40, {5.7, 5.7}, Profile::box};
        d.render.estimator = estimator;
        RenderOptions options{1, "", Rect{0, 0, 64, 16}};  // a single tile
        options.target_error = 1e-30;
        Impatient job;
        const Rendering r = render(d, resolve(d), noise_panel(d), options, job);
        EXPECT_FALSE(r.complete);
        EXPECT_LT(job.asked, 30);
    }
}

// Where a pixel sees a quarter of a lens and a block is half as wide as that, each pixel sees another part of the outermost strata.
TEST(FilteredEdges, EndsOfTheDiffusersSquareMoveWithThePixels) {
    Display d;
    d.panel.pixels = {88, 48};
    d.panel.pixel_pitch_mm = 0.5;
    d.lens.kind = PlanoConvex{2.6, 1.9, 1, 1.4918, Facing::viewer};
    d.array.count = {11, 6};
    d.array.pitch_mm = 4;
    d.array.gap_mm = 5;
    d.diffuser = Diffuser{40, {1.5, 1}, Profile::box};
    d.camera.position_mm = {0, 0, 400};
    d.camera.frame_width_mm = 46;
    d.camera.resolution = {480, 270};
    Image light(88, 48);  // squares of 4 x 4 pixels, each of some light
    Random random(2);
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 88; ++x)
            for (int c = 0; c < 3; ++c)
                light.at(x, y)[c] = x % 4 || y % 4 ? light.at(x / 4 * 4, y / 4 * 4)[c] : float(random(0.02, 0.8));
    const Texels panel = make_texels(light);
    RenderOptions crop;
    crop.crop = Rect{144, 80, 272, 160};
    const auto with = [&](Estimator e, std::int64_t samples) {
        d.render.estimator = e;
        d.render.samples = samples;
        return picture(d, panel, crop);
    };
    const Image truth = with(Estimator::point, 4096);
    d.render.sampling = Sampling::random;
    const double noise = compare(with(Estimator::point, 100), truth).rmse;
    EXPECT_LT(compare(with(Estimator::filtered, 4), truth).rmse, 1.0 * noise);   // if they did not: 1.3
    EXPECT_LT(compare(with(Estimator::filtered, 16), truth).rmse, 0.4 * noise);  // 0.54
}

// From above, and oblique both ways, the diffuser's two turns are not independent; rays of the pixels' own, which are for the
// extremes, would make 4 samples as noisy as 4 points.
TEST(FilteredEdges, ObliqueViewsAreQuiet) {
    for (const auto& [right, up] : {std::pair{0.0, 10.0}, {0.0, -25.0}, {18.0, 18.0}}) {
        Display d = ideal_example();
        d.diffuser = Diffuser{40, {4, 4}, Profile::box};
        d.camera.resolution = {96, 54};
        const double h = right * degree, v = up * degree;
        d.camera.position_mm = {500 * std::sin(h) * std::cos(v), 500 * std::sin(v), 500 * std::cos(h) * std::cos(v)};
        const Texels panel = noise_panel(d);
        const auto with = [&](Estimator e, std::int64_t samples, Sampling sampling) {
            d.render.estimator = e;
            d.render.samples = samples;
            d.render.sampling = sampling;
            return picture(d, panel);
        };
        const Image truth = with(Estimator::point, 16384, Sampling::sobol);
        const double noise = compare(with(Estimator::point, 100, Sampling::random), truth).rmse;
        EXPECT_LT(compare(with(Estimator::filtered, 4, Sampling::sobol), truth).rmse, noise) << right << ", " << up;
    }
}

}  // namespace
}  // namespace lfdsim
