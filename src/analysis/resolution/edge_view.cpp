// Slanted edges on the panel and in pictures. docs/measures.md, "Resolution", edges.
//
// Positions in the bars' plane are (a, b), a across upright bars to the right and b along them downwards: (x, -y). For bars that
// are not upright they are (-y, x). A picture, transposed for the latter, has its columns along a and its rows along b.

#include "analysis/resolution/edge_view.h"

#include "analysis/core/elemental_panel.h"
#include "base/constants.h"
#include "content/pickup/pickup.h"
#include "content/pickup/shown_points.h"
#include "geometry/resolve.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

constexpr int samples_a_pixel = 16;

/// A rectangle along a and b, mm.
struct ScreenRect {
    double a, b, half_a, half_b;  // centre and half sizes
};

/// Returns the upright rectangle within the array and in front of the panel, less a lens at each border; along x and y.
ScreenRect screen_middle(const Geometry& g) {
    const double c = std::abs(g.lattice.cos_turn), s = std::abs(g.lattice.sin_turn);
    const double w = 0.5 * g.array_width_mm, h = 0.5 * g.array_height_mm;
    // The largest scaled copy of the array's rectangle that fits upright into the rotated one
    const double share = std::min(w / (w * c + h * s), h / (w * s + h * c));
    const auto along = [&](double offset, double array_half, double panel_half, double pitch, double& centre, double& half) {
        const double low = std::max(offset - array_half, -panel_half), high = std::min(offset + array_half, panel_half);
        centre = 0.5 * (low + high);
        half = 0.5 * (high - low);
        if (half > 2 * pitch) half -= pitch;
    };
    ScreenRect box{};
    along(g.lattice.offset[0], share * w, 0.5 * g.panel_width_mm, g.lattice.pitch[0], box.a, box.half_a);
    along(g.lattice.offset[1], share * h, 0.5 * g.panel_height_mm, lens_pitch_mm(g, 1), box.b, box.half_b);
    return box;
}

/// Returns the rectangle of the bars' plane that the eye sees through the middle of the screen, not longer than slanted edges
/// remain within its width.
ScreenRect seen_box(const Geometry& g, const Bars& bars, const EdgeEye& eye) {
    const ScreenRect m = screen_middle(g);
    const double k = scale_to_plane(g, bars.z_mm, eye), x = eye.x_mm() + (m.a - eye.x_mm()) * k, y = m.b * k;
    ScreenRect box = bars.upright ? ScreenRect{x, -y, m.half_a * k, m.half_b * k} : ScreenRect{-y, x, m.half_b * k, m.half_a * k};
    box.half_b = std::min(box.half_b, 0.5 * box.half_a / std::tan(std::abs(bars.lean_deg) * degree));
    return box;
}

Image transposed(const Image& from) {
    Image to(from.height, from.width);
    for (int row = 0; row < from.height; ++row)
        for (int column = 0; column < from.width; ++column) std::copy_n(from.at(column, row), 3, to.at(row, column));
    return to;
}

}  // namespace

std::vector<Direction> directions(const Geometry& g) {
    if (g.lattice.strips) return {{"across", "across the strips", g.lattice.cos_turn, g.lattice.sin_turn, 0}};
    return {{"horizontal", "horizontal", 1, 0, 0}, {"vertical", "vertical", 0, 1, 1}};
}

Bars bars_across(const Direction& direction, double z_mm) {
    const bool upright = std::abs(direction.x) >= std::abs(direction.y);
    // Edges at right angles to the direction lean by this angle, within 45 degrees.
    const double straight = (upright ? std::atan(-direction.y / direction.x) : std::atan(-direction.x / direction.y)) / degree;
    // The edge is not along the panel's rows or columns, where all of its parts would meet the pixels alike, but not far from
    // them either, since long edges then fit on the screen.
    const double sign = straight < 0 ? -1 : 1,
                 lean = std::abs(straight) <= 20 ? straight + sign * slant_deg : straight - sign * slant_deg;
    return {upright, lean, z_mm, 1, 1, 0};
}

double scale_to_plane(const Geometry& g, double z_mm, const EdgeEye& eye) {
    return (eye.z_mm() - z_mm) / (eye.z_mm() - g.vertex_plane_mm);
}

std::array<double, 2> across(const Bars& bars) {
    const double c = std::cos(bars.lean_deg * degree), s = std::sin(bars.lean_deg * degree);
    return bars.upright ? std::array{c, -s} : std::array{s, -c};
}

std::unique_ptr<ShownPanel> bars_panel(const Display& display, const Geometry& geometry, const std::optional<Bars>& bars,
                                       int threads) {
    const Pickup pickup(display, geometry);
    Texels texels(display.panel.pixels[0], display.panel.pixels[1]);
    const double height = bars ? bars->z_mm - pickup.z_rear : 0;
    const std::array<double, 2> axis = bars ? across(*bars) : std::array<double, 2>{};
    const std::vector<ShownPoints> points = shown_points(display);
    const std::size_t alike = 3 / points.size();  // channels that are made for the same points
    tbb::parallel_for(std::int64_t(0), texels.rows(), [&](std::int64_t row) {
        float* texel = texels.row(row);
        for (std::int64_t k = 0; k < texels.columns(); ++k, texel += 4)
            for (std::size_t channel = 0; channel < points.size(); ++channel) {
                const auto shown = points[channel].of(k, row);
                if (!shown) continue;
                const NodalLine l = pickup.line(pickup.x_mm(double(k) + (*shown)[0]), pickup.y_mm(double(row) + (*shown)[1]));
                if (!l.owned) continue;
                if (bars) {
                    // The point that the nodal line meets in the bars' plane, across the bars
                    const double u = (l.x + height * l.mx) * axis[0] + (l.y + height * l.my) * axis[1] - bars->offset_mm;
                    if (std::fmod(std::floor(u / bars->width_mm), 2) != 0) continue;
                }
                std::fill_n(texel + channel, alike, 1.f);
            }
    });
    return std::make_unique<ShownPanel>(std::move(texels), threads);
}

