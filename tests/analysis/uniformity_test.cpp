// A white panel's light against brute force, closed forms and the camera.
#include <gtest/gtest.h>

#include "../engine/pictures.h"
#include "analysis/core/screen_parts.h"
#include "analysis/uniformity/efficiency.h"
#include "analysis/uniformity/luminance_theory.h"
#include "analysis/uniformity/uniformity.h"
#include "brute_force.h"

#include <atomic>

namespace lfdsim {
namespace {

constexpr std::int64_t many = 1 << 20;  // parts: more than any test uses

ScreenLuminance on_screen(const Display& d, const Vec3d& eye) {
    Job job;
    Parts parts(job, 0, many, 0);
    return screen_luminance(EyeRays(d, resolve(d)), d, resolve(d), eye, parts);
}
PitchLuminance in_pitch(const Display& d, const Vec3d& eye) {
    Job job;
    Parts parts(job, 0, many, 0);
    return pitch_luminance(EyeRays(d, resolve(d)), d, resolve(d), eye, parts);
}
LightBudget budget(const Display& d) {
    Job job;
    Parts parts(job, 0, many, 0);
    return mean_budget(light_budgets(d, resolve(d), parts));
}

Display wide_panel(Display d) {
    d.panel.pixels = {400, 300};
    d.array.count = {16, 12};
    return d;
}

TEST(Uniformity, IdealSquareLensesAreAsBrightAsThePanel) {
    const Display d = wide_panel(ideal_example());
    const ScreenLuminance screen = on_screen(d, {0, 0, 700});
    EXPECT_EQ(screen.least(), 1);
    EXPECT_EQ(screen.greatest(), 1);
    EXPECT_EQ(screen.mean().value, 1);
    EXPECT_EQ(screen.mean().error, 0);
    EXPECT_EQ(screen.uniformity_percent(false).value, 100);
    EXPECT_EQ(michelson(in_pitch(d, {0, 0, 700}).places).value, 0);
}

TEST(Uniformity, LuminanceAgreesWithBruteForce) {
    Display d = wide_panel(example());
    for (const double m : {0., 1.5}) {
        d.panel.emission_exponent = m;
        for (const Vec3d eye : {Vec3d{0, 0, 700}, Vec3d{300, -120, 500}, Vec3d{0, 400, 420}}) {
            const double expected = brute::PlanoConvexArray(d, 5).luminance(eye, 500000), found = on_screen(d, eye).mean().value;
            EXPECT_GT(expected, 0.1);
            std::printf("m = %g, eye at %4g %4g: %.4f of the panel's, by brute force %.4f\n", m, eye[0], eye[1], found, expected);
            EXPECT_NEAR(found / expected, 1, 0.005) << m << " " << eye[0] << " " << eye[1];
        }
    }
}

TEST(Uniformity, EfficiencyAgreesWithBruteForce) {
    Display d = wide_panel(example());
    for (const double m : {0., 2.}) {
        d.panel.emission_exponent = m;
        const brute::PlanoConvexArray::Shares expected = brute::PlanoConvexArray(d, 6).forward(3000000);
        const LightBudget found = budget(d);
        EXPECT_GT(expected.leaves, 0.05);
        std::printf("m = %g: %.4f of the panel's light leaves, by brute force %.4f\n", m, found.leaves / found.emitted,
                    expected.leaves);
        EXPECT_NEAR(found.leaves / found.emitted / expected.leaves, 1, 0.005) << m;
        EXPECT_NEAR(found.reaches_array / found.emitted / expected.reaches, 1, 0.005) << m;
    }
}

// The field of view is that of the lenses as built: slopes within p/2g, p stretched.
TEST(Uniformity, FieldOfAStretchedArrayIsThatOfItsPitch) {
    Display built = wide_panel(example()), described = built;
    built.content.made_for = MadeFor::built;
    built.errors.pitch_ppm = 8e4;
    described.array.pitch_mm = 1.08 * built.array.pitch_mm[0];
    const LightBudget found = budget(built), expected = budget(described);
    EXPECT_NEAR(found.leaves / expected.leaves, 1, 1e-6);
    EXPECT_NEAR(found.leaves_in_fov / expected.leaves_in_fov, 1, 1e-4);  // rays on the border may fall to either side
}

// Cover glass with air above it, lenses glued onto it and onto the panel itself: what goes up at random, by Snell and Fresnel.
TEST(Uniformity, EfficiencyThroughLayersAgreesWithBruteForce) {
    const Display plain = wide_panel(example());
    const double lens = resolve(plain).front_principal_mm - resolve(plain).base_z_mm;  // reduced: T/n, of a flat face below
    Display covered = plain, glued = plain, bare = plain, denser = plain;
    covered.panel.layers = {{1.1, 1.52}, {0.4, 1.6}};
    covered.array.gap_mm = 1.1 / 1.52 + 0.4 / 1.6 + 0.7 + lens;
    glued.panel.layers = {{1.1, 1.52}, {0.9, 1.4}};
    glued.array.gap_mm = 1.1 / 1.52 + 0.9 / 1.4 + lens;
    denser.panel.layers = {{1.5, 1.9}};
    denser.array.gap_mm = 1.5 / 1.9 + lens;
    bare.array.gap_mm = lens;
    for (Display d : {covered, glued, denser, bare}) {
        d.panel.emission_exponent = d.panel.layers.size() == 2 ? 0 : 1;
        const Geometry g = resolve(d);
        ASSERT_EQ(g.glued, d != covered) << g.base_z_mm;
        const brute::PlanoConvexArray::Shares expected = brute::PlanoConvexArray(d, 9).forward(4000000);
        const LightBudget found = budget(d);
        std::printf("%zu layers: %.4f of the panel's light leaves, by brute force %.4f; %.4f and %.4f reach the array\n",
                    d.panel.layers.size(), found.leaves / found.emitted, expected.leaves, found.reaches_array / found.emitted,
                    expected.reaches);
        EXPECT_GT(expected.leaves, 0.02);
        EXPECT_NEAR(found.leaves / found.emitted / expected.leaves, 1, 0.006);
        EXPECT_NEAR(found.reaches_array / found.emitted / expected.reaches, 1, 0.006);
    }
}

// Glass without losses lets 1/n^2 of the light out into air, all of which passes ideal lenses of any lattice, of power or not.
TEST(Uniformity, IdealLensesPassWhatLeavesTheLayers) {
    Display d = wide_panel(ideal_example());
    d.render.fresnel = Fresnel::none;
    d.panel.pixels = {6000, 6000};
    d.panel.layers = {{0.8, 1.7}, {0.5, 1.5}};
    for (const LatticeKind lattice : {LatticeKind::square, LatticeKind::strips, LatticeKind::hexagon})
        for (const double f : {1e6, 6.}) {
            d.array.lattice = lattice;
            d.array.count = {16, lattice == LatticeKind::strips ? 1 : 12};
            d.lens.as<IdealLens>().focal_length_mm = f;
            const Geometry g = resolve(d);
            const LightBudget light = budget(d);
            const double area = g.array_width_mm * g.array_height_mm / (g.panel_width_mm * g.panel_height_mm);
            const double cells = g.lattice.count[0] * g.lattice.pitch[0] * g.lattice.count[1] * g.lattice.pitch[1] /
                                 (g.array_width_mm * g.array_height_mm);
            EXPECT_NEAR(light.reaches_array / light.emitted, area / (1.7 * 1.7), 0.004 * area) << int(lattice);
            if (lattice != LatticeKind::strips)
                EXPECT_NEAR(light.leaves / light.reaches_array, cells, 0.004) << int(lattice) << " " << f;
            else  // long as the panel, which their light leaves at the ends
                EXPECT_GT(light.leaves / light.reaches_array, 0.97);
        }
}

// As much light meets the round apertures of ideal lenses that are raised or tilted a little.
TEST(Uniformity, MisalignedIdealLensesPassAsMuchLight) {
    Display d = wide_panel(ideal_example());
    d.array.aperture = Aperture::circle;
    d.lens.as<IdealLens>().aperture_radius_mm = 0.35 * d.array.pitch_mm[0];
    const double perfect = budget(d).leaves;
    Errors bowed, high, tilted, wedged, curved;
    bowed.bow_mm = 0.3;
    high.height_sd_mm = 0.1;
    tilted.tilt_sd_deg = 1;
    wedged.wedge_deg = {0.3, 0.5};
    curved.curvature_sd = 0.05;
    for (const Errors& errors : {bowed, high, tilted, wedged, curved}) {
        d.errors = errors;
        EXPECT_NEAR(budget(d).leaves / perfect, 1, 0.01) << errors.bow_mm << errors.tilt_sd_deg << errors.wedge_deg[1];
    }
}

// All that reaches square ideal lenses passes them, of whatever power; where they have none, what leaves within the field of view
// is the form factor of the square of those slopes.
TEST(Uniformity, IdealLensesLetAllLightPass) {
    Display d = wide_panel(ideal_example());
    for (const double f : {1e6, 6.}) {
        d.lens.as<IdealLens>().focal_length_mm = f;
        const LightBudget light = budget(d);
        EXPECT_NEAR(light.leaves / light.reaches_array, 1, 0.003) << f;
    }
    d.lens.as<IdealLens>().focal_length_mm = 1e6;
    d.panel.pixels = {4000, 4000};
    const double t = d.array.pitch_mm[0] / (2 * resolve(d).gap_mm), s = t / std::sqrt(1 + t * t);
    const LightBudget light = budget(d);
    EXPECT_NEAR(light.leaves_in_fov / light.leaves, 4 / std::numbers::pi * s * std::atan(s), 0.001);
}

// Round lenses show a chord's share of each line along the pitch; a box diffuser averages it.
TEST(Uniformity, DarkBandsOfRoundLenses) {
    Display d = wide_panel(ideal_example());
    d.array.aperture = Aperture::circle;
    d.lens.as<IdealLens>().aperture_radius_mm = 1.5;
    const double p = d.array.pitch_mm[0], r = 1.5;
    const auto chord = [&](double x) {
        x -= p * std::round(x / p);
        return std::abs(x) < r ? 2 * std::sqrt(r * r - x * x) / p : 0.;
    };
    for (const double span : {0., 1.0, 3.0}) {  // of the diffused light at the lenses, mm
        constexpr double above = 50;
        d.diffuser.reset();
        const double angle = 2 * std::atan(span / 2 / above) / degree;
        if (span > 0) d.diffuser = Diffuser{above, {angle, angle}, Profile::box};
        std::vector<double> expected;
        for (int k = 0; k < PitchLuminance::side; ++k) {
            double sum = 0;
            constexpr int steps = 4000;
            for (int n = 0; n < steps; ++n) {
                const double place = p * ((k + (n % 40 + 0.5) / 40) / PitchLuminance::side - 0.5);
                sum += chord(place + above * std::tan(angle * degree * ((n / 40 + 0.5) / (steps / 40) - 0.5)));
            }
            expected.push_back(sum / steps);
        }
        // From far away, so that all lines of sight are upright
        const std::vector<Sums> profile = in_pitch(d, {0, 0, 1e5}).profile(0);
        const std::vector<double> found = means(profile);
        for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], expected[k], 0.004) << span << " " << k;
        const Estimate contrast = michelson(profile);
        EXPECT_NEAR(contrast.value, michelson(expected), contrast.error + 0.001) << span;
        EXPECT_LT(contrast.error, 0.01) << span;
    }
}

