// The filtered estimator on displays at the ends of what is allowed, drawn at random from a fixed seed: its light stays light.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>

#include "engine/scene/traced_display.h"
#include "pictures.h"

namespace lfdsim {
namespace {

/// Draws displays; most of their numbers are at, or near, the ends of their ranges.
class Extremes {
  public:
    /// Of squares seen by a pinhole through pixels' centres, or of every lattice and camera.
    explicit Extremes(unsigned seed, bool every_lattice = false) : random(seed), every(every_lattice) {}

    /// The next valid one.
    Display operator()() {
        for (;;) {
            const Display d = draw();
            if (validate(d).empty()) return d;
        }
    }

  private:
    bool chance(double p) { return random(0, 1) < p; }
    template <class T>
    T one_of(std::initializer_list<T> choices) {
        return *std::next(choices.begin(), std::ptrdiff_t(random(0, double(choices.size()))));
    }
    double over_decades(double low, double high) { return low * std::pow(high / low, random(0, 1)); }
    std::int64_t up_to(double most) { return std::int64_t(random(1, most + 1)); }

    Display draw() {
        Display d = chance(0.3) ? ideal_example() : example();
        const double pitch = chance(0.5) ? 4 : over_decades(0.05, 200), scale = pitch / 4;
        d.panel.pixels = {200, 150};
        if (chance(0.2)) d.panel.pixels = {up_to(200), up_to(200)};
        if (chance(0.05)) d.panel.pixels = {1, 1};
        d.panel.pixel_pitch_mm = (chance(0.75) ? 0.25 : over_decades(0.01, 30)) * scale;
        d.panel.emission_exponent = one_of({0.0, 0.0, 1.0, 7.5});
        d.array.count = {up_to(50), up_to(50)};
        if (chance(0.1)) d.array.count = {1, 1};
        d.array.pitch_mm = pitch;
        d.array.aperture = one_of({Aperture::circle, Aperture::cell});
        if (chance(0.15)) d.array.offset_mm = {random(-100, 100) * scale, random(-1, 1) * scale};
        draw_lens(d, scale);
        draw_diffuser(d, scale);
        draw_camera(d, scale);
        if (every) draw_lattice(d, scale);
        d.render.estimator = Estimator::filtered;
        d.render.fresnel = one_of({Fresnel::exact, Fresnel::none});
        d.render.samples = one_of<std::int64_t>({1, 4, 9, 100, 1024, 3844});
        return d;
    }

    void draw_lens(Display& d, double scale) {
        d.array.gap_mm = (chance(0.9) ? 7 : over_decades(2, 400)) * scale;
        if (auto* ideal = std::get_if<IdealLens>(&d.lens.kind)) {
            ideal->focal_length_mm = (chance(0.8) ? 6 : over_decades(0.01, 1e4)) * scale;
            if (d.array.aperture == Aperture::circle)
                ideal->aperture_radius_mm = (chance(0.8) ? random(1, 2) : random(0.01, 1)) * scale;
        } else {
            auto& ball = d.lens.as<PlanoConvex>();
            ball.sphere_radius_mm = (chance(0.5) ? 3 : random(2, 8)) * scale;
            ball.aperture_radius_mm = (chance(0.8) ? random(1, 2) : over_decades(0.01, 1)) * scale;
            ball.cylinder_height_mm = random(0, 1) * scale;
            ball.facing = one_of({Facing::viewer, Facing::viewer, Facing::panel});
            d.array.surround = one_of({Surround::opaque, Surround::opaque, Surround::clear, Surround::plate});
        }
        if (chance(0.15)) d.lens.stop_radius_mm = over_decades(0.2, 2) * scale;
    }

    void draw_diffuser(Display& d, double scale) {
        auto angle = [&] { return one_of({0.0, 1e-3, 1.0, 5.7, 5.7, 5.7, 5.7, 20.0, 60.0, 179.0}); };
        Diffuser diffuser{0, {angle(), angle()}, one_of({Profile::box, Profile::box, Profile::gaussian})};
        const double depth = chance(0.3) ? over_decades(1e-6, 1) : over_decades(1, chance(0.8) ? 100 : 1e4);
        const auto* ball = std::get_if<PlanoConvex>(&d.lens.kind);
        const double top = ball ? 2 * ball->sphere_radius_mm : 0;  // no lens reaches further above its vertex plane
        diffuser.distance_mm = chance(0.5) ? depth * scale : one_of({1e-6, top}) + depth * scale;
        d.diffuser = diffuser;
    }

