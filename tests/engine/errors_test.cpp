// Pictures of displays whose arrays have errors. The independent tracer (tests/oracle) has the optics of each; here is what must
// hold between lfdsim's own pictures.
#include <gtest/gtest.h>

#include <cmath>

#include "geometry/lens_misalignment.h"
#include "pictures.h"

namespace lfdsim {
namespace {

TEST(Errors, OfTheWholeArrayAreThoseOfAnotherDisplay) {
    for (const Estimator estimator : {Estimator::point, Estimator::filtered}) {
        Display off = example();
        off.render.estimator = estimator;
        off.diffuser = Diffuser{40, {4, 4}, Profile::box};
        Display described = off;
        off.errors.shift_mm = {0.5, -0.25};
        off.errors.gap_mm = 0.125;
        off.errors.rotation_deg = 1.5;
        described.array.offset_mm = {0.5, -0.25};
        described.array.gap_mm = 7.125;
        described.array.rotation_deg = 1.5;
        described.diffuser->distance_mm = 40 - 0.125;
        const Texels panel = noise_panel(off);
        EXPECT_EQ(picture(off, panel).rgb, picture(described, panel).rgb);
    }
}

TEST(Errors, OfPitchLeaveTheLensesAsLargeAsTheyAre) {
    Display off = example();
    off.errors.pitch_ppm = 5000;
    Display described = off;
    described.errors = {};
    described.array.pitch_mm = 4 * 1.005;
    const Texels panel = noise_panel(off);
    const Image got = picture(off, panel), wanted = picture(described, panel);
    int different = 0;
    for (std::size_t k = 0; k < got.rgb.size(); ++k) different += got.rgb[k] != wanted.rgb[k];
    EXPECT_LT(different, int(got.rgb.size() / 500));  // where rounding takes another panel pixel
}

TEST(Errors, ThatAreNothingChangeNothing) {
    for (const auto& [name, d] : every_kind()) {
        if (has_errors(d.errors) || d.array.surround == Surround::clear) continue;
        Display same = d;
        same.render.samples = 1;
        Display placed = same;
        placed.errors.given = std::make_shared<const std::vector<GivenLensError>>();  // each lens stands by itself, where it should
        const Texels panel = noise_panel(d);
        const Image wanted = picture(same, panel), got = picture(placed, panel);
        int different = 0;
        for (std::size_t k = 0; k < got.rgb.size(); ++k) different += std::abs(got.rgb[k] - wanted.rgb[k]) > 1e-4f;
        EXPECT_LT(different, int(got.rgb.size() / 150)) << name;
    }
}

TEST(Errors, HaveTheSameBitsInTheFilteredEstimator) {
    for (auto [name, d] : every_kind()) {
        if (!is_irregular(d.errors)) continue;
        d.render.estimator = Estimator::filtered;
        const Texels panel = noise_panel(d);
        const Image scalar = picture(d, panel, {1, "scalar", {}});
        for (const KernelInfo& kernel : kernels())
            if (kernel.available) {
                EXPECT_EQ(picture(d, panel, {2, kernel.name, {}}).rgb, scalar.rgb) << name << " " << kernel.name;
            }
    }
}

TEST(Errors, FilteredTendsToPoints) {
    for (auto [name, d] : every_kind()) {
        if (!is_irregular(d.errors)) continue;
        d.camera.resolution = {48, 32};
        const Texels panel = noise_panel(d);
        d.render.samples = 4096;
        const Image points = picture(d, panel);
        d.render.estimator = Estimator::filtered;
        d.render.samples = 1024;
        const Image filtered = picture(d, panel);
        double squares = 0, sum = 0, mean = 0;
        for (std::size_t k = 0; k < points.rgb.size(); ++k) {
            const double difference = filtered.rgb[k] - points.rgb[k];
            squares += difference * difference;
            sum += difference;
            mean += points.rgb[k];
        }
        EXPECT_LT(std::sqrt(squares / double(points.rgb.size())), 0.01) << name;
        // Outlines are the lattice's, wherever a lens stands.
        EXPECT_LT(std::abs(sum) / mean, name == "errors of each lens" ? 0.03 : 0.005) << name;
    }
}

}  // namespace
}  // namespace lfdsim