// A display and its mirror image are as uniform: blocks of lenses are symmetric about the array's middle.
TEST(Uniformity, OfAMirrorImageIsTheSame) {
    for (const LatticeKind lattice : {LatticeKind::square, LatticeKind::strips})
        for (const double pitch : {0.6, 1.3}) {
            Display d;
            d.panel.pixels = {300, 200};
            d.panel.pixel_pitch_mm = 0.1;
            d.lens.kind = IdealLens{{}, 4.4};
            d.array.lattice = lattice;
            d.array.aperture = Aperture::cell;
            d.array.pitch_mm = pitch;
            d.array.gap_mm = 4.6;
            d.array.offset_mm = {0.3, 0};
            if (lattice == LatticeKind::strips) d.array.slant_deg = 12;
            d.diffuser = Diffuser{20, {6, 6}, Profile::box};
            const Vec3d eye{0, 0, 400};
            Display mirrored = d;
            mirrored.array.offset_mm[0] = -0.3;
            if (lattice == LatticeKind::strips) mirrored.array.slant_deg = -12;
            const Estimate one = on_screen(d, eye).uniformity_percent(false),
                           other = on_screen(mirrored, eye).uniformity_percent(false);
            EXPECT_NEAR(one.value, other.value, 1.5 * (one.error + other.error)) << int(lattice) << " " << pitch;
        }
}

