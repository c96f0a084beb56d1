// The tracer in single precision against itself in double, ray by ray, on the shipped displays.
#include <gtest/gtest.h>

#include <filesystem>

#include "../optics/example.h"
#include "files/description/display_file.h"

namespace lfdsim {
namespace {

using optics::Facts;
using optics::PanelHit;
using optics::RayOrigin;
using optics::Sampler;
using optics::TracedDisplay;
using Rows = optics::Specialisations;

/// Sample `sample` of a pixel.
template <class F>
PanelHit<F> trace(const TracedDisplay<F>& scene, const RayOrigin& view, int column, int row, Sampling sampling, int sample) {
    const std::uint32_t pixel = std::uint32_t(row) * std::uint32_t(view.width) + std::uint32_t(column);
    Sampler<F> sampler(sampling, optics::sampler_dimensions, view.seed, pixel);
    for (int n = 0; n < sample; ++n) sampler.next(sobol_directions());
    const auto rays = optics::pixel_rays<F>(view, column, row);
    return optics::with_facts(scene, [&]<Facts facts>() { return optics::trace<facts>(scene, view, rays, sampler); });
}

/// Does a double-precision ray through a point at most 0.02 pixels away, in the picture, do what the single-precision one did?
/// Paths among clear lenses may magnify a shift ten thousand times, so the steps begin small.
template <class Same>
bool explained(const RayOrigin& view, Same same) {
    for (double pixels = 0.02; pixels > 1e-6; pixels /= 2) {
        for (int turn = 0; turn < 16; ++turn) {
            RayOrigin shifted = view;
            const double x = pixels * view.pixel_mm * std::cos(turn * 22.5 * degree) / view.distance;
            const double y = pixels * view.pixel_mm * std::sin(turn * 22.5 * degree) / view.distance;
            for (int a = 0; a < 3; ++a) shifted.forward[a] += view.right[a] * x + view.up[a] * y;
            if (same(shifted)) return true;
        }
    }
    return false;
}

/// Share of rays that reach the same panel pixel, or none, in both; every other one must be explained.
double share_alike(const Display& d) {
    const Geometry g = resolve(d);
    const TracedDisplay<float> narrow = make_traced_display<float>(d, g);
    const TracedDisplay<double> wide = make_traced_display<double>(d, g);
    const RayOrigin view = make_ray_origin(d, g);
    int all = 0, alike = 0;
    for (int row = 3; row < view.height; row += 23) {
        for (int column = 5; column < view.width; column += 23) {
            const int sample = all % 16;
            const auto a = trace(narrow, view, column, row, d.render.sampling, sample);
            auto same = [&](const RayOrigin& seen) {
                const auto b = trace(wide, seen, column, row, d.render.sampling, sample);
                // where both are lit the light is the same too, to 1e-3 near grazing exits
                return a.lit == b.lit && (!a.lit || (a.pixel == b.pixel && std::abs(double(a.weight) - b.weight) < 1e-3));
            };
            ++all;
            const bool as_in_double = same(view);
            alike += as_in_double;
            EXPECT_TRUE(as_in_double || explained(view, same))
                << d.name << " pixel " << column << ", " << row << " sample " << sample;
        }
    }
    return double(alike) / all;
}

class Accuracy : public testing::TestWithParam<std::string> {};
std::vector<std::string> shipped() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(LFDSIM_SOURCE_DIR "/displays"))
        names.push_back(entry.path().stem());
    std::sort(names.begin(), names.end());
    return names;
}
INSTANTIATE_TEST_SUITE_P(Shipped, Accuracy, testing::ValuesIn(shipped()), [](const auto& display) {
    std::string name = display.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
});

