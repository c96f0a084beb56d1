// Gaussian diffusers by the filtered estimator: sums of pictures with box diffusers.
#include <gtest/gtest.h>

#include <atomic>
#include <string_view>

#include "engine/estimator/gaussian_parts.h"
#include "files/description/display_file.h"
#include "pictures.h"

namespace lfdsim {
namespace {

/// A crop of a shipped display behind a bell: weak, narrower than a lens, and as wide as one.
Display behind_a_bell(const std::string& name, double angle_deg, PixelFilter filter, double pupil_mm) {
    Display d = read_display(LFDSIM_SOURCE_DIR "/displays/" + name + ".toml");
    d.diffuser->profile = Profile::gaussian;
    d.diffuser->angle_deg = {angle_deg, angle_deg};
    d.camera.pixel_filter = filter;
    d.camera.pupil_diameter_mm.reset();
    if (pupil_mm > 0) d.camera.pupil_diameter_mm = pupil_mm;
    return d;
}

// Round holes, seen through a bell of which each lens shows a part: a white panel was up to 14 % too dark at full resolution, and
// 48 % in a picture 96 pixels wide.
TEST(EvenParts, KeepTheLightOfABell) {
    for (const double angle : {0.3, 1.0, 2.08}) {
        for (const bool small : {false, true}) {
            for (const auto& [filter, pupil_mm] :
                 {std::pair(PixelFilter::center, 0.0), std::pair(PixelFilter::box, 0.0), std::pair(PixelFilter::box, 4.0)}) {
                Display d = behind_a_bell("desktop-asphere", angle, filter, pupil_mm);
                if (small) d.camera.resolution = {96, 54};
                const RenderOptions options{0, "", small ? Rect{16, 9, 80, 45} : Rect{1800, 1000, 1928, 1064}};
                const Texels white = uniform_panel(d, 1);
                d.render.estimator = Estimator::point;
                d.render.samples = 400;
                const double truth = mean_light(picture(d, white, options));
                d.render.estimator = Estimator::filtered;
                for (const int samples : {4, 100}) {
                    d.render.samples = samples;
                    // Small pictures' pixels are half as wide as a lens, whose edge only rays through their centres find.
                    EXPECT_NEAR(mean_light(picture(d, white, options)) / truth, 1,
                                small          ? 0.025
                                : samples == 4 ? 0.02
                                               : 0.005)
                        << angle << " degrees, " << samples << " samples" << (small ? ", small" : "");
                }
            }
        }
    }
}

// More samples make more boxes: the picture becomes the bell's.
TEST(EvenParts, BecomeTheBell) {
    for (const auto& [name, most] : {std::pair("desktop-asphere", 0.006), std::pair("hexagon", 0.03)}) {
        Display d = behind_a_bell(name, 1, PixelFilter::box, 0);
        const RenderOptions options{0, "", Rect{900, 500, 964, 532}};
        const Texels panel = patterned_panel(d);
        d.render.estimator = Estimator::point;
        d.render.samples = 20000;
        const Image truth = picture(d, panel, options);
        d.render.estimator = Estimator::filtered;
        double last = 1;
        for (const int samples : {1, 16, 256}) {
            d.render.samples = samples;
            const double error = rmse(picture(d, panel, options), truth);
            EXPECT_LT(error, 0.7 * last) << name << ", " << samples;
            last = error;
        }
        EXPECT_LT(last, most) << name;
    }
}

/// Cancelled once so many pixels are done.
struct CancelledJob : Job {
    explicit CancelledJob(std::int64_t after) : last(after) {}
    bool cancelled() const override { return done >= last; }
    void stage(std::string_view, std::int64_t count) override { total = count, ++stages; }
    void advance(std::int64_t pixels) override { done += pixels; }
    const std::int64_t last;
    std::int64_t total = 0;
    int stages = 0;
    std::atomic<std::int64_t> done = 0;
};

TEST(EvenParts, AreOneStageAndLoseNothingWhereTheyEnd) {
    Display d = behind_a_bell("desktop-asphere", 1, PixelFilter::box, 0);
    d.render.samples = 16;  // 4 parts
    d.render.estimator = Estimator::lens_by_lens;
    const RenderOptions options{1, "", Rect{1800, 1000, 1928, 1064}};
    const Texels white = uniform_panel(d, 1);
    const std::int64_t pixels = 128 * 64;
    CancelledJob whole(5 * pixels), half(2 * pixels);
    const Rendering all = render(d, resolve(d), white, options, whole), some = render(d, resolve(d), white, options, half);
    EXPECT_TRUE(all.complete);
    EXPECT_EQ(whole.stages, 1);
    EXPECT_EQ(whole.total, 4 * pixels);
    EXPECT_EQ(whole.done, 4 * pixels);
    EXPECT_FALSE(some.complete);
    EXPECT_NEAR(mean_light(some.image) / mean_light(all.image), 1, 0.05);
}

TEST(EvenParts, AreTheDisplayItselfElsewhere) {
    Display d = behind_a_bell("desktop-asphere", 1, PixelFilter::box, 0);
    d.render.samples = 100;
    EXPECT_EQ(even_parts(d).size(), 16u);
    d.render.estimator = Estimator::point;
    EXPECT_EQ(even_parts(d).size(), 1u);
    EXPECT_EQ(even_parts(d).front().display, d);
    d.render.estimator = Estimator::filtered;
    d.render.samples = 10000;  // refused by render()
    EXPECT_EQ(even_parts(d).size(), 1u);
}

}  // namespace
}  // namespace lfdsim