// A sheet wider than the panel is measured as one that ends with it, wherever it has been shifted.
TEST(Uniformity, LensesThatAreNotSeenDoNotCount) {
    for (const LatticeKind lattice : {LatticeKind::square, LatticeKind::hexagon, LatticeKind::brick, LatticeKind::strips})
        for (const double shift : {0., 20.}) {
            Display d = wide_panel(ideal_example());
            d.array.lattice = lattice;
            d.array.count.reset();
            d.errors.shift_mm = {shift, 0};
            const ScreenParts covering(d, resolve(d), 16);
            const auto [across, up] = lens_count(d.panel, d.array);
            d.array.count = {across + 200, lattice == LatticeKind::strips ? 1 : up + 100};
            const ScreenParts wide(d, resolve(d), 16);
            const std::int64_t more = 2 * std::int64_t(std::ceil(shift / d.array.pitch_mm[0]));
            EXPECT_NEAR(wide.columns(), covering.columns(), double(more)) << int(lattice);
            EXPECT_NEAR(wide.rows(), covering.rows(), double(more)) << int(lattice);
            EXPECT_EQ(wide.block(0).first[0], 100 - more / 2);
            if (shift > 0) continue;
            for (const std::size_t k : {0, 1}) EXPECT_NEAR(wide.size_mm()[k], covering.size_mm()[k], 1e-9) << int(lattice);
            EXPECT_EQ(wide.middle().lenses(), covering.middle().lenses()) << int(lattice);
        }
}

