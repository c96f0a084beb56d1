// The estimator lens_by_lens against brute force, and the same bits everywhere.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "geometry/subpixels.h"
#include "pictures.h"

namespace lfdsim {
namespace {

class LensByLens : public testing::TestWithParam<std::size_t> {
  protected:
    LensByLens() : name(diffused()[GetParam()].first), display(diffused()[GetParam()].second), panel(patterned_panel(display)) {
        display.render.estimator = Estimator::lens_by_lens;
    }
    Image seen(std::int64_t samples, const RenderOptions& options = {}) const {
        Display d = display;
        d.render.samples = samples;
        return picture(d, panel, options);
    }
    Image points(std::int64_t samples) const {
        Display d = display;
        d.render.estimator = Estimator::point;
        d.render.samples = samples;
        d.render.seed = 77;
        return picture(d, panel);
    }

    std::string name;
    Display display;
    Texels panel;
};
INSTANTIATE_TEST_SUITE_P(EveryWay, LensByLens, testing::Range(std::size_t(0), diffused().size()));

// Where light also passes beside the lenses a cell's one ray does not tell both apart: such displays converge more slowly. Of a
// lens whose flat side faces the viewer the outline is where rays enter, not where the rim stops them: 1.5 % too bright.
TEST_P(LensByLens, TendsToBruteForce) {
    const bool leaks = display.array.surround != Surround::opaque;
    const Image truth = points(2048), coarse = seen(16), fine = seen(256);
    const double bright = std::sqrt(peak(display.panel));
    EXPECT_LT(rmse(fine, truth), (leaks ? 0.04 : 0.02) * bright) << name;
    EXPECT_LT(rmse(coarse, truth), (leaks ? 0.12 : 0.08) * bright) << name;
    EXPECT_NEAR(mean_light(fine) / mean_light(truth), 1, 0.02) << name;
}

TEST_P(LensByLens, HasTheSameBitsEverywhere) {
    const Image reference = seen(9, {1, "", {}});
    for (const KernelInfo& kernel : kernels()) {
        if (!kernel.available) continue;
        for (const Rect& crop : {Rect{13, 7, 61, 40}, Rect{64, 16, 65, 17}}) {
            const Image part = seen(9, {2, kernel.name, crop});
            for (int y = crop.y0; y < crop.y1; ++y)
                ASSERT_EQ(0, std::memcmp(part.at(0, y - crop.y0), reference.at(crop.x0, y), std::size_t(part.width) * 12))
                    << name << ", " << kernel.name << ", row " << y;
        }
    }
}

// A domain without area, and pixels that see more lenses than are listed.
TEST(LensByLensByPoints, WhereLensesAreNotToldApart) {
    Display line = example(), coarse = example();
    line.diffuser = Diffuser{40, {5.7, 0}, Profile::box};
    coarse.diffuser = Diffuser{60, {80, 80}, Profile::box};
    for (Display d : {line, coarse}) {
        d.camera.resolution = {32, 24};
        d.render.samples = 64;
        const Texels panel = patterned_panel(d);
        d.render.estimator = Estimator::lens_by_lens;
        const Image seen = picture(d, panel);
        d.render.estimator = Estimator::point;
        d.render.samples = 16 * 64;
        EXPECT_LT(rmse(seen, picture(d, panel)), 1e-6);
        EXPECT_GT(mean_light(seen), 0.01);
    }
}

}  // namespace
}  // namespace lfdsim
