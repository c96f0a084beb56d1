// Displays whose glass disperses: each channel is the picture of a display with that wavelength's index, in green's place.
#include "display/colour.h"

#include <gtest/gtest.h>

#include "display/keys.h"
#include "pictures.h"

namespace lfdsim {
namespace {

Display dispersing(Display d) {
    auto& lens = d.lens.as<PlanoConvex>();
    lens.index.reset();
    lens.glass = Glass{"", Formula::nd_vd, {1.53, 30}};
    d.render.samples = 4;
    return d;
}

/// The same with the index of one wavelength.
Display at_one(Display d, double wavelength_nm) {
    auto& lens = d.lens.as<PlanoConvex>();
    d.array.base_z_mm = resolve(d).base_z_mm;
    d.array.gap_mm.reset();
    lens.index = index_of(*lens.glass, wavelength_nm);
    lens.glass.reset();
    return d;
}

void expect_channel(const Image& of, const Image& alone, std::size_t channel, const std::string& name) {
    for (std::size_t k = channel; k < of.rgb.size(); k += 3) ASSERT_NEAR(of.rgb[k], alone.rgb[k], 1e-6) << name << " " << k / 3;
}

TEST(Colour, ChannelsArePicturesOfConstantIndices) {
    for (const Estimator estimator : {Estimator::point, Estimator::filtered})
        for (const SubpixelLayout layout : {SubpixelLayout::none, SubpixelLayout::delta}) {
            Display d = dispersing(example());
            d.camera.position_mm = {60, 20, 400};
            d.panel.subpixels = layout;
            d.diffuser = Diffuser{40, {4, 4}, Profile::box};
            d.render.estimator = estimator;
            const Texels panel = noise_panel(d);
            ASSERT_TRUE(disperses(d));
            const Image all = picture(d, panel);
            for (std::size_t c = 0; c < 3; ++c)
                expect_channel(all, picture(at_one(d, d.panel.wavelengths_nm[c]), panel), c, std::string(word(layout)));
            EXPECT_NE(all.rgb, picture(at_one(d, d.panel.wavelengths_nm[1]), panel).rgb);
        }
}

TEST(Colour, WideChannelsAreSumsOverTheirWavelengths) {
    Display d = dispersing(example());
    d.camera.position_mm = {60, 20, 400};
    d.panel.primary_widths_nm = Vec3d{40, 30, 20};
    d.render.wavelength_samples = 3;
    const Texels panel = noise_panel(d);
    const Image all = picture(d, panel);
    for (std::size_t c = 0; c < 3; ++c) {
        Image sum(all.width, all.height);
        double weights = 0;
        for (const Node& node : wavelengths_of(d, int(c))) {
            Display one = at_one(d, node.wavelength_nm);
            one.panel.primary_widths_nm.reset();
            one.render.wavelength_samples = 1;
            const Image at = picture(one, panel);
            for (std::size_t k = 0; k < sum.rgb.size(); ++k) sum.rgb[k] += float(node.weight) * at.rgb[k];
            weights += node.weight;
        }
        EXPECT_NEAR(weights, 1, 1e-12);
        expect_channel(all, sum, c, "three wavelengths");
    }
}

// Rays of all wavelengths of a channel take the same way but for refraction: their errors do not average out.
TEST(Colour, TheErrorsOfWavelengthsAddUp) {
    Display d = dispersing(example());
    d.diffuser = Diffuser{40, {4, 4}, Profile::box};
    d.panel.primary_widths_nm = Vec3d{10, 10, 10};
    d.render.wavelength_samples = 5;
    const Texels panel = noise_panel(d);
    Job job;
    RenderOptions options;
    options.crop = Rect{40, 30, 88, 66};
    Display points = d;
    points.render.estimator = Estimator::point;
    points.render.samples = 1 << 13;
    points.render.seed = 99;
    const Image truth = render(points, resolve(points), panel, options, job).image;
    options.target_error = 0.02;
    for (const Estimator estimator : {Estimator::point, Estimator::filtered}) {
        d.render.estimator = estimator;
        const Rendering r = render(d, resolve(d), panel, options, job);
        double squares = 0;
        for (const float e : r.error.rgb) squares += double(e) * e;
        const double stated = std::sqrt(squares / double(r.error.rgb.size()));
        EXPECT_LT(rmse(r.image, truth), 1.3 * stated) << word(estimator);
        EXPECT_LT(stated, 0.02);
    }
}

TEST(Colour, ATargetErrorHoldsInEachChannel) {
    Display d = dispersing(example());
    d.diffuser = Diffuser{40, {4, 4}, Profile::box};
    Job job;
    RenderOptions options;
    options.target_error = 0.02;
    options.crop = Rect{40, 30, 72, 62};
    const Rendering r = render(d, resolve(d), noise_panel(d), options, job);
    EXPECT_TRUE(r.complete);
    for (std::size_t c = 0; c < 3; ++c) {
        double squares = 0;
        for (std::size_t k = c; k < r.error.rgb.size(); k += 3) squares += double(r.error.rgb[k]) * double(r.error.rgb[k]);
        EXPECT_GT(squares, 0);
        EXPECT_LE(std::sqrt(squares / double(r.error.rgb.size() / 3)), 0.02);
    }
}

}  // namespace
}  // namespace lfdsim