// Ideal lenses of every kind, of arrays whose border parts hold fewer lenses, on panels that end before the lines of sight do.
TEST(Uniformity, MeanLuminanceIsTheory) {
    Display d = wide_panel(ideal_example());
    d.array.count = {35, 19};
    const double p = d.array.pitch_mm[0];
    struct Case {
        Aperture aperture;
        double stop;
        bool diffuser;
        double panel;  // over the array's width
    };
    for (const Case& c : {Case{Aperture::cell, 0, false, 0.9}, Case{Aperture::circle, 0, false, 0.9},
                          Case{Aperture::circle, 0, true, 1.1}, Case{Aperture::cell, 0.3, true, 0.9}}) {
        d.array.aperture = c.aperture;
        d.lens.as<IdealLens>().aperture_radius_mm = 0.45 * p;
        d.lens.stop_radius_mm.reset();
        if (c.stop > 0) d.lens.stop_radius_mm = c.stop * p;
        d.diffuser.reset();
        if (c.diffuser) d.diffuser = Diffuser{40, {6, 9}, c.stop > 0 ? Profile::gaussian : Profile::box};
        d.panel.pixels = {int(35 * p * c.panel / d.panel.pixel_pitch_mm), int(19 * p * c.panel / d.panel.pixel_pitch_mm)};
        const Estimate found = on_screen(d, {0, 0, 400}).mean();
        const TheoryFigure theory = luminance_over_panel(d, resolve(d), 400);
        EXPECT_NEAR(found.value / theory.value, 1, 0.004) << int(c.aperture) << c.stop << c.diffuser << c.panel;
        EXPECT_LT(found.error, 0.005 * found.value);
    }
}

TEST(Uniformity, TheoryOfRealLensesIsFillTimesFresnel) {
    Display d = wide_panel(example());
    d.lens.stop_radius_mm = 0.2 * d.array.pitch_mm[0];
    const double n = *d.lens.as<PlanoConvex>().index, passed = 4 * n / ((n + 1) * (n + 1)), fill = std::numbers::pi * 0.04;
    const TheoryFigure theory = luminance_over_panel(d, resolve(d), 1e5);
    EXPECT_NEAR(theory.value, fill * passed * passed, 1e-3 * theory.value);
    EXPECT_NEAR(on_screen(d, {0, 0, 1e5}).mean().value, theory.value, 0.005 * theory.value);
    d.panel.emission_exponent = 1;
    EXPECT_TRUE(std::isnan(luminance_over_panel(d, resolve(d), 1e5).value));
    EXPECT_FALSE(luminance_over_panel(d, resolve(d), 1e5).missing.empty());
}

