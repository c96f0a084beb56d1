// Panels and displays for the tests of the renderer.
#pragma once
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "../model/panels.h"
#include "../optics/example.h"
#include "engine/render.h"

namespace lfdsim {

/// A panel of one light everywhere.
inline Texels uniform_panel(const Display& d, float light) {
    Texels panel(d.panel.pixels[0], d.panel.pixels[1]);
    for (std::int64_t k = 0; k < panel.columns() * panel.rows() * 4; ++k) panel.data()[k] = k % 4 == 3 ? 0 : light;
    return panel;
}

/// Light between 0 and 1 at random in each pixel and colour.
inline Texels noise_panel(const Display& d) {
    Texels panel(d.panel.pixels[0], d.panel.pixels[1]);
    Random random(21);
    for (std::int64_t k = 0; k < panel.columns() * panel.rows() * 4; ++k) panel.data()[k] = k % 4 == 3 ? 0 : float(random(0, 1));
    return panel;
}

inline Image picture(const Display& d, const Texels& panel, const RenderOptions& options = {}) {
    Job job;
    return render(d, resolve(d), panel, options, job).image;
}

/// FNV-1a of the bits of pictures. Kept values fix them: whatever changes one changes what the renderer computes, and has to say
/// so.
class Bits {
  public:
    void add(const Image& image) {
        for (const float x : image.rgb) {
            std::uint32_t bits;
            std::memcpy(&bits, &x, sizeof bits);
            for (int k = 0; k < 4; ++k) hash_ = (hash_ ^ (bits >> 8 * k & 255)) * 1099511628211u;
        }
    }
    std::uint64_t hash() const { return hash_; }

