#include "base/constants.h"
#include "geometry/prescription.h"
#include "report/drawings/front_view.h"
#include "report/drawings/section.h"
#include "report/drawings/side_scale.h"
#include "report/drawings/side_view.h"

#include <fmt/format.h>

// The drawing of a few lenses. Rays end at the picture's edge, where a nested <svg> clips them.
namespace lfdsim {
namespace {

constexpr double lens_page_width = 960, left = 76, top = 16, notes_width = 236, lens_drawn = lens_page_width - left - notes_width,
                 lens_most_height = 440, front_side = 130;

/// The part of the display that is drawn.
struct DrawnWindow {
    std::int64_t first, last;    // rows of lenses, both included
    double from, to, low, high;  // mm: least and greatest z, least and greatest y
};

DrawnWindow window_of(const Display& d, const Geometry& g) {
    const SideLens middle = lens_near(g.lattice, 0);
    DrawnWindow w{
        std::max<std::int64_t>(middle.row - 1, 0), std::min(middle.row + 1, std::int64_t(g.lattice.count[1]) - 1), 0, 0, 0, 0};
    const double p = d.array.pitch_mm[1], depth = g.top_z_mm - std::min(0., g.base_z_mm);
    w.low = lens_at(g.lattice, w.first).y_mm - 0.6 * p;
    w.high = lens_at(g.lattice, w.last).y_mm + 0.6 * p;
    w.from = std::min(0., g.base_z_mm) - 0.05 * depth;
    // In front of the lenses the drawing extends as far as its width allows, at the scale that its height allows.
    const double scale = std::min(lens_most_height / (w.high - w.low), lens_drawn / (depth + std::max(1.2 * p, 0.5 * depth)));
    w.to = w.from + lens_drawn / scale;
    return w;
}

/// Returns half the height of a surface in the plane of its axis, mm.
double rim_of(const Display& d, const PlacedSurface& f) {
    return d.array.aperture == Aperture::cell ? 0.5 * d.array.pitch_mm[1] : f.semi_aperture_mm;
}

/// Adds a surface's section to an outline, from its lower end upwards or from its upper end downwards.
void add_surface(std::vector<Point>& outline, const SideScale& scale, const Display& d, const PlacedSurface& f, double y, bool up) {
    constexpr int steps = 48;
    for (int k = 0; k <= steps; ++k) {
        const double s = rim_of(d, f) * (2. * (up ? k : steps - k) / steps - 1);
        outline.push_back(scale.at(y + s, f.z_mm + sag_mm(f, std::abs(s))));
    }
}

/// Draws a lens whose axis is at y: glass between surfaces, or the plane of a thin lens; and its stop.
void draw_lens(SvgDrawing& drawing, const SideScale& scale, const Display& d, const Geometry& g, double y) {
    if (g.surfaces.front().form == SurfaceForm::thin) {
        const double half = 0.5 * g.clear_aperture_mm[1];
        drawing.line(scale.at(y - half, g.vertex_plane_mm), scale.at(y + half, g.vertex_plane_mm), glass_style);
        for (const int sense : {-1, 1}) {
            const auto [x, tip] = scale.at(y + sense * half, g.vertex_plane_mm);
            drawing.path(std::array<Point, 3>{{{x - 5, tip + sense * 7}, {x, tip}, {x + 5, tip + sense * 7}}},
                         "stroke=\"#3080a0\"");
        }
    }
    for (std::size_t k = 0; k + 1 < g.surfaces.size(); ++k) {
        if (g.surfaces[k].index_above == 1) continue;
        std::vector<Point> outline;
        add_surface(outline, scale, d, g.surfaces[k], y, true);
        add_surface(outline, scale, d, g.surfaces[k + 1], y, false);
        drawing.path(outline, glass_style, true);
    }
    if (!d.lens.stop_radius_mm) return;
    for (const double sense : {-1., 1.})
        drawing.line(scale.at(y + sense * *d.lens.stop_radius_mm, g.stop_z_mm),
                     scale.at(y + sense * 0.5 * d.array.pitch_mm[1], g.stop_z_mm), "stroke-width=\"3\"");
}

/// Draws the surround at y, the border of two cells: black walls, or the glass of a plate. `upper` and `lower`: whether there is a
/// lens on that side.
void draw_between(SvgDrawing& drawing, const SideScale& scale, const Display& d, const Geometry& g, double y, bool upper,
                  bool lower) {
    const double half = 0.5 * d.array.pitch_mm[1];
    // The surround reaches from the lowest rim of the lens's surfaces to the highest.
    double rim = g.glass_radius_mm, low = g.vertex_plane_mm, high = low;
    if (d.array.aperture == Aperture::cell) rim = half;
    for (const PlacedSurface& f : g.surfaces) {
        const double z = f.z_mm + sag_mm(f, std::min(rim, rim_of(d, f)));
        low = &f == &g.surfaces.front() ? z : std::min(low, z);
        high = &f == &g.surfaces.front() ? z : std::max(high, z);
    }
    const double from = y - (lower ? half - rim : 0), to = y + (upper ? half - rim : 0);
    if (d.array.surround == Surround::clear || to < from) return;
    const Point corner = scale.at(to, low);
    drawing.rectangle(corner, std::max(1.5, scale.per_z * (high - low)), std::max(1., scale.per_y * (to - from)),
                      d.array.surround == Surround::plate ? glass_style : black_style);
}

void draw_rays(SvgDrawing& drawing, const SideScale& scale, const Subject& s, const DrawnWindow& w) {
    const Display& d = s.display();
    const Geometry& g = s.geometry();
    const SideLens middle = lens_near(g.lattice, 0), lower = lens_at(g.lattice, w.first), upper = lens_at(g.lattice, w.last);
    const Vec3d& eye = d.camera.position_mm;
    // The theoretical field of view at the upper lens, 2 atan(p / 2g): lines from half a pitch on the panel through its principal
    // points.
    for (const double sense : {-1., 1.}) {
        const double edge = upper.y_mm + sense * 0.5 * d.array.pitch_mm[1];
        const double far = upper.y_mm - sense * 0.5 * d.array.pitch_mm[1] / g.gap_mm * (w.to - g.rear_principal_mm);
        drawing.path(std::array{scale.at(edge, 0), scale.at(upper.y_mm, g.front_principal_mm),
                                scale.at(upper.y_mm, g.rear_principal_mm), scale.at(far, w.to)},
                     "stroke-opacity=\"0.5\" stroke-dasharray=\"5 4\"");
    }
    // The eye looks at the middle of the lower lens.
    if (g.diffuser_z_mm) {
        const double z = *g.diffuser_z_mm, half = 0.5 * d.diffuser->angle_deg[1] * degree;
        const double y = side_ray(eye[1], eye[2], lower.y_mm, g.vertex_plane_mm).y_at(z);
        drawing.line(scale.at(y, z), scale.at(side_ray(y, z, eye[1], eye[2]).y_at(w.to), w.to), backward_style);
        for (const double turn : {-1., -0.5, 0., 0.5, 1.})
            draw_path(drawing, scale, through_array(d, g, scattered(d, y, z, turn * half)), 0, backward_style);
    } else {
        for (const double share : {-0.8, -0.4, 0., 0.4, 0.8})
            draw_path(
                drawing, scale,
                through_array(d, g, side_ray(eye[1], eye[2], lower.y_mm + share * 0.5 * g.clear_aperture_mm[1], g.vertex_plane_mm)),
                0, backward_style);
    }
    // The light of one pixel, the nearest to a fifth of a pitch above the middle lens's axis; pixel centres are at whole or half
    // pitches.
    const double a = d.panel.pixel_pitch_mm, phase = d.panel.pixels[1] % 2 ? 0 : 0.5;
    const double y = a * (std::round((middle.y_mm + 0.2 * d.array.pitch_mm[1]) / a - phase) + phase);
    for (int k = -3; k <= 3; ++k) {
        const SideRay ray = side_ray(y - middle.y_mm, 0, 0.16 * k * g.clear_aperture_mm[1], g.front_principal_mm);
        SidePath path = through_lens(d, g, ray);
        for (auto& point : path.points) point[0] += middle.y_mm;
        path.last.y += middle.y_mm;
        draw_path(drawing, scale, path, std::min(w.to, g.diffuser_z_mm.value_or(w.to)), pixel_style);
    }
}

/// Returns the legend's lines on sizes and theory.
std::vector<std::string> notes_of(const Subject& s) {
    const Display& d = s.display();
    const Geometry& g = s.geometry();
    const Theory& t = s.theory();
    std::vector<std::string> lines{
        fmt::format("p = {}: lens pitch", mm(d.array.pitch_mm[1])),
        fmt::format("g = {}: gap", mm(g.gap_mm)),
        std::isfinite(g.focal_length_mm) ? fmt::format("f = {}: focal length", mm(g.focal_length_mm)) : std::string("f: infinite"),
        fmt::format("D = {}: aperture", mm(g.clear_aperture_mm[1])),
        fmt::format("a = {}: pixel", mm(d.panel.pixel_pitch_mm)),
        d.lens.type() == LensType::pinhole  ? std::string("L: none, pinholes image nothing")
        : std::isfinite(t.central_depth_mm) ? fmt::format("L = {}: central depth", mm(t.central_depth_mm))
                                            : std::string("L: at infinity"),
        fmt::format("{:.4g}\u00b0: field of view of one lens,", t.along[1].fov_deg),
        "2 atan(p / 2g), dashed"};
    if (d.diffuser) lines.push_back(fmt::format("\u03c9 = {:.4g}\u00b0: diffuser, vertical", d.diffuser->angle_deg[1]));
    if (g.turn_deg != 0) lines.push_back("in the frame of the turned array");
    return lines;
}

}  // namespace

std::string lens_view_svg(const Subject& display, SideFrame* frame) {
    // The layout.
    const Subject s = section_of(display);
    const Display& d = s.display();
    const Geometry& g = s.geometry();
    const DrawnWindow w = window_of(d, g);
    const double per_z = lens_drawn / (w.to - w.from), per_y = std::max(per_z, 160 / (w.high - w.low)),
                 high = per_y * (w.high - w.low);
    const SideScale scale{0, 0.5 * high, w.from, 0.5 * (w.low + w.high), per_z, per_y};
    if (frame) *frame = {w.low, w.high, w.from, w.to, left, top, lens_drawn, high};
    std::vector<std::string> notes = notes_of(s);
    if (shows_a_row(display.display())) notes.push_back("section along a row of the array");
    // The lenses from the front are below the notes and the names of the rays.
    const double front_top = top + 16 + 21. * (double(notes.size()) + 2) + (scale.true_to_scale() ? 0 : 21) + 26;
    SvgDrawing drawing(lens_page_width, std::max(top + high + 60, front_top + front_side + 10),
                       "Lenses of the display from the side, with their rays");
    // The clipped part: lenses, surround, layers, rays, diffuser, and the panel with marks between its pixels.
    drawing.add(fmt::format("<svg x=\"{0}\" y=\"{1}\" width=\"{2}\" height=\"{3}\" viewBox=\"0 0 {2} {3}\" overflow=\"hidden\">\n",
                            px(left), px(top), px(lens_drawn), px(high)));
    for (std::int64_t row = w.first; row <= w.last; ++row) draw_lens(drawing, scale, d, g, lens_at(g.lattice, row).y_mm);
    for (std::int64_t row = w.first; row <= w.last + 1; ++row)
        draw_between(drawing, scale, d, g, lens_at(g.lattice, row).y_mm - 0.5 * d.array.pitch_mm[1],
                     row<std::int64_t(g.lattice.count[1]), row> 0);
    double layer_z = 0;
    for (const PlacedLayer& layer : g.layers) {
        drawing.rectangle(scale.at(w.high, layer_z), per_z * layer.thickness_mm, high, glass_style);
        layer_z += layer.thickness_mm;
    }
    draw_rays(drawing, scale, s, w);
    if (g.diffuser_z_mm && *g.diffuser_z_mm < w.to)
        drawing.line(scale.at(w.low, *g.diffuser_z_mm), scale.at(w.high, *g.diffuser_z_mm), diffuser_style);
    const double a = per_y * d.panel.pixel_pitch_mm;
    const double end = std::min(w.high, 0.5 * g.panel_height_mm), begin = std::max(w.low, -0.5 * g.panel_height_mm);
    if (end > begin) {
        drawing.line(scale.at(end, 0), scale.at(begin, 0), "stroke-width=\"5\"");
        for (double y = end; a >= 3 && y > begin; y -= d.panel.pixel_pitch_mm) {
            const auto [x, at_y] = scale.at(y, 0);
            drawing.line({x - 2.5, at_y}, {x + 2.5, at_y}, "stroke=\"#999\" stroke-width=\"0.6\"");
        }
    }
    drawing.add("</svg>\n");

    // Dimensions outside of it: the pitch at the left, the gap below, the aperture in front of the upper lens.
    const auto at = [&](double y, double z) {
        const auto [x, at_y] = scale.at(y, z);
        return Point{left + x, top + at_y};
    };
    const SideLens lower = lens_at(g.lattice, w.first);
    const double x = at(0, 0)[0] - 18, below = top + high + 22;
    if (w.last > w.first) {
        const double next = lens_at(g.lattice, w.first + 1).y_mm;
        for (const double y : {lower.y_mm, next})
            drawing.line({x - 6, at(y, 0)[1]}, {x + 12, at(y, 0)[1]}, "stroke-opacity=\"0.5\"");
        drawing.dimension({x, at(lower.y_mm, 0)[1]}, {x, at(next, 0)[1]}, "");
        const double middle = 0.5 * (at(lower.y_mm, 0)[1] + at(next, 0)[1]);
        drawing.text({x - 8, middle}, "p = " + mm(d.array.pitch_mm[1]),
                     fmt::format("font-size=\"12\" text-anchor=\"middle\" transform=\"rotate(-90 {} {})\"", px(x - 8), px(middle)));
    }
    for (const double z : {0., g.front_principal_mm})
        drawing.line({at(0, z)[0], top + high}, {at(0, z)[0], below + 6}, "stroke-opacity=\"0.5\"");
    drawing.dimension({at(0, 0)[0], below}, {at(0, g.front_principal_mm)[0], below}, "");
    drawing.text({0.5 * (at(0, 0)[0] + at(0, g.front_principal_mm)[0]), below + 17}, "g = " + mm(g.gap_mm),
                 "font-size=\"12\" text-anchor=\"middle\"");
    const double upper = lens_at(g.lattice, w.last).y_mm, half = 0.5 * g.clear_aperture_mm[1];
    const double beside = g.top_z_mm + 0.06 * (w.to - g.top_z_mm);
    for (const double y : {upper - half, upper + half})
        drawing.line(at(y, g.stop_z_mm), {at(y, beside)[0] + 6, at(y, beside)[1]}, "stroke-opacity=\"0.5\"");
    drawing.dimension(at(upper - half, beside), at(upper + half, beside), "D = " + mm(g.clear_aperture_mm[1]));
    // The legend, and the lenses from the front.
    double row = top + 16;
    for (const std::string& line : notes) {
        drawing.text({lens_page_width - notes_width + 18, row}, line, "font-size=\"12\"");
        row += 21;
    }
    drawing.text({lens_page_width - notes_width + 18, row + 6}, "from the eye back to the panel",
                 "font-size=\"12\" fill=\"#d55e00\"");
    drawing.text({lens_page_width - notes_width + 18, row + 27}, "the light of one pixel", "font-size=\"12\" fill=\"#1f7fc0\"");
    if (!scale.true_to_scale())
        drawing.text({lens_page_width - notes_width + 18, row + 48}, fmt::format("heights drawn {:.3g} times", per_y / per_z),
                     "font-size=\"12\"");
    drawing.text({lens_page_width - notes_width + 18, front_top - 9}, "as the viewer sees them", "font-size=\"12\"");
    draw_front(drawing, {lens_page_width - notes_width + 18, front_top}, front_side, display.display(), display.geometry());
    return drawing.svg();
}

}  // namespace lfdsim
