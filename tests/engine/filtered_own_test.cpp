// The filtered estimator where pixels share no rays: strips and hexagons, pictures as coarse as their lenses are small.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/scene/traced_display.h"
#include "files/description/display_file.h"
#include "geometry/subpixels.h"
#include "pictures.h"

namespace lfdsim {
namespace {

// Through a slanted sheet in focus over stripes a pixel sees a leaning line, along which the gaps of rows and of columns coincide:
// read as an upright box it would be 4 % too dark, 9 % where the pupil is small.
TEST(FilteredEstimator, SeesLeaningLinesOfSubpixels) {
    Display d = read_display(LFDSIM_SOURCE_DIR "/displays/tablet-lenticular.toml");
    const Texels panel = uniform_panel(d, 1);
    const auto of = [&](Estimator estimator, std::int64_t samples, Sampling sampling) {
        d.render.estimator = estimator;
        d.render.samples = samples;
        d.render.sampling = sampling;
        return picture(d, panel, {0, "", Rect{896, 504, 928, 522}});
    };
    struct Case {
        double pupil_mm;
        std::int64_t samples;
        double error, darker;  // of the points' error; of the light
    };
    for (const Case& c :
         {Case{4, 1, 0.5, 0.03}, {4, 64, 0.15, 0.003}, {0.5, 1, 1, 0.07}, {0.5, 64, 0.2, 0.01}, {0.5, 1024, 0.1, 0.001}}) {
        d.camera.pupil_diameter_mm = c.pupil_mm;
        const Image truth = of(Estimator::point, 1 << 13, Sampling::sobol), points = of(Estimator::point, 100, Sampling::random),
                    seen = of(Estimator::filtered, c.samples, Sampling::sobol);
        EXPECT_LT(rmse(seen, truth), c.error * rmse(points, truth)) << c.pupil_mm << " mm, " << c.samples;
        EXPECT_NEAR(mean_light(seen) / mean_light(truth), 1, c.darker) << c.pupil_mm << " mm, " << c.samples;
    }
}

// Coarse pictures of lenses that are cut one by one, through diffusers that span a lens: a few rays of each pixel tell more than a
// hundred random ones. Light that is shared, and interpolated over 8 pixels while it moves by more than it spreads, was as wrong as
// it was bright.
TEST(FilteredEstimator, SeesCoarselyThroughDiffusers) {
    struct Case {
        const char* display;
        Diffuser diffuser;
        Rect part;
    };
    for (const Case& c : {Case{"hexagon", {10, {5, 5}, Profile::box}, {928, 520, 960, 538}},
                          {"tablet-lenticular", {2, {10, 10}, Profile::box}, {928, 520, 960, 538}},
                          {"tablet-lenticular", {0.05, {20, 20}, Profile::box}, {896, 504, 928, 522}}}) {
        for (const bool eye : {false, true}) {
            Display d = read_display(std::string(LFDSIM_SOURCE_DIR "/displays/") + c.display + ".toml");
            d.panel.subpixels = SubpixelLayout::none;
            d.panel.aperture_ratio = 1;
            d.diffuser = c.diffuser;
            if (!eye) d.camera.pixel_filter = PixelFilter::center, d.camera.pupil_diameter_mm.reset();
            const Texels panel = patterned_panel(d);
            const auto of = [&](Estimator estimator, std::int64_t samples, Sampling sampling) {
                d.render.estimator = estimator;
                d.render.samples = samples;
                d.render.sampling = sampling;
                return picture(d, panel, {0, "", c.part});
            };
            const Image truth = of(Estimator::point, 1 << 13, Sampling::sobol);
            const double points = rmse(of(Estimator::point, 100, Sampling::random), truth);
            EXPECT_LT(rmse(of(Estimator::filtered, 1, Sampling::sobol), truth), 1.3 * points) << c.display << (eye ? ", eye" : "");
            EXPECT_LT(rmse(of(Estimator::filtered, 64, Sampling::sobol), truth), 0.8 * points) << c.display << (eye ? ", eye" : "");
        }
    }
}

// Through strips behind a bell: between the corners of a strip its edges are no lines in the bell's numbers, and a white panel
// looked 10 % too bright.
TEST(FilteredEstimator, SeesStripsThroughABell) {
    Display d = read_display(LFDSIM_SOURCE_DIR "/displays/tablet-lenticular.toml");
    d.panel.subpixels = SubpixelLayout::none;
    d.panel.aperture_ratio = 1;
    d.diffuser = Diffuser{2, {10, 10}, Profile::gaussian};
    d.camera.pixel_filter = PixelFilter::center;
    d.camera.pupil_diameter_mm.reset();
    d.render.samples = 16;
    d.render.fresnel = Fresnel::none;
    EXPECT_NEAR(mean_light(picture(d, uniform_panel(d, 1), {0, "", Rect{896, 504, 960, 540}})), 1, 1e-3);
}

}  // namespace
}  // namespace lfdsim
