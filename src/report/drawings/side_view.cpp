#include "report/drawings/side_view.h"
#include "report/drawings/section.h"

#include "base/constants.h"
#include "report/drawings/side_scale.h"

#include <fmt/format.h>

namespace lfdsim {
namespace {

constexpr double width = 960, side = 72, drawn = width - 2 * side;  // pixels: the drawing, its margins, the part for z
constexpr double least_height = 48, most_height = 400;              // pixels, for y

/// Returns half the height of the array's rotated rectangle in the plane x = 0, mm.
double half_height(const Geometry& g) {
    const double c = std::abs(g.lattice.cos_turn), s = std::abs(g.lattice.sin_turn);
    return std::min(s > 0 ? 0.5 * g.array_width_mm / s : INFINITY, c > 0 ? 0.5 * g.array_height_mm / c : INFINITY);
}

/// The heights of the depth planes that are near enough to be drawn; NaN for others.
struct DrawnPlanes {
    double central = NAN;
    std::array<double, 2> marginal{NAN, NAN};

    explicit DrawnPlanes(const Subject& s) {
        const Theory& t = s.theory();
        const double reach = 1.5 * s.display().camera.position_mm[2], from = s.geometry().rear_principal_mm;
        const auto near = [&](double z) { return std::abs(z) <= reach ? z : NAN; };
        central = near(from + t.central_depth_mm);
        if (std::isfinite(central))
            marginal = {near(from + depth_mm(t.depth_near_per_mm)), near(from + depth_mm(t.depth_far_per_mm))};
    }
};

/// Returns the scale at which everything from the first plane to the last fits, and its height `high` in pixels.
SideScale scale_for(const Subject& s, const DrawnPlanes& planes, double top, double& high) {
    const Display& d = s.display();
    const Geometry& g = s.geometry();
    double first = std::min(0., g.base_z_mm), last = std::max(d.camera.position_mm[2], g.top_z_mm);
    for (const double z : {planes.central, planes.marginal[0], planes.marginal[1], g.diffuser_z_mm.value_or(NAN)}) {
        first = std::fmin(first, z);
        last = std::fmax(last, z);
    }
    const double offset = g.lattice.offset[1], half = half_height(g), eye = d.camera.position_mm[1];
    const double up = std::max({0.5 * g.panel_height_mm, offset + half, eye}),
                 down = std::min({-0.5 * g.panel_height_mm, offset - half, eye});
    const double per_z = std::min(drawn / (last - first), most_height / (up - down));
    const double per_y = std::max(per_z, least_height / (up - down));
    high = per_y * (up - down);
    return {side + 0.5 * (drawn - per_z * (last - first)), top + 0.5 * high, first, 0.5 * (up + down), per_z, per_y};
}

/// Draws rays from the eye to three lenses, or through three points of the diffuser and its extreme angles.
void draw_backward(SvgDrawing& drawing, const SideScale& scale, const Subject& s) {
    const Display& d = s.display();
    const Geometry& g = s.geometry();
    const Vec3d& eye = d.camera.position_mm;
    for (const double share : {-0.7, 0., 0.7}) {
        const double y = g.lattice.offset[1] + share * half_height(g);
        if (!g.diffuser_z_mm) {
            const SideLens lens = lens_near(g.lattice, y);
            draw_path(drawing, scale, through_array(d, g, side_ray(eye[1], eye[2], lens.y_mm, g.vertex_plane_mm)), 0,
                      backward_style);
            continue;
        }
        const double z = *g.diffuser_z_mm, half = 0.5 * d.diffuser->angle_deg[1] * degree;
        drawing.line(scale.at(eye[1], eye[2]), scale.at(y, z), backward_style);
        for (const double turn : {-half, 0., half})
            draw_path(drawing, scale, through_array(d, g, scattered(d, y, z, turn)), 0, backward_style);
    }
}

/// Draws the light of the point of the panel behind the middle lens, up to its image; where that is not real, some way forward and,
/// dashed, back to the virtual image.
void draw_pixel(SvgDrawing& drawing, const SideScale& scale, const Subject& s, const DrawnPlanes& planes) {
    const Display& d = s.display();
    const Geometry& g = s.geometry();
    const double y = lens_near(g.lattice, 0).y_mm, half = 0.45 * g.clear_aperture_mm[1];
    const bool real = planes.central > g.top_z_mm;
    const double end = real ? planes.central : g.top_z_mm + 0.4 * (d.camera.position_mm[2] - g.top_z_mm);
    for (const double share : {-1., -0.5, 0., 0.5, 1.}) {
        const SidePath path = through_array(d, g, side_ray(y, 0, y + share * half, g.front_principal_mm));
        draw_path(drawing, scale, path, end, pixel_style);
        if (path.through && planes.central < g.base_z_mm)
            drawing.line(scale.at(path.last.y, path.last.z), scale.at(path.last.y_at(planes.central), planes.central),
                         margin_style);
    }
}

/// The names above the planes; planes less than two pixels apart share one.
struct Labels {
    std::vector<double> lines;
    std::vector<std::string> texts;

