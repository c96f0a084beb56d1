#include "cli/bench/bench_cases.h"

#include <algorithm>

namespace lfdsim::cli {

void make_asphere(Display& d) {
    Surface flat, cap;
    flat.semi_aperture_mm = cap.semi_aperture_mm = 4.4;
    flat.distance_mm = 2.1489;
    flat.index = 1.49;
    cap.curvature_per_mm = -1 / 9.0;
    cap.conic = -0.36;
    cap.even_asphere = {1e-5, 1e-7};
    d.lens = {SurfaceLens{{flat, cap}}, {}};
}

void make_strips(Display& d) {
    d.array.lattice = LatticeKind::strips;
    d.array.count.reset();
}

namespace {

void make_ideal(Display& d) {
    d.lens = {IdealLens{4.4, 18.4}, {}};  // f = R/(n - 1)
}

// Puts a million lenses on the same panel: all lengths of lens and array shrink by the same factor, the panel's pixels do not.
void make_tiny_lenses(Display& d) {
    const double shrink = 384.0 / 1000 / 8.8;
    d.array.count = {{1000, 1000}};
    d.array.pitch_mm = shrink * d.array.pitch_mm[0];
    *d.array.base_z_mm *= shrink;
    auto& lens = d.lens.as<PlanoConvex>();
    lens.sphere_radius_mm *= shrink;
    *lens.aperture_radius_mm *= shrink;
    lens.cylinder_height_mm *= shrink;
}

constexpr Duty duty_table[] = {
    {"plain", [](Display&) {}},
    {"fresnel exact", [](Display& d) { d.render.fresnel = Fresnel::exact; }},
    {"fresnel none", [](Display& d) { d.render.fresnel = Fresnel::none; }},
    {"no diffuser", [](Display& d) { d.diffuser.reset(); }},
    {"gaussian diffuser", [](Display& d) { d.diffuser->profile = Profile::gaussian; }},
    {"random samples", [](Display& d) { d.render.sampling = Sampling::random; }},
    {"pixel filter box", [](Display& d) { d.camera.pixel_filter = PixelFilter::box; }},
    {"thin-lens camera", [](Display& d) { d.camera.pupil_diameter_mm = 4; }},
    {"emission exponent 1", [](Display& d) { d.panel.emission_exponent = 1; }},
    {"array turned and moved",
     [](Display& d) {
         d.array.rotation_deg = 5;
         d.array.offset_mm = {1, 2};
     }},
    {"facing the panel", [](Display& d) { d.lens.as<PlanoConvex>().facing = Facing::panel; }},
    {"filled cells", [](Display& d) { d.array.aperture = Aperture::cell; }},
    {"aperture stop", [](Display& d) { d.lens.stop_radius_mm = 2; }},
    {"hexagons",
     [](Display& d) {
         d.array.lattice = LatticeKind::hexagon;
         d.array.count.reset();
     }},
    {"strips", make_strips},
    {"a million lenses", make_tiny_lenses},
};

template <Surround surround>
void put_sphere(Display& d) {
    d.array.surround = surround;
}
template <Surround surround>
void put_asphere(Display& d) {
    make_asphere(d);
    d.array.surround = surround;
}

constexpr Duty glass_table[] = {
    {"plano-convex, opaque", put_sphere<Surround::opaque>},
    {"plano-convex, plate", put_sphere<Surround::plate>},
    {"plano-convex, clear", put_sphere<Surround::clear>},
    {"sphere as surfaces, opaque",
     [](Display& d) {
         make_asphere(d);
         Surface& cap = d.lens.as<SurfaceLens>().surfaces[1];
         cap.conic = 0;
         cap.even_asphere.clear();
     }},
    {"asphere, opaque", put_asphere<Surround::opaque>},
    {"asphere, plate", put_asphere<Surround::plate>},
    {"asphere, clear", put_asphere<Surround::clear>},
    {"ideal, opaque", make_ideal},
};

}  // namespace

const std::span<const Duty> duties = duty_table;
const std::span<const Duty> glasses = glass_table;

Texels noise_panel(const Display& d) {
    const auto [columns, rows] = d.panel.pixels;
    Texels texels(columns, rows);
    for (std::int64_t i = 0; i < columns * rows * 4; ++i)
        // The upper 24 bits of a multiplicative hash; every fourth value is the texel's padding.
        texels.data()[i] = i % 4 == 3 ? 0.0f : float(std::uint32_t(i) * 2654435761u >> 8) * 0x1p-24f;
    return texels;
}

Rect band(const Display& d, int rows) {
    const auto [width, height] = d.camera.resolution;
    const int top = std::max(0, (int(height) - rows) / 2);
    return {0, top, int(width), std::min(int(height), top + rows)};
}

Display bench_display() {
    Display d;
    d.name = "bench";
    d.panel.pixels = {3840, 2160};
    d.panel.pixel_pitch_mm = 0.1;
    d.lens.kind = PlanoConvex{9, 4.4, 1, 1.49, Facing::viewer};
    d.array.count = {{44, 25}};
    d.array.pitch_mm = 8.8;
    d.array.base_z_mm = 12;
    d.diffuser.emplace();
    d.diffuser->distance_mm = 45.851;          // z = 60 mm
    d.diffuser->angle_deg = {2.8648, 2.8648};  // 0.05 rad
    d.camera.frame_width_mm = 384;
    d.content.tilt_deg = -35;  // Blender's monkey looks up
    d.render.fresnel = Fresnel::schlick;
    d.render.estimator = Estimator::point;  // as in the paper
    d.render.samples = 100;
    return d;
}

}  // namespace lfdsim::cli