double EdgeEye::x_mm() const { return distance_mm * std::sin(angle_deg * degree) + aside_mm; }
double EdgeEye::z_mm() const { return distance_mm * std::cos(angle_deg * degree); }

std::array<double, 2> seen_half_mm(const Geometry& g, const Bars& bars, const EdgeEye& eye) {
    const ScreenRect box = seen_box(g, bars, eye);
    return {box.half_a, box.half_b};
}

EdgeView edge_view(const Display& display, const Geometry& geometry, const Bars& bars, const EdgeEye& eye, double pixel_mm) {
    EdgeView view{display, {}, {}};
    const double sine = std::sin(bars.lean_deg * degree), cosine = std::cos(bars.lean_deg * degree), tangent = sine / cosine;
    // Filtered samples average the panel over boxes, which would count as blur. Point samples are noisy, which does not bias the
    // mean edge.
    view.seen.render.estimator = Estimator::point;
    view.seen.render.samples = samples_a_pixel;
    ScreenRect box = seen_box(geometry, bars, eye);
    box.half_b = 0.5 * bars.length_mm;
    // The distance from an edge's middle to its farthest pixel
    const double margin = box.half_b * std::abs(tangent) + 0.5 * bars.width_mm / cosine;
    const double pitch = lens_pitch_mm(geometry, bars.upright ? 1 : 0);
    const double apart =  // along the edges from lens to lens; strips cross them at the slant
        is_strips(display.array) ? pitch / std::sin(slant_deg * degree) : pitch;
    const int per_edge = std::max(1, int(2 * box.half_b / (cosine * scale_to_plane(geometry, bars.z_mm, eye) * apart)));
    // Returns the position a of the middle of edge k.
    const auto middle = [&](double k) { return (bars.offset_mm + k * bars.width_mm - box.b * sine) / cosine; };
    const double nearest = std::round((box.a * cosine + box.b * sine - bars.offset_mm) / bars.width_mm);
    // The edges that fit with their whole reach
    double first = nearest, last = nearest;
    const auto fits = [&](double k) { return std::abs(middle(k) - box.a) + margin <= box.half_a; };
    if (!fits(nearest)) return view;
    while (fits(first - 1)) --first;
    while (fits(last + 1)) ++last;
    view.lenses = per_edge * int(last - first + 1);

    // The crop, in pixels from the camera's axis, which meets the bars' plane at (axis_a, axis_b)
    const double axis_a = bars.upright ? eye.x_mm() : -eye.aside_mm, axis_b = bars.upright ? -eye.aside_mm : eye.x_mm();
    const int i0 = int(std::floor((middle(first) - margin - axis_a) / pixel_mm)),
              i1 = int(std::ceil((middle(last) + margin - axis_a) / pixel_mm)),
              j0 = int(std::ceil((box.b - box.half_b - axis_b) / pixel_mm)),
              j1 = std::max(j0 + 1, int(std::floor((box.b + box.half_b - axis_b) / pixel_mm)));
    const int half_a = std::max(std::abs(i0), std::abs(i1)), half_b = std::max(std::abs(j0), std::abs(j1));
    const Rect across{i0 + half_a, j0 + half_b, i1 + half_a, j1 + half_b};
    view.crop = bars.upright ? across : Rect{across.y0, across.x0, across.y1, across.x1};
    // A camera that looks along -z, with a frame in the panel's plane: the bars' plane then has pixels of pixel_mm.
    Camera& camera = view.seen.camera;
    camera = {};
    camera.position_mm = {eye.x_mm(), eye.aside_mm, eye.z_mm()};
    camera.target_mm = {eye.x_mm(), eye.aside_mm, 0};
    camera.resolution = {2 * (bars.upright ? half_a : half_b), 2 * (bars.upright ? half_b : half_a)};
    camera.frame_width_mm = double(camera.resolution[0]) * pixel_mm * eye.z_mm() / (eye.z_mm() - bars.z_mm);

    view.edges.slope = -tangent;
    view.edges.reach = 0.5 * bars.width_mm / pixel_mm;
    for (double k = first; k <= last; ++k) {
        const double a = middle(k) - (axis_b + j0 * pixel_mm - box.b) * tangent;  // in the crop's first row
        view.edges.lines.push_back({(a - axis_a) / pixel_mm - i0, std::fmod(k, 2) == 0});
    }
    return view;
}

Image picture_of(const EdgeView& view, bool upright, const SummedPanel& panel, RenderOptions how, const Job& job) {
    how.crop = view.crop;
    Image picture = whole_picture(view.seen, resolve(view.seen), panel, how, job);
    return upright ? std::move(picture) : transposed(picture);
}

}  // namespace lfdsim