    void draw_camera(Display& d, double scale) {
        const double away = (chance(0.7) ? 400 : over_decades(1, 1e5)) * scale + d.diffuser->distance_mm;
        look_from(d, one_of({0.0, 0.0, 0.0, 1.0, 30.0, 30.0, 60.0, 80.0}), away);
        d.camera.position_mm[1] = one_of({0.0, 0.0, 0.4, -2.0}) * away;
        d.camera.target_mm = {random(-5, 5) * scale, random(-5, 5) * scale, chance(0.95) ? 0 : random(0, 2) * away};
        d.camera.resolution = {up_to(100), up_to(70)};
        if (chance(0.1)) d.camera.resolution = {1, 1};
        d.camera.frame_width_mm = (chance(0.8) ? 44 : over_decades(1e-3, 1e3)) * scale;
    }

    void draw_lattice(Display& d, double scale) {
        d.array.lattice = one_of({LatticeKind::square, LatticeKind::hexagon, LatticeKind::brick, LatticeKind::strips});
        const double pitch = d.array.pitch_mm[0];
        if (d.array.lattice == LatticeKind::brick) d.array.pitch_mm = {pitch, random(0.8, 1.2) * pitch};
        if (d.array.lattice == LatticeKind::strips) {
            d.array.count = {up_to(50), 1};
            d.array.slant_deg = chance(0.3) ? 0 : random(-89, 89);
            if (chance(0.9)) d.array.aperture = Aperture::cell;
        } else if (chance(0.4)) {
            d.array.rotation_deg = random(-180, 180);
        }
        if (chance(0.5)) d.camera.pixel_filter = PixelFilter::box;
        if (chance(0.3)) d.camera.pupil_diameter_mm = over_decades(0.1, 10) * scale;
        if (chance(0.4)) d.diffuser.reset();
        if (!d.diffuser) d.camera.pixel_filter = PixelFilter::box;
    }

