// The same picture, to the last bit, from every kernel, number of threads and crop.
#include <gtest/gtest.h>

#include <cstring>

#include "files/description/display_file.h"
#include "geometry/subpixels.h"
#include "pictures.h"

namespace lfdsim {
namespace {

class SameBits : public testing::TestWithParam<std::size_t> {
  protected:
    SameBits() : display(every_kind()[GetParam()].second), panel(noise_panel(display)) {
        reference = picture(display, panel, {1, "scalar", {}});
    }

    void expect_part(const Image& image, const Rect& part, const std::string& how) {
        ASSERT_EQ(image.width, part.x1 - part.x0);
        ASSERT_EQ(image.height, part.y1 - part.y0);
        for (int y = part.y0; y < part.y1; ++y) {
            ASSERT_EQ(0, std::memcmp(image.at(0, y - part.y0), reference.at(part.x0, y), std::size_t(image.width) * 12))
                << every_kind()[GetParam()].first << ": " << how << ", row " << y;
        }
    }

    Display display;
    Texels panel;
    Image reference;
};
// Drawn at random: rounding leaves an area to pixels that see nothing of a stratum between hexagonal caps.
TEST(SameBitsFiltered, OfPixelsThatSeeNothingOfAStratum) {
    const Display d = parse_display(R"(schema = 1
[panel]
pixels = [444, 446]
pixel_pitch_mm = 0.0049657679630832376
emission_exponent = 1.0
[lens]
type = "plano_convex"
sphere_radius_mm = 0.7096791382412391
aperture_radius_mm = 0.21913048504719196
index = 1.456550629861797
cylinder_height_mm = 0.05432976349567394
[array]
lattice = "hexagon"
pitch_mm = 0.4382609700943839
gap_mm = 1.5507798049220143
surround = "plate"
count = [5, 6]
[camera]
position_mm = [0.0, 0.0, 747.2657915518434]
resolution = [160, 100]
[render]
fresnel = "schlick"
seed = 138
estimator = "filtered"
samples = 4
[diffuser]
distance_mm = 10.447149037967447
angle_deg = [0.9649901635789994, 3.000698120286697]
)",
                                    "drawn");
    const Texels panel = noise_panel(d);
    const Image reference = picture(d, panel, {1, "scalar", {}});
    for (const KernelInfo& kernel : kernels()) {
        if (!kernel.available) continue;
        const Image image = picture(d, panel, {1, kernel.name, {}});
        EXPECT_EQ(0, std::memcmp(image.rgb.data(), reference.rgb.data(), image.rgb.size() * sizeof(float))) << kernel.name;
    }
}

INSTANTIATE_TEST_SUITE_P(EveryKind, SameBits, testing::Range(std::size_t(0), every_kind().size()));

TEST_P(SameBits, OnEveryKernelAndNumberOfThreads) {
    float most = 0;
    int lit = 0;
    for (float light : reference.rgb) most = std::max(most, light), lit += light > 0;
    EXPECT_GT(lit, int(reference.rgb.size() / 20));  // there is something to compare
    EXPECT_LE(most, 1.0001 * peak(display.panel));
    int ran = 0;
    for (const KernelInfo& kernel : kernels()) {
        if (!kernel.available) continue;
        ++ran;
        for (int threads : {1, 2, 3}) {
            expect_part(picture(display, panel, {threads, kernel.name, {}}), {0, 0, 160, 112},
                        kernel.name + ", " + std::to_string(threads));
        }
    }
    EXPECT_GE(ran, 2);  // scalar and baseline are everywhere
}

TEST_P(SameBits, InEveryCrop) {
    for (const Rect& crop :
         {Rect{0, 0, 1, 1}, Rect{159, 111, 160, 112}, Rect{13, 7, 110, 60}, Rect{64, 16, 128, 32}, Rect{3, 50, 8, 112}}) {
        for (const KernelInfo& kernel : kernels()) {
            if (kernel.available) expect_part(picture(display, panel, {2, kernel.name, crop}), crop, kernel.name + ", crop");
        }
    }
}

}  // namespace
}  // namespace lfdsim
