// The filtered estimator against brute force, and its promises: the same bits everywhere, errors that are what they are said to be.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "engine/scene/traced_display.h"
#include "geometry/subpixels.h"
#include "pictures.h"

namespace lfdsim {
namespace {

class Filtered : public testing::TestWithParam<std::size_t> {
  protected:
    Filtered() : name(diffused()[GetParam()].first), display(diffused()[GetParam()].second), panel(patterned_panel(display)) {}

    Image points(std::int64_t samples, Sampling sampling) const {
        Display d = display;
        d.render.estimator = Estimator::point;
        d.render.samples = samples;
        d.render.sampling = sampling;
        d.render.seed = 77;
        return picture(d, panel);
    }
    Image filtered(std::int64_t samples, const RenderOptions& options = {}) const {
        Display d = display;
        d.render.samples = samples;
        return picture(d, panel, options);
    }

    std::string name;
    Display display;
    Texels panel;
};
INSTANTIATE_TEST_SUITE_P(EveryWay, Filtered, testing::Range(std::size_t(0), diffused().size()));

// The bits below tell when one of them changes; then all are to be held against brute force, which ./test --full does.
class FilteredAndBruteForce : public Filtered {};
INSTANTIATE_TEST_SUITE_P(SomeWays, FilteredAndBruteForce, testing::Range(std::size_t(0), diffused().size(), std::size_t(4)));
INSTANTIATE_TEST_SUITE_P(AtLength, FilteredAndBruteForce, testing::Range(std::size_t(0), diffused().size()));

// On these displays, whose picture and panel pixels are coarse, 16 samples are nearly as good as 100 random points, and 1024 tend
// to the truth.
TEST_P(FilteredAndBruteForce, Agree) {
    const Image truth = points(8192, Sampling::sobol), papers = points(100, Sampling::random);
    const double wanted = rmse(papers, truth);
    EXPECT_LT(rmse(filtered(16), truth), 2.5 * wanted) << name;
    const Image fine = filtered(1024);
    // Single rays see subpixels at their full brightness: the truth is as much noisier.
    EXPECT_LT(rmse(fine, truth), std::sqrt(peak(display.panel)) / 100) << name;
    EXPECT_NEAR(mean_light(fine) / mean_light(truth), 1, 8e-3) << name;
}

// Seen as finely as the shipped displays are, 4 samples beat 100 random points, and 1024 tell the truth to one in 512; behind a
// diffuser so weak that a pixel sees little of a lens, too.
TEST(FilteredEstimator, NeedsFewSamples) {
    struct Case {
        Display display;
        double angle_deg;
        std::int64_t few;
    };
    for (const Case& of_case : {Case{example(), 5.7, 4},
                                {ideal_example(), 5.7, 4},
                                {example(), 1.2, 4},
                                {ideal_example(), 1.2, 4},
                                {in_rectangles(example()), 1.2, 4}}) {
        Display d = of_case.display;
        d.diffuser = Diffuser{40, {of_case.angle_deg, of_case.angle_deg}, Profile::box};
        d.camera.frame_width_mm = 8;
        const Texels panel = patterned_panel(d);
        auto of = [&](Estimator estimator, std::int64_t samples, Sampling sampling, std::int64_t seed) {
            d.render.estimator = estimator;
            d.render.samples = samples;
            d.render.sampling = sampling;
            d.render.seed = seed;
            return picture(d, panel, {0, "", Rect{40, 30, 120, 80}});
        };
        const Image truth = of(Estimator::point, 1 << 15, Sampling::sobol, 5);
        EXPECT_LT(rmse(of(Estimator::filtered, of_case.few, Sampling::sobol, 0), truth),
                  rmse(of(Estimator::point, 100, Sampling::random, 6), truth));
        const Image fine = of(Estimator::filtered, 1024, Sampling::sobol, 0);
        EXPECT_LT(rmse(fine, truth), 1.0 / 512);
        EXPECT_NEAR(mean_light(fine) / mean_light(truth), 1, 1e-3);
    }
}

// Seen by an eye whose pixels are wider than what a diffuser on the lenses spreads: one sample is better than 100 random points,
// and 1024 tell the truth; round holes let through what they should.
TEST(FilteredEstimator, CutsThePixelsAreaWhereADiffuserSpreadsLess) {
    for (const LatticeKind lattice : {LatticeKind::square, LatticeKind::hexagon}) {
        Display d = in_lattice(example(), lattice);
        d.diffuser = Diffuser{3, {1, 1}, Profile::box};
        d.camera.frame_width_mm = 24;
        d.camera.pixel_filter = PixelFilter::box;
        d.camera.pupil_diameter_mm = 2;
        const Texels panel = patterned_panel(d);
        const auto of = [&](Estimator estimator, std::int64_t samples, Sampling sampling) {
            d.render.estimator = estimator;
            d.render.samples = samples;
            d.render.sampling = sampling;
            return picture(d, panel, {0, "", Rect{40, 30, 120, 80}});
        };
        const Image truth = of(Estimator::point, 1 << 14, Sampling::sobol), one = of(Estimator::filtered, 1, Sampling::sobol),
                    many = of(Estimator::filtered, 1024, Sampling::sobol);
        EXPECT_LT(rmse(one, truth), rmse(of(Estimator::point, 100, Sampling::random), truth));
        EXPECT_LT(rmse(many, truth), 1.0 / 400);
        EXPECT_NEAR(mean_light(one) / mean_light(truth), 1, 1e-3);
        EXPECT_NEAR(mean_light(many) / mean_light(truth), 1, 1e-3);
    }
}

// Of the whole picture by the widest kernel; every kernel gives its parts. The hashes keep the limits of its shortcuts where they
// are (engine/estimator/limits.h): tests/limits/mutate.py shows which of them each limit changes.
constexpr std::uint64_t kept_bits[] = {
    0x6e80c9f951f44185, 0xab96577891e8d233, 0xc140888d58238065, 0xea4c95b509323263, 0xd1917d1ad46ada13, 0xc8628eefc035b558,
    0x5c40c78ca935f176, 0x90bd33961fed343c, 0x0aa088b2fdd31b92, 0x5a19c78b710c1613, 0xf6bac3c454cdd45d, 0xee4fe5ea14315fe8,
    0xb8daf0f9c661e4d6, 0xf7dc26a30c26e19d, 0x638848baccc9c498, 0x0bc7f3b9041a7f21, 0x7f2212708909740a, 0x9ecd0d3b80e58a41,
    0x8f07f4f2709535b0, 0x26f4b1a31e2c93b0, 0x1e5fe5580d1446e5, 0xbde43e446a7f6091, 0xb542b373282c43de, 0xc2c4713ba55f4726,
    0x963016361f9b9967, 0x3f25490eda321233, 0x1972e3acdf65219e, 0xa007b470294e6a76, 0x5fdf04526b1addcd, 0x08b8ad23e58c9cef,
    0xc08889eb93d22b98};

TEST_P(Filtered, HasTheSameBitsEverywhere) {
    Bits bits;
    for (const int samples : {4, 25, 81}) {
        const Image reference = filtered(samples, {1, "", {}});
        bits.add(reference);
        std::vector<Rect> crops{{13, 7, 110, 60}, {64, 16, 65, 17}};
        if (samples == 4) crops.push_back({0, 0, 160, 112});  // a third of it tells kernels apart as well, in a third of the time
        for (const KernelInfo& kernel : kernels()) {
            if (!kernel.available) continue;
            for (const Rect& crop : crops) {
                const Image part = filtered(samples, {2, kernel.name, crop});
                for (int y = crop.y0; y < crop.y1; ++y) {
                    ASSERT_EQ(0, std::memcmp(part.at(0, y - crop.y0), reference.at(crop.x0, y), std::size_t(part.width) * 12))
                        << name << ", " << samples << " samples, " << kernel.name << ", row " << y;
                }
            }
        }
    }
    EXPECT_EQ(bits.hash(), kept_bits[GetParam()]) << name;
}

// And where a block's size is decided: pictures that are fine or coarse beside the lenses, diffusers that are weak, oblique views.
// In the last one the diffuser turns rays along one axis, to nearly 80 degrees: no more than the two turns allow, but steeply.
TEST(FilteredEstimator, KeepsItsBitsWhereBlocksGrow) {
    struct Case {
        double frame_mm;
        std::array<double, 2> angle_deg;
        std::int64_t samples;
        bool rough;
        double view_deg;
    };
    Bits bits;
    for (const Case& c :
         {Case{11, {5.7, 5.7}, 100, false, 0}, Case{2.8, {5.7, 5.7}, 400, false, 0}, Case{5.6, {0.15, 5.7}, 4, false, 0},
          Case{8, {0.315, 5.7}, 4, false, 0}, Case{8, {1.57, 1.57}, 4, false, 0}, Case{52, {5.7, 5.7}, 4, true, 0},
          Case{90, {5.7, 5.7}, 4, true, 0}, Case{20, {30, 30}, 4, false, 60}, Case{20, {100, 5.7}, 4, false, 30}}) {
        Display d = example();
        d.diffuser = Diffuser{40, c.angle_deg, Profile::box};
        d.render.estimator = Estimator::filtered;
        d.render.samples = c.samples;
        d.camera.frame_width_mm = c.frame_mm;
        look_from(d, c.view_deg, 400);
        RenderOptions options{1, "scalar", Rect{56, 40, 104, 72}};
        options.rough = c.rough;
        bits.add(picture(d, patterned_panel(d), options));
    }
    EXPECT_EQ(bits.hash(), 0x223376c925ee556e);
}

// And where lenses are cut one by one: diffusers that span about a lens, a black matrix, picture pixels as wide as lenses.
TEST(FilteredEstimator, KeepsItsBitsLensByLens) {
    Bits bits;
    const auto add = [&](Display d) {
        d.render.estimator = Estimator::filtered;
        bits.add(picture(d, patterned_panel(d), {1, "scalar", {}}));
    };
    Display hexagons = example();
    hexagons.array.lattice = LatticeKind::hexagon;
    hexagons.camera.resolution = {80, 56};
    for (const double angle_deg : {2.0, 2.9, 3.9, 4.2, 6.0}) {
        Display d = hexagons;
        d.diffuser = Diffuser{40, {angle_deg, angle_deg}, Profile::box};
        d.render.samples = 1;
        add(d);
        d.panel.aperture_ratio = 0.4;
        d.render.samples = 16;
        add(d);
    }
    for (const double distance_mm : {12, 14, 16, 19}) {  // lenses out of focus there: footprints a few panel pixels wide
        Display d = hexagons;
        d.diffuser = Diffuser{distance_mm, {15, 15}, Profile::box};
        d.panel.aperture_ratio = 0.5;
        for (const std::int64_t samples : {1, 4}) {
            d.render.samples = samples;
            add(d);
        }
    }
    for (const std::int64_t columns : {10, 14, 18, 22}) {
        Display d = hexagons;
        d.camera.pixel_filter = PixelFilter::box;
        d.camera.resolution = {columns, 14};
        add(d);
    }
    // A diffuser that hardly turns a ray, a pupil that shows other lenses from its edge, and squares on whose panel pixels leap.
    Display weak = hexagons, wide = hexagons, squares = example();
    weak.diffuser = Diffuser{0.1, {0.2, 0.2}, Profile::box};
    wide.camera.pixel_filter = PixelFilter::box;
    wide.camera.pupil_diameter_mm = 6;
    wide.camera.focus_distance_mm = 281;
    wide.render.samples = 16;
    squares.diffuser = Diffuser{40, {5.7, 5.7}, Profile::box};
    squares.camera.resolution = {30, 21};
    for (const Display& d : {weak, wide, squares}) add(d);
    // Diffusers about as wide as a picture pixel and less, pupils that move rays over more and less of a lens.
    hexagons.camera.pixel_filter = PixelFilter::box;
    hexagons.camera.resolution = {40, 28};
    hexagons.camera.frame_width_mm = 12;
    for (const double angle_deg : {0.5, 2.0, 7.0, 10.0}) {
        for (const double pupil_mm : {0.0, 3.0, 13.0}) {
            Display d = hexagons;
            d.diffuser = Diffuser{4, {angle_deg, angle_deg}, Profile::box};
            if (pupil_mm > 0) d.camera.pupil_diameter_mm = pupil_mm;
            d.render.samples = pupil_mm == 3 ? 9 : pupil_mm == 13 ? 400 : 1;
            add(d);
        }
    }
    // Oblique views: behind a diffuser whose two turns are not independent, and of borders that are bent and hide something.
    for (const double slope : {0.3, 0.35, 0.4, 0.45}) {
        Display d = hexagons;
        d.camera.position_mm = {slope * 400, slope * 400, 400};
        d.render.samples = 4;
        d.array.aperture = Aperture::cell;
        d.lens.kind = PlanoConvex{4, 2.5, 0.5, 1.5, Facing::viewer};
        for (const double frame_mm : {4.0, 8.0, 16.0}) {
            d.camera.frame_width_mm = frame_mm;
            add(d);
        }
        d.camera.pixel_filter = PixelFilter::center;
        d.diffuser = Diffuser{12, {15, 15}, Profile::box};
        add(d);
    }
    EXPECT_EQ(bits.hash(), 0x263b567be9765cd8);
}

TEST(FilteredEstimator, SeesAWhitePanelWhite) {
    Display d = ideal_example();
    d.diffuser = Diffuser{40, {5.7, 5.7}, Profile::box};
    d.camera.frame_width_mm = 20;
    d.render.estimator = Estimator::filtered;
    const Image image = picture(d, uniform_panel(d, 1));
    for (const float x : image.rgb) ASSERT_NEAR(x, 1, 1e-6);
}

TEST(FilteredEstimator, GivesWayToPointsWhereItDoesNotApply) {
    Display d = example();
    d.render.estimator = Estimator::filtered;
    d.render.samples.reset();
    EXPECT_EQ(estimator_of(d), Estimator::point);
    EXPECT_EQ(samples_of(d), 1);  // nothing to sample
    d.diffuser = Diffuser{40, {3, 3}, Profile::box};
    EXPECT_EQ(estimator_of(d), Estimator::filtered);
    EXPECT_EQ(samples_of(d), 4);
    d.render.samples = 5;
    EXPECT_EQ(samples_of(d), 9);
}

TEST(FilteredEstimator, RefusesMoreStrataThanItHas) {
    Display d = diffused()[0].second;
    d.render.samples = 5000;
    EXPECT_THROW(picture(d, noise_panel(d)), InputError);
}

// What is said of the error is checked against the truth, for both estimators: it is not below, and not needlessly above.
class TargetError : public testing::TestWithParam<Estimator> {};
INSTANTIATE_TEST_SUITE_P(Both, TargetError, testing::Values(Estimator::filtered, Estimator::point));

TEST_P(TargetError, IsKept) {
    Display d = diffused()[1].second;
    const Texels panel = patterned_panel(d);
    Display brute = d;
    brute.render.estimator = Estimator::point;
    brute.render.samples = 1 << 14;
    brute.render.seed = 99;
    const RenderOptions part{0, "", Rect{30, 20, 120, 90}};
    const Image truth = picture(brute, panel, part);
    d.render.estimator = GetParam();
    Job job;
    for (const double target : {0.03, 0.01}) {
        RenderOptions options = part;
        options.target_error = target;
        const Rendering r = render(d, resolve(d), panel, options, job);
        ASSERT_EQ(r.error.rgb.size(), r.image.rgb.size());
        double said = 0;
        for (const float e : r.error.rgb) {
            said += double(e) * e;
            ASSERT_LE(e, target * 1.7321);  // root mean square of three colours
        }
        said = std::sqrt(said / double(r.error.rgb.size()));
        const double true_error = rmse(r.image, truth);
        EXPECT_LT(true_error, 1.3 * said);
        EXPECT_GT(true_error, said / 12);
        EXPECT_GT(r.samples, std::int64_t(r.image.rgb.size() / 3));
        options.crop = Rect{41, 33, 77, 54};
        const Rendering crop = render(d, resolve(d), panel, options, job);  // no pixel depends on the crop
        for (int y = 0; y < crop.image.height; ++y)
            ASSERT_EQ(0, std::memcmp(crop.image.at(0, y), r.image.at(11, y + 13), std::size_t(crop.image.width) * 12));
    }
}

}  // namespace
}  // namespace lfdsim