// An even screen has no dark bands, however noisy the sums: the greatest of many is not the light's.
TEST(Uniformity, NoiseMakesNoContrast) {
    Random random(8);
    std::vector<Sums> noisy(32);
    for (Sums& sums : noisy)
        for (double& x : sums) x = 1 + random(-0.02, 0.02);
    const Estimate contrast = michelson(noisy);
    EXPECT_GT(michelson(means(noisy)), 0.004);
    EXPECT_LT(contrast.value, 0.004);
    EXPECT_LE(contrast.value, contrast.error);
}

// The camera's frame holds the box about the array; all light there is is the screen's mean over its cells. (Staggered rows end
// unevenly: a diffuser brings light into the notches, and a plate goes on in them.)
TEST(Uniformity, MeanIsThatOfTheCamerasPictureAtLength) {
    for (auto [name, d] : every_kind()) {
        d.array.rotation_deg = 0;
        if (d.array.slant_deg) d.array.slant_deg = 0;
        if (is_staggered(d.array)) d.diffuser.reset();
        if (d.panel.subpixels != SubpixelLayout::none) continue;  // the camera's pixels see some of them, the measure their mean
        d.array.offset_mm = {};
        d.array.count = lens_count(d.panel, d.array);
        for (auto& pixels : d.panel.pixels) pixels *= 2;  // all lenses are before the panel
        d.camera.pupil_diameter_mm.reset();
        d.camera.pixel_filter = PixelFilter::box;
        d.camera.position_mm = {0, 0, 400};
        d.camera.target_mm = {0, 0, resolve(d).vertex_plane_mm};
        d.camera.frame_width_mm = resolve(d).array_width_mm;
        d.camera.resolution = {80, std::int64_t(std::ceil(80 * resolve(d).array_height_mm / resolve(d).array_width_mm))};
        d.render.samples = 196;
        double sum = 0;
        const Image seen = picture(d, uniform_panel(d, 1));
        for (const float light : seen.rgb) sum += light;
        const Geometry g = resolve(d);
        if (d.array.surround == Surround::plate && is_staggered(d.array)) continue;
        const double frame = std::pow(g.frame_width_mm / 80, 2) * double(seen.rgb.size() / 3),
                     along_strips = g.lattice.strips ? 1 - g.vertex_plane_mm / 400 : 1,  // beyond the panel they are dark
            cells = g.lattice.count[0] * g.lattice.pitch[0] * g.lattice.count[1] * g.lattice.pitch[1] * along_strips;
        const double expected = sum / double(seen.rgb.size()) * frame / cells, found = on_screen(d, {0, 0, 400}).mean().value;
        EXPECT_GT(expected, 0.1) << name;
        EXPECT_NEAR(found / expected, 1, g.lattice.strips ? 0.012 : 0.005) << name;  // layers bend lines along strips
    }
}

// Every part counts once, and what a cancelled job has begun is given up.
TEST(Uniformity, ReportsItsStepsAndStops) {
    struct Counter : Job {
        std::atomic<std::int64_t> steps{0};
        bool stop = false;
        void advance(std::int64_t n) override { steps += n; }
        bool cancelled() const override { return stop; }
    } job;
    Subject subject(example(), {}, {});
    const Result result = measure_uniformity(subject, job);
    EXPECT_EQ(job.steps, uniformity_steps(subject));
    EXPECT_GT(job.steps, 0);
    job.stop = true;
    EXPECT_THROW(measure_uniformity(subject, job), Stopped);
}

TEST(Uniformity, SameFiguresOnAnyNumberOfThreads) {
    Display d = example();
    d.diffuser = Diffuser{40, {3, 5}, Profile::gaussian};
    AnalysisOptions one, two;
    one.threads = 1;
    two.threads = 2;
    Job job;
    Subject a(d, {}, one), b(d, {}, two);
    EXPECT_EQ(measure_uniformity(a, job).figures.dump(), measure_uniformity(b, job).figures.dump());
}

}  // namespace
}  // namespace lfdsim
