// Resolution of each channel, with subpixels and under glass that disperses, against lines of sight written down anew from
// docs/model.md.
#include "analysis/resolution/mtf_colour.h"
#include "analysis/core/channel_pixels.h"
#include "analysis/core/elemental_panel.h"
#include "analysis/resolution/mtf.h"
#include "analysis/resolution/mtf_curves.h"
#include "base/constants.h"
#include "engine/estimator/panel_planes.h"
#include "optics/traced_display.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <random>

namespace lfdsim::mtf_of_colours {
namespace {

constexpr double eye_mm = 1500, gap = 8, pitch = 5, pixel = 0.25, plate = 3, nd = 1.6, vd = 12, small_radius = 1;

/// 40 x 30 ideal lenses with 20 x 20 views of 5 mm, seen from 1500 mm, the central depth plane 120 mm before them.
Display coloured(SubpixelLayout layout, ContentSampling sampling, bool with_plate) {
    Display d;
    d.panel.pixels = {800, 600};
    d.panel.pixel_pitch_mm = pixel;
    d.panel.subpixels = layout;
    d.panel.aperture_ratio = layout == SubpixelLayout::none ? 1 : 0.6;
    if (with_plate) d.panel.layers = {{plate, {}, Glass{"", Formula::nd_vd, {nd, vd}}}};
    d.lens.kind = IdealLens{{}, 1 / (1 / gap + 1 / 120.)};
    d.array.count = {40, 30};
    d.array.pitch_mm = pitch;
    d.array.gap_mm = gap;
    d.array.aperture = Aperture::cell;
    if (with_plate) {  // a plate blurs what fast lenses show
        d.array.aperture = Aperture::circle;
        d.lens.as<IdealLens>().aperture_radius_mm = small_radius;
    }
    d.camera.position_mm = {0, 0, eye_mm};
    d.content.viewing_distance_mm = eye_mm;
    d.content.sampling = sampling;
    return d;
}

double index_of(double wavelength_nm) {
    const auto per_square = [](double nm) { return 1e6 / (nm * nm); };
    const double b = (nd - 1) / vd / (per_square(486.1327) - per_square(656.2725));
    return nd + b * (per_square(wavelength_nm) - per_square(587.5618));
}

using Offsets = std::array<std::vector<double>, 2>;

/// How far, along x and y, the point shown lies from the point looked at, for random lines that meet a stripe of a channel.
Offsets stripe_offsets(const Display& d, int channel, double depth, double angle_deg, double share) {
    std::mt19937_64 engine(5);
    const auto uniform = [&](double low, double high) { return low + (high - low) * double(engine() >> 11) * 0x1p-53; };
    const bool layered = !d.panel.layers.empty(), stripes = d.panel.subpixels == SubpixelLayout::rgb_stripe;
    const double n = layered ? index_of(d.panel.wavelengths_nm[std::size_t(channel)]) : 1, thick = layered ? plate : 0;
    const double lens_z = gap + thick - thick / (layered ? index_of(d.panel.wavelengths_nm[1]) : 1);
    const double f = d.lens.as<IdealLens>().focal_length_mm, shrink = std::sqrt(d.panel.aperture_ratio);
    const double eye[2] = {eye_mm * std::sin(angle_deg * degree), 0}, above = eye_mm * std::cos(angle_deg * degree) - lens_z;
    Offsets all;
    while (all[0].size() < 40000) {
        const double at[2] = {share * uniform(-100, 100), share * uniform(-75, 75)};
        double slope[2], below[2], seen[2], shown[2], off_axis[2];
        for (int k = 0; k < 2; ++k) {
            slope[k] = (eye[k] - at[k]) / above;
            off_axis[k] = at[k] - (std::floor(at[k] / pitch) + 0.5) * pitch;
            below[k] = slope[k] + off_axis[k] / f;
        }
        if (layered && std::hypot(off_axis[0], off_axis[1]) > small_radius) continue;
        const double tangent = std::hypot(below[0], below[1]), sine = tangent / std::sqrt(1 + tangent * tangent) / n,
                     inside = sine / std::sqrt(1 - sine * sine) / tangent;
        for (int k = 0; k < 2; ++k) seen[k] = at[k] - (lens_z - thick) * below[k] - thick * inside * below[k];
        if (std::abs(seen[0]) > 100 || std::abs(seen[1]) > 75) continue;
        const double column = std::floor(seen[0] / pixel), row = std::floor(seen[1] / pixel);
        const double lit = stripes ? (channel + 0.5) / 3 : 0.5;
        if (std::abs(seen[0] / pixel - column - lit) > shrink / (stripes ? 6 : 2) ||
            std::abs(seen[1] / pixel - row - 0.5) > shrink / 2)
            continue;
        const double middle = d.content.sampling == ContentSampling::subpixel ? lit : 0.5;
        shown[0] = (column + middle) * pixel, shown[1] = (row + 0.5) * pixel;
        for (int k = 0; k < 2; ++k) {
            const double owner = (std::floor(shown[k] / (1 + gap / (eye_mm - lens_z)) / pitch) + 0.5) * pitch;
            all[std::size_t(k)].push_back(owner + depth * (owner - shown[k]) / gap - at[k] - depth * slope[k]);
        }
    }
    return all;
}

std::complex<double> transform(const std::vector<double>& offsets, double frequency) {
    std::complex<double> sum = 0;
    for (const double off : offsets) sum += std::polar(1., 2 * pi * frequency * off);
    return sum / double(offsets.size());
}

double mean_of(const std::vector<double>& all) {
    double sum = 0;
    for (const double x : all) sum += x / double(all.size());
    return sum;
}

Subject subject_of(const Display& d, std::vector<double> depths) {
    AnalysisOptions options;
    options.depths_mm = std::move(depths);
    return Subject(d, {}, options);
}

void expect_that_of_nodal_rays(std::initializer_list<double> angles_deg, std::initializer_list<double> depths_mm) {
    struct Case {
        SubpixelLayout layout;
        ContentSampling sampling;
        bool layered;
    };
    // Theory is of pixels in no step with the lenses, and paraxial.
    for (const Case& k : {Case{SubpixelLayout::rgb_stripe, ContentSampling::subpixel, false},
                          {SubpixelLayout::rgb_stripe, ContentSampling::pixel, false},
                          {SubpixelLayout::none, ContentSampling::pixel, true},
                          {SubpixelLayout::rgb_stripe, ContentSampling::subpixel, true}}) {
        const Subject s = subject_of(coloured(k.layout, k.sampling, k.layered), {});
        for (const double angle : angles_deg) {
            const bool paraxial = !k.layered || angle == 0;  // oblique light in a plate is not
            const SeenInColours seen =
                seen_in_colours(s, {eye_mm * std::sin(angle * degree), 0, eye_mm * std::cos(angle * degree)});
            for (const double depth : depths_mm) {
                std::array<Offsets, 3> expected;
                for (int c = 0; c < 3; ++c) expected[std::size_t(c)] = stripe_offsets(s.display(), c, depth, angle, 1);
                for (const Direction& direction : directions(s.geometry())) {
                    const auto axis = std::size_t(direction.axis);
                    const MtfCurves m = mtf_curves(s, seen, depth, angle, direction);
                    const auto where = [&](double f) {
                        return fmt::format("{} {} {}, {} mm, {} degrees, {}, {} per mm", int(k.layout), int(k.sampling), k.layered,
                                           depth, angle, direction.name, f);
                    };
                    ASSERT_EQ(m.channels.size(), 3u) << where(0);
                    for (std::size_t n = 0; n < m.frequencies_per_mm.size(); n += 20) {
                        const double f = m.frequencies_per_mm[n];
                        std::complex<double> luminance = 0;
                        for (std::size_t c = 0; c < 3; ++c) {
                            const std::complex<double> wave = transform(expected[c][axis], f);
                            luminance += luminance_weights[c] * wave;
                            EXPECT_NEAR(m.channels[c].modulation.all[n], std::abs(wave), 0.015) << where(f) << " " << c;
                            if (paraxial) {
                                EXPECT_NEAR(m.channels[c].theory[n], m.channels[c].pixels_anywhere[n], 0.03)
                                    << where(f) << " " << c;
                            }
                        }
                        EXPECT_NEAR(m.modulation.all[n], std::abs(luminance), 0.015) << where(f);
                        if (paraxial) {
                            EXPECT_NEAR(m.theory[n], m.pixels_anywhere[n], 0.03) << where(f);
                        }
                    }
                    for (const std::size_t c : {0u, 2u}) {
                        const double fringe = mean_of(expected[c][axis]) - mean_of(expected[1][axis]);
                        EXPECT_NEAR(m.channels[c].middle_mm.value - m.channels[1].middle_mm.value, fringe,
                                    m.channels[c].middle_mm.error + m.channels[1].middle_mm.error + 0.02)
                            << where(0);
                        EXPECT_NEAR(m.channels[c].theory_middle_mm - m.channels[1].theory_middle_mm, fringe,
                                    0.04 + 0.1 * std::abs(fringe))
                            << where(0);
                    }
                }
            }
        }
    }
}

TEST(MtfOfColours, IsThatOfTheNodalRaysDifferencesAndOfTheory) { expect_that_of_nodal_rays({9}, {170}); }
TEST(MtfOfColours, IsThatOfTheNodalRaysDifferencesAndOfTheoryAtLength) { expect_that_of_nodal_rays({0, 9}, {80, 170}); }

// A black matrix by itself leaves one colour for all, and pixels as wide as what shines of them.
TEST(MtfOfColours, ABlackMatrixNarrowsTheImagesOfPixels) {
    constexpr double depth = 170;
    Display d = coloured(SubpixelLayout::none, ContentSampling::pixel, false);
    d.panel.aperture_ratio = 0.36;
    const Subject s = subject_of(d, {});
    const MtfCurves m = mtf_curves(s, seen_in_colours(s, {0, 0, eye_mm}), depth, 0, directions(s.geometry()).front());
    const std::vector<double> expected = stripe_offsets(d, 1, depth, 0, 1)[0];
    EXPECT_TRUE(m.channels.empty());
    for (std::size_t n = 0; n < m.frequencies_per_mm.size(); n += 10) {
        const double f = m.frequencies_per_mm[n];
        EXPECT_NEAR(m.modulation.all[n], std::abs(transform(expected, f)), 0.015) << f;
        EXPECT_NEAR(m.theory[n], m.pixels_anywhere[n], 0.03) << f;
    }
}

// By pixels, red's stripe shows what is a third of a pixel's image to its side.
TEST(MtfOfColours, ContentByPixelsMakesFringesAsWideAsAThirdOfAPixelsImage) {
    const Subject s = subject_of(coloured(SubpixelLayout::rgb_stripe, ContentSampling::pixel, false), {});
    const MtfCurves m = mtf_curves(s, seen_in_colours(s, {0, 0, eye_mm}), 120, 0, directions(s.geometry()).front());
    const double third = pixel * 120 / gap / 3;
    EXPECT_NEAR(m.channels[0].middle_mm.value - m.channels[1].middle_mm.value, -third, 0.02);
    EXPECT_NEAR(m.channels[2].middle_mm.value - m.channels[1].middle_mm.value, third, 0.02);
}

// A few lenses in rows turned by 30 degrees against the pixels: where the pixels happen to lie, red is 0.018 mm from green, which
// ideal lenses do not separate. The error says so.
TEST(MtfOfColours, TheErrorOfFringesCoversThePixelsPositions) {
    Display d = coloured(SubpixelLayout::rgb_stripe, ContentSampling::subpixel, false);
    d.array.lattice = LatticeKind::hexagon;
    d.array.rotation_deg = 30;
    const Subject s = subject_of(d, {});
    const MtfCurves m = mtf_curves(s, seen_in_colours(s, {0, 0, eye_mm}), 48, 0, directions(s.geometry()).front());
    ASSERT_EQ(m.missing, "");
    const Json found = colours_json(m);
    for (const char* colour : {"red", "blue"})
        EXPECT_NEAR(found.at("from_green_mm").at(colour).get<double>(), found.at("theory_from_green_mm").at(colour).get<double>(),
                    2 * found.at("from_green_mm_error").at(colour).get<double>())
            << found;
    EXPECT_GT(found.at("from_green_mm_error").at("red"), 0.001);
}

TEST(MtfOfColours, FiguresEdgesAndTablesTellThemApart) {
    Subject s = subject_of(coloured(SubpixelLayout::rgb_stripe, ContentSampling::subpixel, false), {150});
    Job job;
    const Result result = measure_mtf(s, job);
    const double slant = result.figures["slant_deg"].get<double>() * degree;
    for (const Json& m : result.figures["measurements"]) {
        if (m["angle_deg"] != 0) continue;
        const bool horizontal = m["direction"] == "horizontal";
        for (std::size_t c = 0; c < 3; ++c) {
            const char* colour = std::array{"red", "green", "blue"}[c];
            const Offsets off = stripe_offsets(s.display(), int(c), 150, 0, 0.75);
            std::vector<double> across;
            for (std::size_t k = 0; k < off[0].size(); ++k)
                across.push_back(horizontal ? off[0][k] * std::cos(slant) - off[1][k] * std::sin(slant)
                                            : off[0][k] * std::sin(slant) - off[1][k] * std::cos(slant));
            EXPECT_NEAR(std::abs(transform(across, m["edge_mtf50_per_mm"][colour])), 0.5, 0.09)
                << m["direction"] << colour;  // of 400 lenses
            EXPECT_NEAR(m["mtf50_per_mm"][colour], m["colour"]["theory_mtf50_per_mm"][colour].get<double>(),
                        m["mtf50_per_mm_error"][colour].get<double>() + 0.01 * m["mtf50_per_mm"][colour].get<double>());
        }
        EXPECT_TRUE(m["mtf50_per_mm"]["luminance"].is_number());
    }
    bool found = false;
    for (const DataTable& t : result.tables)
        if (t.name == "mtf_horizontal") found = t.columns.back().name == "theory_blue" && !t.columns.back().values.empty();
    EXPECT_TRUE(found);
    ASSERT_EQ(result.pictures.size(), 1u);
    EXPECT_EQ(result.pictures[0].name, "mtf-edge");
}

// An edge is drawn for each channel's own place on the panel, or for the pixels'.
TEST(MtfOfColours, EdgesAreMadeForSubpixels) {
    for (const ContentSampling sampling : {ContentSampling::subpixel, ContentSampling::pixel}) {
        const Display d = coloured(SubpixelLayout::rgb_stripe, sampling, false);
        const Geometry g = resolve(d);
        Bars bars = bars_across(directions(g).front(), g.vertex_plane_mm + 120);
        bars.width_mm = 1e6;
        const auto panel = bars_panel(d, g, bars, 1);
        const optics::SummedImage& level = planes_of(panel->summed()).front();
        std::int64_t wrong = 0, differ = 0;
        for (std::uint32_t row = 0; row < level.rows; ++row)
            for (std::uint32_t column = 0; column < level.columns; ++column) {
                const float* texel = level.texels + 4 * (std::size_t(row) * level.columns + column);
                differ += texel[0] != texel[1] || texel[1] != texel[2];
                for (int c = 0; c < 3; ++c) {
                    const double place = sampling == ContentSampling::subpixel ? (c + 0.5) / 3 : 0.5;
                    const double at[2] = {(column + place - 400) * pixel, (299.5 - row) * pixel};
                    double shown[2];
                    for (int k = 0; k < 2; ++k) {
                        const double owner = (std::floor(at[k] / (1 + gap / (eye_mm - gap)) / pitch) + 0.5) * pitch;
                        shown[k] = owner + 120 * (owner - at[k]) / gap;
                    }
                    const double far = shown[0] * across(bars)[0] + shown[1] * across(bars)[1];
                    wrong += std::abs(far) > 1e-6 && (texel[c] == 1) != (far > 0);
                }
            }
        EXPECT_EQ(wrong, 0);
        EXPECT_EQ(differ > 0, sampling == ContentSampling::subpixel);
    }
}

TEST(MtfOfColours, WithoutThemAllIsOne) {
    Subject s = subject_of(coloured(SubpixelLayout::none, ContentSampling::subpixel, false), {150});
    const MtfCurves m = mtf_curves(s, seen_in_colours(s, {0, 0, eye_mm}), 150, 0, directions(s.geometry()).front());
    EXPECT_TRUE(m.channels.empty());
    for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_EQ(m.below(0.5, c).found.value, m.below(0.5).found.value);
        EXPECT_EQ(m.theory_below(0.5, c), m.theory_below(0.5));
    }
}

// Of layouts whose subpixels differ from pixel to pixel theory alone is the other opinion.
TEST(MtfOfColours, OfOtherLayoutsIsThatOfTheory) {
    for (const SubpixelLayout layout : {SubpixelLayout::pentile_rgbg, SubpixelLayout::delta, SubpixelLayout::rgb_rows})
        for (const ContentSampling sampling : {ContentSampling::subpixel, ContentSampling::pixel}) {
            const Subject s = subject_of(coloured(layout, sampling, false), {});
            const SeenInColours seen = seen_in_colours(s, {0, 0, eye_mm});
            for (const Direction& direction : directions(s.geometry())) {
                const MtfCurves m = mtf_curves(s, seen, 140, 0, direction);
                for (std::size_t n = 0; n < m.frequencies_per_mm.size(); n += 10)
                    for (std::size_t c = 0; c < 3; ++c)
                        EXPECT_NEAR(m.channels[c].modulation.all[n], m.channels[c].theory[n], 0.03)
                            << int(layout) << int(sampling) << direction.name << m.frequencies_per_mm[n] << " " << c;
            }
        }
}

// In odd rows of the delta layout blue reaches over its pixel's right border by half of one: there the first column's begins with
// that of no pixel, and the last column's is cut.
TEST(ChannelPixels, ArePartsOfPixelsOnThePanel) {
    Display d = coloured(SubpixelLayout::delta, ContentSampling::subpixel, false);
    d.panel.pixels = {10, 6};
    const ChannelPixels blue(d, 2);
    EXPECT_FALSE(blue.at({0.33, 1.5}));
    for (const double column : {1., 5., 9.}) EXPECT_TRUE(blue.at({column + 0.33, 1.5})) << column;
    EXPECT_TRUE(blue.at({0.83, 0.5}));
    EXPECT_FALSE(blue.at({0.83, 6.5}));
}

// Where a channel shines, and for which point, against a search over the rectangles as they are described.
TEST(ChannelPixels, AreTheDescribedRectangles) {
    Display d = coloured(SubpixelLayout::delta, ContentSampling::subpixel, false);
    const double half = 0.5 * std::sqrt(0.6);
    for (int c = 0; c < 3; ++c) {
        const ChannelPixels pixels(d, std::size_t(c));
        EXPECT_NEAR(pixels.gain(), 3 / 0.6, 1e-12);
        for (double y = 4.03; y < 8; y += 0.17)
            for (double x = 4.01; x < 8; x += 0.043) {
                const double row = std::floor(y), moved = std::fmod(row, 2) == 1 ? 0.5 : 0;
                const double column = std::floor(x - moved), off = x - moved - column - (c + 0.5) / 3;
                const bool lit = std::abs(off) < half / 3 && std::abs(y - row - 0.5) < half;
                const auto found = pixels.at({x, y});
                ASSERT_EQ(found.has_value(), lit) << c << " " << x << " " << y;
                if (!lit) continue;
                EXPECT_NEAR(found->shown[0], column + moved + (c + 0.5) / 3, 1e-12);
                EXPECT_NEAR(found->shown[1], row + 0.5, 1e-12);
                EXPECT_NEAR(found->brightness, 3 / 0.6, 1e-12);
            }
    }
}

}  // namespace
}  // namespace lfdsim::mtf_of_colours
