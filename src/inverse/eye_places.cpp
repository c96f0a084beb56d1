#include "inverse/eye_places.h"

#include "base/constants.h"
#include "base/input_error.h"
#include "geometry/camera.h"
#include "geometry/vec.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

constexpr const char* eyes_key = "content.inverse.eyes_mm";

std::string text_of(const Vec3d& p) { return fmt::format("[{:.5g}, {:.5g}, {:.5g}]", p[0], p[1], p[2]); }

/// Returns the solution above 1 of x^(n + 1) = x + 1, by iteration: the golden ratio for n = 1.
double generalised_golden_ratio(int n) {
    double x = 1.5;
    for (int step = 0; step < 50; ++step) x = std::pow(1 + x, 1. / (n + 1));
    return x;
}

/// Returns place k of the recurrence in a box: along its d sides of some length, the shares frac(1/2 + (k + 1)/phi^i), i = 1 .. d.
Vec3d place_in(const EyeBox& box, std::int64_t k) {
    int dimensions = 0;
    for (std::size_t c = 0; c < 3; ++c) dimensions += box.high[c] > box.low[c];
    if (dimensions == 0) return box.low;
    const double step = 1 / generalised_golden_ratio(dimensions);
    Vec3d place = box.low;
    double share = 1;
    for (std::size_t c = 0; c < 3; ++c) {
        if (!(box.high[c] > box.low[c])) continue;
        share *= step;
        const double at = 0.5 + double(k + 1) * share;
        place[c] += (at - std::floor(at)) * (box.high[c] - box.low[c]);
    }
    return place;
}

/// Returns the distance along an axis, 0 or 1, at which eyes at the height z see the same panel pixels through the next lenses:
/// p (D - H' + g)/g. It is infinite along strips; the least of both axes in a turned array.
double view_period_mm(const Geometry& geometry, std::size_t axis, double z_mm) {
    const Lattice<double>& lattice = geometry.lattice;
    if (lattice.strips && axis != line_of_eyes(lattice)) return infinity;
    const double pitch = lattice.strips           ? lattice.pitch[0]
                         : geometry.turn_deg != 0 ? std::min(lattice.pitch[0], lattice.pitch[1])
                                                  : lattice.pitch[axis];
    return pitch * (z_mm - geometry.rear_principal_mm + geometry.gap_mm) / geometry.gap_mm;
}

/// Returns the largest slopes to the sides and up, from the eye's line of sight, of a rectangle's corners, which are turned by
/// `turn_deg` about its middle; infinite if not all are in front of the eye.
std::array<double, 2> half_slopes(const Vec3d& middle, double width, double height, double turn_deg, const Vec3d& eye,
                                  const CameraAxes& axes) {
    std::array<double, 2> most{};
    const double turn = turn_deg * degree, c = std::cos(turn), s = std::sin(turn);
    for (const double x : {-0.5 * width, 0.5 * width})
        for (const double y : {-0.5 * height, 0.5 * height}) {
            const Vec3d corner{middle[0] + c * x - s * y, middle[1] + s * x + c * y, middle[2]};
            const Vec3d ray = minus(corner, eye);
            const double depth = dot(ray, axes.forward);
            if (!(depth > 0)) return {infinity, infinity};
            most[0] = std::max(most[0], std::abs(dot(ray, axes.right)) / depth);
            most[1] = std::max(most[1], std::abs(dot(ray, axes.up)) / depth);
        }
    return most;
}