    Random random;
    bool every;
};

std::string about(int number, const Display& d) {
    auto text = [](double x) { return std::to_string(x) + " "; };
    return std::to_string(number) + ": lens " + std::to_string(int(d.lens.type())) + ", surround " +
           std::to_string(int(d.array.surround)) + ", lattice " + std::to_string(int(d.array.lattice)) + ", pitch " +
           text(d.array.pitch_mm[0]) + text(d.array.pitch_mm[1]) + ", turned " + text(d.array.turn_deg()) +
           (d.diffuser ? ", diffuser " + text(d.diffuser->distance_mm) + text(d.diffuser->angle_deg[0]) +
                             text(d.diffuser->angle_deg[1]) + (d.diffuser->profile == Profile::box ? "box" : "gaussian")
                       : "") +
           (d.camera.pixel_filter == PixelFilter::box ? ", box filter" : "") + ", pupil " +
           text(d.camera.pupil_diameter_mm.value_or(0)) + ", from " + text(d.camera.position_mm[0]) +
           text(d.camera.position_mm[1]) + text(d.camera.position_mm[2]) + ", frame " + text(*d.camera.frame_width_mm) +
           std::to_string(d.camera.resolution[0]) + " x " + std::to_string(d.camera.resolution[1]) + ", samples " +
           std::to_string(*d.render.samples);
}

/// A part of the frame, about its middle, that takes about so many samples.
Rect small_part(const Display& d, double samples) {
    const auto [columns, rows] = d.camera.resolution;
    const double pixels = samples / double(*d.render.samples);
    const int width = std::min(int(columns), std::max(8, int(std::sqrt(pixels)))),
              height = std::clamp(int(pixels / width), 1, int(rows)), x = (int(columns) - width) / 2, y = (int(rows) - height) / 2;
    return {x, y, x + width, y + height};
}

/// Is no stratum of 32 x 32 so wide that its rays spread unevenly over the lenses?
bool benign(const Display& d) { return !d.diffuser || std::max(d.diffuser->angle_deg[0], d.diffuser->angle_deg[1]) <= 60; }

void light_stays_light(int drawn_displays, std::uint64_t hash) {
    Extremes extremes(5);
    int lit = 0;
    Bits bits;
    for (int n = 0; n < drawn_displays; ++n) {
        const Display d = extremes();
        const Texels panel = noise_panel(d);
        const Rect part = small_part(d, 5e4);
        RenderOptions options{1, "scalar", part};
        options.rough = true;  // filtered light alone
        const Image reference = picture(d, panel, options);
        bits.add(reference);
        for (const float x : reference.rgb) {
            if (!(x >= 0 && x <= 1 + 1e-5f)) {
                ADD_FAILURE() << x << ", " << about(n, d);
                break;
            }
        }
        lit += mean_light(reference) > 0.01;
        for (const KernelInfo& kernel : kernels()) {
            if (!kernel.available || kernel.name == "scalar") continue;
            options.threads = 2;
            options.kernel = kernel.name;
            const Image other = picture(d, panel, options);
            EXPECT_EQ(0, std::memcmp(other.rgb.data(), reference.rgb.data(), reference.rgb.size() * sizeof(float)))
                << kernel.name << ", " << about(n, d);
        }
    }
    EXPECT_GT(lit, drawn_displays / 3);
    EXPECT_EQ(bits.hash(), hash);
}
TEST(FilteredExtremes, LightStaysLight) { light_stays_light(100, 0x5c1476620b54c4d0); }
TEST(FilteredExtremes, LightStaysLightAtLength) { light_stays_light(300, 0x4ecbfe08bce4ecc0); }

/// Of the light of a picture that sees few of the diffuser's angles: a sum of boxes has a bell's moments, not its value everywhere.
double form_error(const Display& d) { return d.diffuser && d.diffuser->profile == Profile::gaussian ? 0.16 : 0.02; }

void mean_is_that_of_brute_force(int drawn_displays) {
    Extremes extremes(6);
    int compared = 0;
    for (int n = 0; n < drawn_displays; ++n) {
        Display d = extremes();
        if (!benign(d)) continue;
        d.render.samples = 1024;
        const Texels panel = noise_panel(d);
        const Rect part = small_part(d, 2e5);
        const Image filtered = picture(d, panel, {0, "", part});
        d.render.estimator = Estimator::point;
        d.render.sampling = Sampling::random;
        const Image points = picture(d, panel, {0, "", part});
        const double truth = mean_light(points), pixels = double(points.rgb.size()) / 3;
        const double standard_error = std::sqrt(truth / (pixels * double(*d.render.samples)));  // light is at most 1
        EXPECT_NEAR(mean_light(filtered), truth, 4 * standard_error + form_error(d) * truth + 1e-4) << about(n, d);
        compared += truth > 0.01;
    }
    EXPECT_GT(compared, drawn_displays / 4);
}
TEST(FilteredExtremes, TheMeanIsThatOfBruteForce) { mean_is_that_of_brute_force(20); }
TEST(FilteredExtremes, TheMeanIsThatOfBruteForceAtLength) { mean_is_that_of_brute_force(300); }

void holds_on_every_lattice_and_camera(int drawn_displays, std::uint64_t hash) {
    Extremes extremes(9, true);
    int compared = 0;
    Bits bits;
    for (int n = 0; n < drawn_displays; ++n) {
        Display d = extremes();
        d.render.samples = std::min<std::int64_t>(*d.render.samples, 100);
        const Texels panel = noise_panel(d);
        const Rect part = small_part(d, 2e4);
        const Image reference = picture(d, panel, {1, "scalar", part});
        bits.add(reference);
        // The pupil's shares are of the same light from neighbouring places, so those of two lenses may add up to a little more.
        for (const float x : reference.rgb) {
            if (!(x >= 0 && x <= 1.001f)) {
                ADD_FAILURE() << x << ", " << about(n, d);
                break;
            }
        }
        for (const KernelInfo& kernel : kernels()) {
            if (!kernel.available || kernel.name == "scalar") continue;
            const Image other = picture(d, panel, {2, kernel.name, part});
            EXPECT_EQ(0, std::memcmp(other.rgb.data(), reference.rgb.data(), reference.rgb.size() * sizeof(float)))
                << kernel.name << ", " << about(n, d);
        }
        if (!benign(d)) continue;
        d.render.samples = 256;
        const Rect whole = small_part(d, 1e5);
        const Image filtered = picture(d, panel, {0, "", whole});
        d.render.estimator = Estimator::point;
        d.render.sampling = Sampling::random;
        const Image points = picture(d, panel, {0, "", whole});
        const double truth = mean_light(points), pixels = double(points.rgb.size()) / 3;
        const double standard_error = std::sqrt(truth / (pixels * double(*d.render.samples)));
        if (truth < 1e-3) continue;
        EXPECT_NEAR(mean_light(filtered), truth, 4 * standard_error + form_error(d) * truth + 1e-4) << about(n, d);
        compared += truth > 0.01;
    }
    EXPECT_GT(compared, drawn_displays / 5);
    EXPECT_EQ(bits.hash(), hash);
}
TEST(FilteredExtremes, OfEveryLatticeAndCamera) { holds_on_every_lattice_and_camera(25, 0xa640404ce78bd480); }
TEST(FilteredExtremes, OfEveryLatticeAndCameraAtLength) { holds_on_every_lattice_and_camera(150, 0xc5bf970ec93b8125); }

}  // namespace
}  // namespace lfdsim
