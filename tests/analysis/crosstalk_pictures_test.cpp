// Crosstalk against pictures: views' pixels, or subpixels, are white as a whole, and the renderer shows them to the eye in the
// middle of a view.
#include "analysis/crosstalk/crosstalk.h"
#include "base/constants.h"
#include "geometry/subpixels.h"
#include "optics/lattice.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "../engine/pictures.h"

namespace lfdsim::crosstalk_pictures {
namespace {

constexpr double eye_mm = 500, gap_mm = 5, pixel_mm = 0.2, scale = 1 + gap_mm / eye_mm;

/// Lenses whose elemental images are `images` pixels wide, along a row of the panel.
Display display(LatticeKind lattice, double images) {
    Display d;
    d.panel.pixel_pitch_mm = pixel_mm;
    d.array.lattice = lattice;
    d.array.aperture = Aperture::cell;
    d.array.gap_mm = gap_mm;
    const double pitch = images * pixel_mm * eye_mm / (eye_mm + gap_mm);
    const bool sides = lattice == LatticeKind::rectangle || lattice == LatticeKind::brick;
    d.array.pitch_mm = sides ? Pitch{pitch, 1.3 * pitch} : Pitch{pitch};
    const std::int64_t across = 12;
    d.array.count = {across, lattice == LatticeKind::strips ? 1 : 8};
    d.panel.pixels = {std::int64_t(std::ceil(images)) * across, std::int64_t(images * 10)};
    d.lens.kind = IdealLens{{}, 1 / (1 / gap_mm + 1 / 50.)};
    d.camera.position_mm = {0, 0, eye_mm + gap_mm};
    d.camera.resolution = {64, 48};
    d.camera.pixel_filter = PixelFilter::box;
    d.render.estimator = Estimator::point;
    d.render.samples = 64;
    d.content.viewing_distance_mm = eye_mm + gap_mm;
    return d;
}

/// The view, from that about the screen's normal, that a panel point is meant for, in steps of a/g: by the lens whose image's
/// centre is nearest (along rows and columns in their own measure), among all lenses. Nothing: it is on no lens's image.
std::optional<double> meant_view(const Display& d, const Geometry& g, double x, double y) {
    x -= scale * d.array.offset_mm[0];
    const Lattice<double>& l = g.lattice;
    const double c = std::cos(d.array.turn_deg() * degree), s = std::sin(d.array.turn_deg() * degree);
    std::optional<double> found;
    double nearest = infinity;
    for (double j = 0; j < l.count[1]; ++j)
        for (double i = 0; i < l.count[0]; ++i) {
            const auto axis = optics::axis_in_array(l, optics::Cell<double>{i, j});
            const double along = c * x + s * y - scale * axis.x, up = l.strips ? 0 : -s * x + c * y - scale * axis.y;
            const double far = l.hexagonal ? std::hypot(along / l.pitch[0], up / l.pitch[0])
                                           : std::max(std::abs(along) / l.pitch[0], std::abs(up) / l.pitch[1]);
            if (far < nearest) nearest = far, found = -along / (l.strips ? c : 1) / pixel_mm;
        }
    return nearest <= 0.58 * scale ? found : std::nullopt;
}

/// White where that is meant for view `middle` (signal), or for others (leak).
Texels lit(const Display& d, double middle, bool signal, ContentSampling sampling) {
    const Geometry g = resolve(d);
    Texels panel(d.panel.pixels[0], d.panel.pixels[1]);
    for (std::int64_t row = 0; row < panel.rows(); ++row)
        for (std::int64_t column = 0; column < panel.columns(); ++column)
            for (int channel = 0; channel < 3; ++channel) {
                std::array<double, 2> off{};
                if (sampling == ContentSampling::subpixel && d.panel.subpixels != SubpixelLayout::none)
                    off = centroid(d.panel, channel, column, row).value_or(off);
                const auto view = meant_view(d, g, (double(column) + 0.5 + off[0] - 0.5 * double(panel.columns())) * pixel_mm,
                                             (0.5 * double(panel.rows()) - double(row) - 0.5 - off[1]) * pixel_mm);
                const bool own = view && std::abs(*view - middle) < 0.5;
                panel.row(row)[4 * column + channel] = view && own == signal ? 1 : 0;
            }
    return panel;
}

double luminance(const Image& image) {
    double sum = 0;
    for (std::size_t k = 0; k < image.rgb.size(); ++k) sum += luminance_weights[k % 3] * double(image.rgb[k]);
    return sum;
}

double pictured_percent(Display d, double middle, ContentSampling sampling) {
    d.camera.position_mm[0] = middle * pixel_mm / gap_mm * eye_mm;
    const double signal = luminance(picture(d, lit(d, middle, true, sampling))),
                 leak = luminance(picture(d, lit(d, middle, false, sampling)));
    return 100 * leak / signal;
}

struct Drawn {
    LatticeKind lattice;
    double images, slant_deg, innermost;
    SubpixelLayout subpixels = SubpixelLayout::none;
    double offset_mm = 0;
};

void expect_as_pictured(const Drawn& drawn) {
    Display made = display(drawn.lattice, drawn.images);
    if (drawn.slant_deg != 0) {
        made.array.slant_deg = drawn.slant_deg;
        made.array.pitch_mm = made.array.pitch_mm[0] * std::cos(drawn.slant_deg * degree);
    }
    made.panel.subpixels = drawn.subpixels;
    made.array.offset_mm[0] = drawn.offset_mm;
    Subject subject(made, {}, {});
    Job job;
    const Json views = measure_crosstalk(subject, job).figures.at("between_views");
    const std::string which = fmt::format("lattice {}, {} pixels, slant {}, subpixels {}", int(drawn.lattice), drawn.images,
                                          drawn.slant_deg, int(drawn.subpixels));
    EXPECT_EQ(views.at("innermost_view"), drawn.innermost) << which;
    const auto near = [&](const Json& found, ContentSampling sampling) {
        const double pictured = pictured_percent(made, drawn.innermost, sampling), theory = found.at("theory_percent");
        EXPECT_NEAR(found.at("woods_percent"), pictured, double(found.at("woods_percent_error")) + 0.01 * pictured + 0.1) << which;
        EXPECT_NEAR(theory, pictured, 0.02 * pictured + 0.2) << which;
    };
    const bool by_subpixel = drawn.subpixels != SubpixelLayout::none;
    near(views, by_subpixel ? ContentSampling::subpixel : ContentSampling::pixel);
    if (by_subpixel) near(views.at("other_sampling"), ContentSampling::pixel);
}

TEST(CrosstalkPictures, LightUpWholePixels) {
    expect_as_pictured({LatticeKind::square, 7.23, 0, 0});
    expect_as_pictured({LatticeKind::hexagon, 6.31, 0, 0, SubpixelLayout::rgb_stripe});
    expect_as_pictured({LatticeKind::strips, 6, 18.4349, 0.5, SubpixelLayout::rgb_stripe});
}

TEST(CrosstalkPictures, OfEveryLatticeAtLength) {
    for (const LatticeKind lattice :
         {LatticeKind::square, LatticeKind::rectangle, LatticeKind::brick, LatticeKind::hexagon, LatticeKind::strips}) {
        // A quarter of a pitch to either side of an even number of pixels staggered lenses stand on pixels' centres.
        const double even = lattice == LatticeKind::brick || lattice == LatticeKind::hexagon ? 0 : 0.5;
        expect_as_pictured({lattice, 7.23, 0, 0});
        expect_as_pictured({lattice, 6.31, 0, 0, SubpixelLayout::rgb_stripe});
        expect_as_pictured({lattice, 6, 0, even, SubpixelLayout::pentile_rgbg});
    }
    expect_as_pictured({LatticeKind::square, 5, 0, 0, SubpixelLayout::delta});
    for (const double slant : {18.4349, -9.46}) {
        expect_as_pictured({LatticeKind::strips, 7.23, slant, 0});
        expect_as_pictured({LatticeKind::strips, 6, slant, 0.5, SubpixelLayout::rgb_stripe});
    }
    expect_as_pictured({LatticeKind::strips, 6, 0, 0, SubpixelLayout::none, 0.5 * pixel_mm});
    expect_as_pictured({LatticeKind::square, 5, 0, 0.5, SubpixelLayout::none, 0.5 * pixel_mm});
}

}  // namespace
}  // namespace lfdsim::crosstalk_pictures