/// Returns half the width and half the height, as such slopes, of what an eye sees of the array, or of the panel through it if that
/// is less. Throws InputError if the array is not in front of the eye.
std::array<double, 2> half_slopes(const Display& d, const Geometry& g, const Vec3d& eye, const CameraAxes& axes) {
    const std::array<double, 2> array = half_slopes({g.lattice.offset[0], g.lattice.offset[1], g.vertex_plane_mm}, g.array_width_mm,
                                                    g.array_height_mm, g.turn_deg, eye, axes);
    if (std::isinf(array[0])) throw InputError(eyes_key, fmt::format("from {} the array is not in front of the eye", text_of(eye)));
    // The line from the eye E through a lens's middle X meets the panel at X + (X - E) k, k = g/(E_z - z_V). A ray ends elsewhere
    // by less than a pitch, and the diffuser turns it by less than twice its half width.
    const double k = g.gap_mm / (eye[2] - g.vertex_plane_mm), up = d.diffuser ? *g.diffuser_z_mm - g.vertex_plane_mm : 0;
    const double pitch = is_strips(d.array) ? d.array.pitch_mm[0] : std::max(d.array.pitch_mm[0], d.array.pitch_mm[1]);
    std::array<double, 2> size{g.panel_width_mm, g.panel_height_mm};
    for (const std::size_t c : {0u, 1u}) {
        const double spread = d.diffuser ? up * std::tan(std::min(d.diffuser->angle_deg[c], 80.) * degree) : 0;
        size[c] = (size[c] + 2 * std::abs(eye[c]) * k) / (1 + k) + 2 * (pitch + spread);
    }
    const std::array<double, 2> panel = half_slopes({0, 0, g.vertex_plane_mm}, size[0], size[1], 0, eye, axes);
    return {std::min(array[0], panel[0]), std::min(array[1], panel[1])};
}

}  // namespace

std::vector<EyeBox> eye_boxes(const Display& display) {
    const std::vector<Vec3d>& corners = display.content.inverse.eyes_mm;
    std::vector<EyeBox> boxes;
    for (std::size_t k = 0; k + 1 < corners.size(); k += 2) {
        EyeBox box;
        for (std::size_t c = 0; c < 3; ++c) {
            const auto finite = [&](double mm) { return std::isinf(mm) ? display.camera.position_mm[c] : mm; };
            const double a = finite(corners[k][c]), b = finite(corners[k + 1][c]);
            box.low[c] = std::min(a, b);
            box.high[c] = std::max(a, b);
        }
        boxes.push_back(box);
    }
    return boxes;
}

bool is_inside(const EyeBox& box, const Vec3d& p) {
    for (std::size_t c = 0; c < 3; ++c)
        if (p[c] < box.low[c] || p[c] > box.high[c]) return false;
    return true;
}

double view_step_mm(const Display& display, const Geometry& geometry, double z_mm) {
    const double step = (z_mm - geometry.rear_principal_mm) * display.panel.pixel_pitch_mm / geometry.gap_mm;
    return is_strips(display.array) && display.panel.subpixels != SubpixelLayout::none ? step / 3 : step;
}

double views_within(std::span<const EyeBox> boxes, const Display& display, const Geometry& geometry) {
    double views = 0;
    for (const EyeBox& box : boxes) {
        const double step = view_step_mm(display, geometry, box.low[2]);
        const auto side = [&](std::size_t axis) { return box.high[axis] - box.low[axis]; };
        views += (is_strips(display.array) ? side(line_of_eyes(geometry.lattice)) : std::max(side(0), side(1))) / step;
    }
    return views;
}

std::vector<Vec3d> places_within(std::span<const EyeBox> boxes, std::int64_t first, std::int64_t count) {
    std::vector<Vec3d> places;
    const auto n = std::int64_t(boxes.size());
    for (std::int64_t k = first; k < first + count; ++k) places.push_back(place_in(boxes[std::size_t(k % n)], k / n));
    return places;
}

std::vector<Vec3d> places_around(std::span<const EyeBox> boxes, const Display& display, const Geometry& geometry, double view_steps,
                                 std::int64_t count) {
    std::vector<Vec3d> places;
    if (!(view_steps > 0)) return places;
    std::vector<EyeBox> wider(boxes.begin(), boxes.end());
    for (EyeBox& box : wider) {
        const double steps = view_steps * view_step_mm(display, geometry, box.low[2]);
        for (const std::size_t c : {0u, 1u}) {
            const double reach =
                std::clamp(0.5 * (view_period_mm(geometry, c, box.low[2]) - (box.high[c] - box.low[c])), 0., steps);
            box.low[c] -= reach;
            box.high[c] += reach;
        }
    }
    for (std::int64_t k = 0; std::int64_t(places.size()) < count && k < 1000 * count; ++k) {
        const Vec3d place = places_within(wider, k, 1)[0];
        if (std::none_of(boxes.begin(), boxes.end(), [&](const EyeBox& box) { return is_inside(box, place); }))
            places.push_back(place);
    }
    return places;
}