  private:
    std::uint64_t hash_ = 14695981039346656037u;
};

/// Large errors of lenses 4 mm apart, but for tilts.
inline Errors of_each_lens() {
    Errors e;
    e.decenter_sd_mm = 0.03;
    e.height_sd_mm = 0.02;
    e.curvature_sd = 0.01;
    e.bow_mm = 0.2;
    e.seed = 3;
    return e;
}

inline Display ideal_example() {
    Display d = example();
    d.lens = {IdealLens{{}, 6}, {}};
    d.array.aperture = Aperture::cell;
    return d;
}

/// Lenses that fill cells a quarter less high than wide.
inline Display in_rectangles(Display d) {
    d.array.lattice = LatticeKind::rectangle;
    d.array.pitch_mm = {d.array.pitch_mm[0], 0.75 * d.array.pitch_mm[0]};
    d.array.aperture = Aperture::cell;
    return d;
}

/// Lenses that fill the cells of another lattice; bricks have the rectangles' pitches.
inline Display in_lattice(Display d, LatticeKind lattice) {
    d = in_rectangles(std::move(d));
    d.array.lattice = lattice;
    if (lattice != LatticeKind::brick) d.array.pitch_mm = d.array.pitch_mm[0];
    if (lattice == LatticeKind::strips) d.array.count = {10, 1};
    return d;
}

/// Slanted strips, their flat side glued onto cover glass.
inline Display glued_strips() {
    Display d = in_lattice(example(), LatticeKind::strips);
    d.array.slant_deg = 9.5;
    d.panel.layers = {{2, 1.52}, {0.1, 1.47}};
    d.array.gap_mm.reset();
    d.array.base_z_mm = 2.1;
    return d;
}

/// One display for every way through an array, and for every option of camera and diffuser.
inline std::vector<std::pair<std::string, Display>> every_kind() {
    std::vector<std::pair<std::string, Display>> all;
    all.emplace_back("plano-convex", example());
    all.back().second.diffuser = Diffuser{40, {3, 5}, Profile::box};
    all.emplace_back("plano-convex, square, gaussian, random", example());
    all.back().second.array.aperture = Aperture::cell;
    all.back().second.diffuser = Diffuser{20, {8, 2}, Profile::gaussian};
    all.back().second.render.sampling = Sampling::random;
    all.emplace_back("aspheres, stop, schlick",
                     with_surfaces({{0.02, 0, {}, 2, 1, 1.6}, {-0.1, 0, {}, 2, 0.8, 1.4}, {-0.25, -0.4, {1e-3, 2e-5}, 2}}));
    all.back().second.array.pitch_mm = 4;
    all.back().second.lens.stop_radius_mm = 1.4;
    all.back().second.render.fresnel = Fresnel::schlick;
    all.back().second.camera.pixel_filter = PixelFilter::box;
    all.emplace_back("facing the panel, rotated, emission", example());
    all.back().second.lens.as<PlanoConvex>().facing = Facing::panel;
    all.back().second.array.rotation_deg = 7;
    all.back().second.array.offset_mm = {0.3, -0.9};
    all.back().second.panel.emission_exponent = 1.5;
    all.back().second.diffuser = Diffuser{30, {120, 40}, Profile::box};
    all.emplace_back("ideal, thin lens", ideal_example());
    all.back().second.camera.pupil_diameter_mm = 8;
    all.back().second.diffuser = Diffuser{40, {4, 4}, Profile::box};
    all.emplace_back("clear", example());
    all.back().second.array.surround = Surround::clear;
    all.back().second.diffuser = Diffuser{40, {4, 4}, Profile::box};
    all.emplace_back("clear, square", example());
    all.back().second.array.surround = Surround::clear;
    all.back().second.array.aperture = Aperture::cell;
    all.back().second.camera.pixel_filter = PixelFilter::box;
    all.emplace_back("plate", example());
    all.back().second.array.surround = Surround::plate;
    all.back().second.diffuser = Diffuser{40, {4, 4}, Profile::gaussian};
    all.back().second.lens.stop_radius_mm = 1.2;
    all.emplace_back("rectangular cells, clear, turned", in_rectangles(example()));
    all.back().second.array.surround = Surround::clear;
    all.back().second.array.rotation_deg = -5;
    all.back().second.diffuser = Diffuser{40, {4, 4}, Profile::box};
    all.emplace_back("hexagons, layers", in_lattice(example(), LatticeKind::hexagon));
    all.back().second.panel.layers = {{0.7, 1.5}};
    all.back().second.diffuser = Diffuser{40, {4, 4}, Profile::box};
    all.emplace_back("bricks, plate", in_lattice(example(), LatticeKind::brick));
    all.back().second.array.surround = Surround::plate;
    all.back().second.array.rotation_deg = 3;
    all.back().second.camera.pixel_filter = PixelFilter::box;
    all.emplace_back("strips, glued", glued_strips());
    all.back().second.diffuser = Diffuser{40, {4, 0.5}, Profile::box};
    all.emplace_back("strips, clear", in_lattice(example(), LatticeKind::strips));
    all.back().second.array.surround = Surround::clear;
    all.back().second.camera.pixel_filter = PixelFilter::box;
    all.emplace_back("slits over a layer", in_lattice(example(), LatticeKind::strips));
    all.back().second.array.aperture = Aperture::circle;
    all.back().second.lens = {Pinhole{0.4}, {}};
    all.back().second.panel.layers = {{3, 1.5}};
    all.back().second.diffuser = Diffuser{40, {4, 4}, Profile::box};
    all.emplace_back("black matrix", example());
    all.back().second.panel.aperture_ratio = 0.6;
    all.back().second.diffuser = Diffuser{40, {4, 4}, Profile::box};
    all.emplace_back("stripes", example());
    all.back().second.panel.subpixels = SubpixelLayout::rgb_stripe;
    all.back().second.camera.pixel_filter = PixelFilter::box;
    all.emplace_back("hexagons over custom subpixels", in_lattice(example(), LatticeKind::hexagon));
    all.back().second.panel = with_subpixels(all.back().second.panel, SubpixelLayout::custom);
    all.back().second.diffuser = Diffuser{40, {4, 4}, Profile::box};
    all.emplace_back("errors of each lens", with_surfaces({{0.02, 0, {}, 1.8, 1, 1.6}, {-0.25, -0.4, {1e-3, 2e-5}, 1.8}}));
    all.back().second.array.pitch_mm = 4;
    all.back().second.lens.stop_radius_mm = 1.4;
    all.back().second.errors = of_each_lens();
    all.back().second.errors.tilt_sd_deg = 1;
    all.back().second.errors.wedge_deg = {0.5, -0.3};
    all.back().second.diffuser = Diffuser{40, {4, 4}, Profile::box};
    all.emplace_back("errors of a plate's caps", example());
    all.back().second.array.surround = Surround::plate;
    all.back().second.errors = of_each_lens();
    all.back().second.errors.rotation_deg = 2;
    all.back().second.diffuser = Diffuser{40, {4, 4}, Profile::box};
    all.emplace_back("plano-convex, schlick", example());
    all.back().second.render.fresnel = Fresnel::schlick;
    all.back().second.diffuser = Diffuser{40, {3, 5}, Profile::box};
    for (auto& [name, d] : all) {
        look_from(d, 20, 400);
        d.camera.position_mm[1] = 60;
    }
    return all;
}

/// Every way through an array with a diffuser: as wide as the lenses, narrower than a pixel, wider than three lenses, gaussian.
inline std::vector<std::pair<std::string, Display>> diffused() {
    std::vector<std::pair<std::string, Display>> all;
    auto add = [&](const std::string& name, Display d, Diffuser diffuser) {
        d.diffuser = diffuser;
        d.render.estimator = Estimator::filtered;
        d.render.samples = 4;
        d.render.fresnel = Fresnel::exact;
        all.emplace_back(name, d);
    };
    const Diffuser closing{40, {5.7, 5.7}, Profile::box};
    add("plano-convex", example(), closing);
    add("plano-convex, oblique", example(), closing);
    all.back().second.camera.position_mm = {150, -80, 350};
    add("plano-convex, narrow", example(), {3, {0.5, 0.5}, Profile::box});
    add("plano-convex, wide and unequal", example(), {40, {17, 3}, Profile::box});
    add("plano-convex, gaussian", example(), {40, {4, 3}, Profile::gaussian});
    add("ideal, square", ideal_example(), closing);
    add("facing the panel", example(), closing);
    all.back().second.lens.as<PlanoConvex>().facing = Facing::panel;
    add("stopped", example(), closing);
    all.back().second.lens.stop_radius_mm = 0.6;
    add("clear", example(), closing);
    all.back().second.array.surround = Surround::clear;
    add("plate", example(), closing);
    all.back().second.array.surround = Surround::plate;
    add("rectangular cells", in_rectangles(example()), closing);
    add("weak", example(), {40, {1.2, 1.8}, Profile::box});
    add("weak, rectangular cells", in_rectangles(example()), {40, {1.2, 1.2}, Profile::box});
    add("layers", example(), closing);
    all.back().second.panel.layers = {{2, 1.5}, {1, 1.7}};
    add("glued onto a layer, plate", example(), closing);
    all.back().second.panel.layers = {{2, 1.5}};
    all.back().second.array.gap_mm.reset();
    all.back().second.array.base_z_mm = 2;
    all.back().second.array.surround = Surround::plate;
    add("pinholes", example(), closing);
    all.back().second.lens = {Pinhole{0.8}, {}};
    // Lens by lens: other lattices, turned arrays, and cameras with pixels and pupils, with or without a diffuser.
    add("turned", example(), closing);
    all.back().second.array.rotation_deg = 11;
    add("hexagons", in_lattice(example(), LatticeKind::hexagon), closing);
    add("round hexagons, plate", in_lattice(example(), LatticeKind::hexagon), closing);
    all.back().second.array.aperture = Aperture::circle;
    all.back().second.array.surround = Surround::plate;
    add("bricks, weak", in_lattice(example(), LatticeKind::brick), {40, {1.2, 1.8}, Profile::box});
    add("slanted strips, glued", glued_strips(), {40, {4, 2}, Profile::box});
    add("box filter and pupil", example(), closing);
    all.back().second.camera.pixel_filter = PixelFilter::box;
    all.back().second.camera.pupil_diameter_mm = 2;
    add("strips, no diffuser", glued_strips(), closing);
    all.back().second.diffuser.reset();
    all.back().second.camera.pixel_filter = PixelFilter::box;
    add("round lenses, no diffuser, pupil", example(), closing);
    all.back().second.diffuser.reset();
    all.back().second.camera.pixel_filter = PixelFilter::box;
    all.back().second.camera.pupil_diameter_mm = 2;
    add("black matrix", ideal_example(), closing);
    all.back().second.panel.aperture_ratio = 0.5;
    add("black matrix, weak", example(), {40, {0.5, 0.3}, Profile::box});
    all.back().second.panel.aperture_ratio = 0.6;
    add("black matrix, strips, no diffuser", glued_strips(), closing);
    all.back().second.diffuser.reset();
    all.back().second.camera.pixel_filter = PixelFilter::box;
    all.back().second.panel.aperture_ratio = 0.4;
    add("stripes", ideal_example(), closing);
    all.back().second.panel.subpixels = SubpixelLayout::rgb_stripe;
    add("PenTile, weak", example(), {40, {0.5, 0.3}, Profile::box});
    all.back().second.panel.subpixels = SubpixelLayout::pentile_rgbg;
    add("delta, slanted strips, glued", glued_strips(), {40, {4, 2}, Profile::box});
    all.back().second.panel.subpixels = SubpixelLayout::delta;
    add("custom subpixels, box filter and pupil", example(), closing);
    all.back().second.panel = with_subpixels(all.back().second.panel, SubpixelLayout::custom);
    all.back().second.camera.pixel_filter = PixelFilter::box;
    all.back().second.camera.pupil_diameter_mm = 2;
    return all;
}

/// Squares of light, larger than a panel pixel and smaller than an elemental image, on top of noise.
inline Texels patterned_panel(const Display& d) {
    Texels panel = noise_panel(d);
    for (std::int64_t r = 0; r < panel.rows(); ++r)
        for (std::int64_t c = 0; c < panel.columns(); ++c)
            for (int k = 0; k < 3; ++k)
                panel.row(r)[4 * c + k] = 0.2f * panel.row(r)[4 * c + k] + ((r / 5 + c / 7) % 2 ? 0.7f : 0.1f);
    return panel;
}

inline double rmse(const Image& a, const Image& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) sum += (double(a.rgb[i]) - b.rgb[i]) * (double(a.rgb[i]) - b.rgb[i]);
    return std::sqrt(sum / double(a.rgb.size()));
}
inline double mean_light(const Image& a) {
    double sum = 0;
    for (const float x : a.rgb) sum += x;
    return sum / double(a.rgb.size());
}

}  // namespace lfdsim