    void add(double x, const std::string& text) {
        if (!texts.empty() && x - lines.back() < 2) {
            texts.back() += ", " + text;
            return;
        }
        lines.push_back(x);
        texts.push_back(text);
    }
};

}  // namespace

std::string side_view_svg(const Subject& display, SideFrame* frame) {
    // The planes that have names.
    const Subject s = section_of(display);
    const Display& d = s.display();
    const Geometry& g = s.geometry();
    const DrawnPlanes planes(s);
    const Vec3d& eye = d.camera.position_mm;
    std::vector<std::pair<double, std::string>> named{{0, "panel"}, {g.vertex_plane_mm, "lenses"}, {eye[2], "eye"}};
    if (g.diffuser_z_mm) named.emplace_back(*g.diffuser_z_mm, "diffuser");
    if (std::isfinite(planes.central)) named.emplace_back(planes.central, "central depth plane");
    for (const double z : planes.marginal)
        if (std::isfinite(z)) named.emplace_back(z, "marginal plane");
    std::stable_sort(named.begin(), named.end(), [](const auto& a, const auto& b) { return a.first < b.first; });

    // The layout: names in rows above the drawing, as many as needed so that none overlap.
    double high = 0;
    SideScale scale = scale_for(s, planes, 0, high);
    Labels labels;
    for (const auto& [z, text] : named) labels.add(scale.at(0, z)[0], text);
    const std::vector<LabelPlace> places = place_labels(labels.lines, labels.texts, 12, width);
    int label_rows = 0;
    for (const LabelPlace& place : places) label_rows = std::max(label_rows, place.row + 1);
    const double top = 18 + 16 * label_rows, bottom = top + high;
    scale.middle += top;
    if (frame) {
        const double wide = drawn - 2 * (scale.left - side), half_y = 0.5 * high / scale.per_y;
        *frame = {scale.y0 - half_y, scale.y0 + half_y, scale.z0, scale.z0 + wide / scale.per_z, scale.left, top, wide, high};
    }

    // Dimensions below the drawing: L, the diffuser's distance, the eye's.
    std::vector<std::tuple<double, double, std::string>> lengths;
    if (std::isfinite(planes.central))
        lengths.emplace_back(g.rear_principal_mm, planes.central, "L = " + mm(s.theory().central_depth_mm));
    if (g.diffuser_z_mm) lengths.emplace_back(g.vertex_plane_mm, *g.diffuser_z_mm, "diffuser " + mm(d.diffuser->distance_mm));
    lengths.emplace_back(0, eye[2], "eye " + mm(eye[2]));

    SvgDrawing drawing(width, bottom + 26 + 24 * double(lengths.size()) + 16,
                       "The display from the side, from the panel to the eye");
    const auto upright = [&](double z, double low, double up, const char* style) {
        drawing.line(scale.at(low, z), scale.at(up, z), style);
    };
    for (std::size_t k = 0; k < places.size(); ++k) {
        const double y = top - 9 - 16 * places[k].row;
        drawing.text({places[k].x, y}, labels.texts[k], "font-size=\"12\"");
        drawing.line({labels.lines[k], y - 9}, {labels.lines[k], bottom}, "stroke-opacity=\"0.25\"");
    }
    drawing.line({scale.at(0, scale.z0)[0] - 12, scale.at(0, 0)[1]},
                 {scale.at(0, std::max(eye[2], g.top_z_mm))[0] + 12, scale.at(0, 0)[1]},
                 "stroke-opacity=\"0.5\" stroke-dasharray=\"10 3 2 3\"");

    // Planes and rays, and over them lenses, panel and eye.
    const double offset = g.lattice.offset[1], half = half_height(g);
    if (std::isfinite(planes.central)) upright(planes.central, offset - half, offset + half, plane_style);
    for (const double z : planes.marginal)
        if (std::isfinite(z)) upright(z, offset - half, offset + half, margin_style);
    if (g.diffuser_z_mm) upright(*g.diffuser_z_mm, offset - half, offset + half, diffuser_style);
    draw_backward(drawing, scale, s);
    draw_pixel(drawing, scale, s, planes);
    const Point lens = scale.at(offset + half, g.base_z_mm);
    drawing.rectangle(lens, std::max(1.5, scale.per_z * (g.top_z_mm - g.base_z_mm)), 2 * half * scale.per_y, glass_style);
    upright(0, -0.5 * g.panel_height_mm, 0.5 * g.panel_height_mm, "stroke-width=\"3\"");
    const Point at_eye = scale.at(eye[1], eye[2]);
    drawing.path(std::array<Point, 3>{{at_eye, {at_eye[0] + 22, at_eye[1] - 10}, {at_eye[0] + 22, at_eye[1] + 10}}},
                 "stroke-width=\"1.3\"", true);

    // Dimensions: the panel's height at the left, the lengths below.
    const double low = scale.at(-0.5 * g.panel_height_mm, 0)[1], up = scale.at(0.5 * g.panel_height_mm, 0)[1];
    const double x = scale.at(0, scale.z0)[0] - 22, y = 0.5 * (low + up);
    drawing.dimension({x, low}, {x, up}, "");
    drawing.text({x - 6, y}, mm(g.panel_height_mm),
                 fmt::format("font-size=\"12\" text-anchor=\"middle\" transform=\"rotate(-90 {} {})\"", px(x - 6), px(y)));
    double row = bottom + 26;
    for (const auto& [from, to, text] : lengths) {
        drawing.dimension({scale.at(0, from)[0], row}, {scale.at(0, to)[0], row}, text);
        row += 24;
    }
    drawing.text({width - 12, row - 2},
                 scale.true_to_scale() ? std::string("to scale")
                                       : fmt::format("heights drawn {:.3g} times as large as depths", scale.per_y / scale.per_z),
                 "font-size=\"12\" text-anchor=\"end\" fill-opacity=\"0.7\"");
    return drawing.svg();
}

}  // namespace lfdsim