// A place on the panel is good to some 1e-5 of its pixel of 0.136 mm, so that one ray in 10000 may fall on the other side of an
// edge; in clear glass, off axis, a path crosses several curved faces and walls, each of which magnifies.
TEST_P(Accuracy, FloatIsAsGoodAsDouble) {
    Display d = read_display(LFDSIM_SOURCE_DIR "/displays/" + GetParam() + ".toml");
    for (double angle : {0.0, 15.0, 30.0}) {
        look_from(d, angle, 2000);
        const double share = share_alike(d);
        RecordProperty("share_at_" + std::to_string(int(angle)) + "_degrees", std::to_string(share));
        std::printf("%-30s %2.0f degrees: %.4f %% alike\n", d.name.c_str(), angle, 100 * share);
        EXPECT_GE(share, d.array.surround == Surround::clear && angle > 0 ? 0.994 : 0.999) << angle;
    }
}

/// What the kernel knows that traces a display.
Facts known_of(const Display& d) {
    return optics::with_facts(make_traced_display<float>(d, resolve(d)), []<Facts facts>() { return facts; });
}

/// All rays of a display have the same bits by its own specialisation of the tracer and by a general one.
template <Facts general>
void expect_the_same_by(const Display& d) {
    ASSERT_TRUE(validate(d).empty());
    const Geometry g = resolve(d);
    const StoredDisplay<float> scene = make_traced_display<float>(d, g);
    const RayOrigin view = make_ray_origin(d, g);
    int lit = 0;
    for (int row = 1; row < view.height; row += 7) {
        for (int column = 2; column < view.width; column += 7) {
            const auto pixel = optics::pixel_rays<float>(view, column, row);
            Sampler<float> sampler(Sampling::random, optics::sampler_dimensions, 5, std::uint32_t(row * view.width + column));
            const auto by = [&]<Facts facts>() { return optics::trace<facts>(scene, view, pixel, sampler); };
            const PanelHit<float> a = optics::with_facts(scene, by), b = by.template operator()<general>();
            ASSERT_EQ(a.lit, b.lit);
            if (!a.lit) continue;
            ++lit;
            ASSERT_EQ(a.pixel, b.pixel);
            ASSERT_EQ(a.weight, b.weight);
        }
    }
    EXPECT_GT(lit, 100);
}

// Where several specialisations hold they do the same, bit by bit.
TEST(Specialisations, HaveTheBitsOfTheMostGeneral) {
    for (const LatticeKind lattice : {LatticeKind::square, LatticeKind::hexagon, LatticeKind::brick, LatticeKind::strips}) {
        for (const bool ideal : {false, true}) {
            Display d = example();
            d.array.lattice = lattice;
            d.array.count.reset();
            if (ideal) d.lens.kind = IdealLens{2, 8};
            d.diffuser = Diffuser{40, {8, 8}, Profile::box};
            look_from(d, 20, 400);
            EXPECT_EQ(known_of(d) == Rows::others, ideal && lattice != LatticeKind::square);
            expect_the_same_by<Rows::others>(d);
        }
    }
}

TEST(Specialisations, OfMisalignedArraysHaveTheBitsOfTheMostGeneral) {
    const Display aspheres = with_surfaces({{0, 0, {}, 1.9, 0.8, 1.5}, {-0.25, -0.4, {1e-3, 2e-5}, 1.9}});
    Errors moved, all;
    moved.decenter_sd_mm = all.decenter_sd_mm = 0.05;
    all.height_sd_mm = 0.02;
    all.tilt_sd_deg = 1;
    all.curvature_sd = 0.02;
    all.wedge_deg = {1, -2};
    for (const auto& [lens, facts] : {std::pair(example(), Rows::misaligned_paper), {aspheres, Rows::misaligned_opaque}}) {
        for (const Errors& errors : {moved, all}) {
            Display d = lens;
            d.array.pitch_mm = 4;
            d.errors = errors;
            d.diffuser = Diffuser{40, {8, 8}, Profile::box};
            look_from(d, 20, 400);
            EXPECT_TRUE(known_of(d) == facts);
            expect_the_same_by<Rows::misaligned>(d);
        }
    }
}

}  // namespace
}  // namespace lfdsim