double element_mm(const Display& display, const Geometry& geometry, const Vec3d& eye, double content_z_mm) {
    if (display.content.inverse.pixel_mm) return *display.content.inverse.pixel_mm;
    double finest =
        std::min(display.array.pitch_mm[0], is_strips(display.array) ? display.array.pitch_mm[0] : display.array.pitch_mm[1]);
    const double image = theory(display, geometry).pixel_image_mm;  // NaN of pinholes, which have no image plane
    if (image < finest) finest = image;
    // Stripes of subpixels: an element must average over the colours of the rows that it sees, wherever it lies.
    if (display.panel.subpixels != SubpixelLayout::none) finest = std::max(finest, 12 * display.panel.pixel_pitch_mm);
    const double arc_minute = std::abs(eye[2] - content_z_mm) * std::tan(degree / 60);
    return std::max(finest / 2, arc_minute);
}

namespace {

/// Makes the camera that of an eye: with a pupil, over whole pixels, by points.
void give_pupil(Display& d) {
    d.camera.pixel_filter = PixelFilter::box;
    d.camera.pupil_diameter_mm = d.content.inverse.pupil_mm.value_or(d.camera.pupil_diameter_mm.value_or(usual_pupil_mm));
    d.render.estimator = Estimator::point;
}

/// Throws InputError if the display is not valid with this camera.
void refuse_unseen(const Display& d) {
    for (const Problem& problem : validate(d))
        throw InputError(eyes_key, fmt::format("an eye at {} cannot see the display: {} {}", text_of(d.camera.position_mm),
                                               problem.where, problem.what));
}

}  // namespace

Display seen_by_camera_at(const Display& display, const Geometry& geometry, const Vec3d& eye,
                          std::array<std::int64_t, 2> resolution) {
    Display d = display;
    d.camera.position_mm = eye;
    d.camera.resolution = resolution;
    d.camera.fov_deg.reset();
    d.camera.frame_width_mm = geometry.frame_width_mm;
    give_pupil(d);
    refuse_unseen(d);
    return d;
}

Display seen_by_eye(const Display& display, const Geometry& geometry, const Vec3d& eye, double content_z_mm, double shift_x,
                    double shift_y) {
    const double front = std::max(geometry.top_z_mm, geometry.diffuser_z_mm.value_or(0));
    if (!(eye[2] > front))
        throw InputError(eyes_key, fmt::format("an eye at {} is not in front of the display, which reaches to z = {:.5g} mm",
                                               text_of(eye), front));
    // The camera, and the size of an element as a slope at the distance in focus
    Display d = display;
    Camera& camera = d.camera;
    camera.position_mm = eye;
    camera.target_mm = {0, 0, 0};
    const CameraAxes axes = camera_axes(camera);
    const Vec3d middle{0, 0, content_z_mm};
    const double focus = dot(minus(middle, eye), axes.forward);
    if (!(focus > 0))
        throw InputError("content.depth_mm", fmt::format("the content's middle, at z = {:.5g} mm, is not in front of an eye at {}",
                                                         content_z_mm, text_of(eye)));
    const std::array<double, 2> half = half_slopes(display, geometry, eye, axes);
    const double slope = element_mm(display, geometry, eye, content_z_mm) / focus;  // of an element
    if (display.content.inverse.pixel_mm && std::min(half[0], half[1]) < slope)
        throw InputError(
            "content.inverse.pixel_mm",
            fmt::format("is {:g}; from {} the display is less than two elements of that width high or wide; give a smaller one",
                        *display.content.inverse.pixel_mm, text_of(eye)));
    // A frame of whole elements over the lenses, with one to spare on each side for the shift
    const double columns = std::ceil(2 * half[0] / slope) + 2, rows = std::ceil(2 * half[1] / slope) + 2;
    if (!(columns * rows < 1e8))
        throw InputError("content.inverse.pixel_mm",
                         fmt::format("a view from {} has {:.0f} x {:.0f} elements; give larger ones", text_of(eye), columns, rows));
    camera.resolution = {std::int64_t(columns), std::int64_t(rows)};
    camera.fov_deg.reset();
    camera.frame_width_mm = columns * slope * axes.distance_mm;
    const double element_at_target = slope * axes.distance_mm;
    for (std::size_t c = 0; c < 3; ++c)
        camera.target_mm[c] += element_at_target * ((shift_x - 0.5) * axes.right[c] + (shift_y - 0.5) * axes.up[c]);
    camera.focus_distance_mm = focus;
    give_pupil(d);
    refuse_unseen(d);
    return d;
}

}  // namespace lfdsim
