// What check traces of a display: the width that an eye sees through a lens, and the waves of colours on a white screen.
#include "analysis/verdicts/quick_look.h"

#include <gtest/gtest.h>

#include "base/constants.h"
#include "example.h"

#include <cmath>
#include <complex>

namespace lfdsim {
namespace {

// The width of the panel that one eye sees through an ideal lens is D |1 + g/E - g/f|, whatever the lattice.
TEST(QuickLook, WidthSeenIsThatOfTheory) {
    for (const LatticeKind lattice : {LatticeKind::square, LatticeKind::hexagon, LatticeKind::strips})
        for (const double gap : {2., 3., 4.2}) {
            Display d = analysis_example::display(40, 100);
            d.diffuser.reset();
            d.array.lattice = lattice;
            d.array.count.reset();
            d.array.gap_mm = gap;
            d.lens.kind = IdealLens{{}, 3};
            d.array.pitch_mm = 2;
            const Geometry g = resolve(d);
            const auto seen = seen_at_once(d, g);
            const double eye = 2000 - g.rear_principal_mm, width = 2 * std::abs(1 + gap / eye - gap / 3);
            ASSERT_TRUE(seen);
            EXPECT_NEAR(seen->through_apertures_mm, width, 1e-9);
            if (lattice == LatticeKind::hexagon) continue;  // whose width varies
            EXPECT_NEAR(seen->width_mm.traced, width, 0.01 * width + 1e-4) << gap;
            EXPECT_NEAR(seen->width_mm.theory, width, 0.01 * width + 1e-4) << gap;
        }
}

// A diffuser of the angle w at the height d above lenses in focus widens that by g w |1 - d/E|.
TEST(QuickLook, DiffusersWidenWhatIsSeen) {
    Display d = analysis_example::display(40, 100);
    d.lens.kind = IdealLens{{}, *d.array.gap_mm};
    d.diffuser = Diffuser{100, {3, 3}, Profile::box};
    const Geometry g = resolve(d);
    const double eye = 2000 - g.rear_principal_mm, wide = g.gap_mm * 2 * std::tan(1.5 * degree) * (1 - 100 / eye);
    EXPECT_NEAR(seen_at_once(d, g)->width_mm.traced, wide, 0.03 * wide);
}

// Few lines get through pinholes, and as many as get through lenses gave a contrast of 0.73. Red less luminance of three stripes
// has the amplitude |0.7874 e^(2 pi i/3) - 0.7152 - 0.0722 e^(-2 pi i/3)| sinc(1/3), the disk that an eye sees of the panel 2
// J1(x)/x.
TEST(QuickLook, ColourWavesOfPinholesAreThoseOfTheory) {
    Display d;
    d.panel.pixels = {200, 120};
    d.panel.pixel_pitch_mm = 0.08;
    d.panel.subpixels = SubpixelLayout::rgb_stripe;
    d.lens.kind = Pinhole{0.04};
    d.array.pitch_mm = 0.97;
    d.array.gap_mm = 3.2;
    const auto third = std::polar(1., 2 * pi / 3);
    const double stripes = 2 * std::abs(0.7874 * third - 0.7152 - 0.0722 * std::conj(third)) * std::sin(pi / 3) / (pi / 3);
    for (const double eye : {600., 600.1}) {
        d.camera.position_mm = {0, 0, eye};
        const double x = 2 * pi * 0.04 * (1 + 3.2 / eye) / 0.08;
        const std::optional<ColourWave> wave = colour_wave(d, resolve(d));
        ASSERT_TRUE(wave);
        EXPECT_NEAR(wave->contrast, stripes * 2 * std::cyl_bessel_j(1, x) / x, 0.12) << eye;
    }
}

// A display and its mirror image, of which a quarter of the lines get through: chance made bands of 0.10 in one of them, where
// pictures have 0.04.
TEST(QuickLook, ColourWavesOfAMirrorImageAreTheSame) {
    Display d;
    d.panel.pixels = {144, 80};
    d.panel.pixel_pitch_mm = 0.08;
    d.panel.subpixels = SubpixelLayout::delta;
    d.lens.kind = IdealLens{0.2217, 2.4};
    d.array.lattice = LatticeKind::hexagon;
    d.array.aperture = Aperture::circle;
    d.array.pitch_mm = 0.8706;
    d.array.gap_mm = 2.9;
    d.array.count = {{14, 9}};
    d.diffuser = Diffuser{12.76, {1.74, 2.26}, Profile::gaussian};
    for (const double offset : {0., 0.01, 0.02, 0.05}) {
        d.camera.position_mm = {0, 0, 300};
        d.array.offset_mm = {offset, 0.03};
        const std::optional<ColourWave> wave = colour_wave(d, resolve(d));
        d.array.offset_mm = {offset, -0.03};
        const std::optional<ColourWave> other = colour_wave(d, resolve(d));
        ASSERT_TRUE(wave && other);
        EXPECT_NEAR(wave->visible, other->visible, 0.04) << offset;
        EXPECT_LT(wave->visible, 0.05) << offset;
    }
}

}  // namespace
}  // namespace lfdsim
