#include "analysis/core/eye_rays.h"

#include "base/constants.h"
#include "engine/scene/traced_display.h"
#include "geometry/vec.h"
#include "optics/sampler.h"
#include "optics/trace.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

/// Returns the cosine between a ray and the axis of the ideal lens in `cell`, which it passes, below the lens over that above it.
/// The ray is one for trace_any().
double cosines(const optics::TracedDisplay<double>& scene, const optics::Extent<double>& extent,
               const optics::PanelBase<double>& base, const optics::Ray<double>& ray, optics::Cell<double> cell) {
    optics::Passage<double> passage{ray, cell, 1, true};
    optics::to_first_vertex(scene, passage);
    // The ray in the lens's frame: its direction, and where it meets the lens
    optics::Vec3<double> q = passage.ray.at, to = passage.ray.to;
    double power = scene.ideal_power;
    if (scene.misaligned.given) {
        const optics::Ray<double> in_array = optics::in_array(scene, base, passage.ray);
        const auto met = optics::meet_misaligned<optics::Facts{}>(scene, extent, in_array, 1 / in_array.to.z, cell);
        q = met.entering.at, to = met.entering.to;
        power *= met.pose.curvature;
    } else {
        const auto axis = optics::axis_of(scene.lattice, cell);
        q.x -= axis.x, q.y -= axis.y;
    }
    const double x = to.x / to.z + power * q.x, y = to.y / to.z + power * optics::across(scene.lattice, q.y);
    return -1 / (to.z * std::sqrt(1 + x * x + y * y));
}

/// Returns whether a line in a glass surround meets a lens, and its cell. In `clear` all glass is lenses; in `plate` a lens is
/// where the surface is not flat. The ray is in the array's frame, from the base lens's axis, z from the panel.
bool first_lens(const optics::TracedDisplay<double>& scene, const optics::Extent<double>& extent, const optics::Ray<double>& ray,
                optics::Cell<double>& cell) {
    optics::GlassRays<double> rays{ray.at, ray.to, {0, 0}, false, false};
    double weight = 1;
    for (int surfaces = 0; surfaces < 4; ++surfaces) {  // a sheet's two faces, and as many reflections
        optics::Crossing<double> next{1e30, {0, 0, 1}, {0, 0}, false};
        const bool clear = scene.surround == Surround::clear;
        if (clear)
            optics::next_in_clear(scene, extent, rays, true, next);
        else
            optics::next_in_plate(scene, extent, rays, true, next);
        if (!next.found) return false;
        if (clear || std::hypot(next.normal.x, next.normal.y) > 0) {
            cell = next.cell;
            return true;
        }
        optics::cross(scene, next, true, rays, weight);
    }
    return false;
}

}  // namespace

std::vector<Choice> even_choices(int count, std::uint32_t set) {
    optics::Sampler<double> sampler(Sampling::sobol, optics::sampler_dimensions, 0, set);
    std::vector<Choice> choices;
    choices.reserve(std::size_t(count));
    for (int n = 0; n < count; ++n) {
        choices.push_back({sampler(0), sampler(1), sampler(2), sampler(3), sampler(4), sampler(5)});
        sampler.next(sobol_directions());
    }
    return choices;
}

optics::Vec2<double> chosen_axis(const Lattice<double>& lattice, const Choice& choice) {
    const auto number = [&](std::size_t k) {
        return std::min(std::floor((0.5 + 0.5 * choice[4 + k]) * lattice.count[k]), lattice.count[k] - 1);
    };
    return optics::axis_in_array(lattice, optics::Cell<double>{number(0), number(1)});
}

std::array<double, 2> pixel_place(const Panel& panel, const Sight& sight) {
    return {sight.x / panel.pixel_pitch_mm + 0.5 * double(panel.pixels[0]),
            0.5 * double(panel.pixels[1]) - sight.y / panel.pixel_pitch_mm};
}

EyeRays::EyeRays(const Display& d, const Geometry& g)
    : scene_(make_traced_display<double>(d, g)),
      vertex_plane_(g.vertex_plane_mm),
      start_z_(make_ray_origin(d, g).start_z),
      panel_behind_(g),
      stop_first_(scene_.has_stop && !scene_.misaligned.given && g.stop_z_mm >= g.top_z_mm - 1e-9),
      base_(optics::base_cell(g.lattice, {std::floor(g.lattice.count[0] / 2), std::floor(g.lattice.count[1] / 2)})) {}

Vec3d EyeRays::point(double x, double y) const {
    const Place at = optics::in_display(scene_.lattice, Place{x, y});
    return {at.x, at.y, vertex_plane_};
}

Sight EyeRays::look(const Vec3d& eye, const Choice& choice) const {
    const Vec3d at = aim(eye, choice);
    if (!panel_behind_.meets(eye, at[0], at[1])) return {.on_screen = false};
    return look_through(eye, at, choice[2], choice[3]);
}

Vec3d EyeRays::aim(const Vec3d& eye, const Choice& choice) const {
    const Lattice<double>& lattice = scene_.lattice;
    const Place axis = chosen_axis(lattice, choice);
    Place moved{0, 0};
    // With a diffuser, the displacement that it gives the line through the lens's axis, from its plane down to the vertex plane
    if (scene_.has_diffuser) {
        const Vec3d centre = point(axis.x, axis.y), to = normalised(minus(centre, eye));
        const optics::Vec3<double> turned =
            optics::scatter(scene_, optics::Vec3<double>{to[0], to[1], to[2]}, choice[2], choice[3]);
        const double down = vertex_plane_ - start_z_;
        if (turned.z < -1e-3)
            moved = optics::to_array(lattice, down * (turned.x / turned.z - to[0] / to[2]),
                                     down * (turned.y / turned.z - to[1] / to[2]));
        if (lattice.strips) moved.y = 0;
    }
    // The position in the cell, less the displacement, cyclically within the cell: the line then meets the lens at the position
    // chosen.
    const auto in_cell = [&](std::size_t k, double by) {
        const double place = 0.5 * choice[k] - by / lattice.pitch[k];
        return lattice.pitch[k] * (place - std::floor(place + 0.5));
    };
    const Place place{in_cell(0, moved.x), in_cell(1, moved.y)};
    // The rectangles p by p_y about the axes cover the plane as the cells do: a position outside of this cell lies in a
    // neighbouring one, and is taken relative to that.
    const Place centre = optics::axis_of(lattice, optics::cell_at(lattice, place.x, place.y));
    return point(axis.x + (place.x - centre.x), axis.y + (place.y - centre.y));
}

Sight EyeRays::look_through(const Vec3d& eye, const Vec3d& at, double a, double b) const {
    return look_along(at, normalised(minus(at, eye)), a, b);
}

int EyeRays::more_for(const Vec3d& eye) const {
    int through = 0, more = 1;
    constexpr int tried = 4096;
    for (const Choice& choice : even_choices(tried)) through += look(eye, choice).through;
    while (more < 8 && 2 * more * through < tried) more *= 2;
    return more;
}

Sight EyeRays::look_along(const Vec3d& at, const Vec3d& to, double a, double b) const {
    // The point where the line crosses the first plane, in the array's frame
    const double up = (start_z_ - at[2]) / to[2];
    const Lattice<double>& lattice = scene_.lattice;
    const auto [x0, y0] = optics::to_array(lattice, at[0] + up * to[0] - lattice.offset[0], at[1] + up * to[1] - lattice.offset[1]);
    Place base_axis = optics::axis_in_array(lattice, base_);
    double raised = 0;  // of the base lens, where the array is not parallel to the panel
    if (scene_.misaligned.wedged) {
        const auto vertex = optics::wedged<double>(scene_.misaligned, false, {base_axis.x, base_axis.y, 0});
        base_axis = {vertex.x, vertex.y};
        raised = vertex.z;
    }
    // The tracer's ray starts relative to the base lens's axis, its direction in the display's frame.
    optics::Ray<double> ray{{x0 - base_axis.x, y0 - base_axis.y, 0}, {to[0], to[1], to[2]}};
    if (scene_.has_diffuser) ray.to = optics::scatter(scene_, ray.to, a, b);
    if (!(ray.to.z < 0)) return {};
    const optics::Extent<double> extent{-base_.i, lattice.count[0] - 1 - base_.i, -base_.j, lattice.count[1] - 1 - base_.j};
    // Returns the point where the line would reach the height z without the lenses, in the array's frame from the base lens's
    // axis.
    const auto come_down_to = [&](double z) {
        const double fall = (z - start_z_) / ray.to.z;
        const auto [dx, dy] = optics::to_array(lattice, fall * ray.to.x, fall * ray.to.y);
        return std::array{ray.at.x + dx, ray.at.y + dy};
    };
    if (stop_first_) {  // most lines end at the stop, and need not be traced then
        const auto [x, y] = come_down_to(scene_.stop_z);
        if (!optics::passes_stop(scene_, extent, x, y)) return {};
    }
    // The end is relative to where the base lens's axis meets the panel.
    const optics::PanelBase<double> on_panel{0, 0, 0, 0, raised};
    const optics::PanelPoint<double> end = optics::trace_any<double>(scene_, extent, on_panel, ray, true);
    if (!end.alive || !(end.weight > 0)) return {};

    // The end on the panel, in mm from its centre; rows count downwards.
    const Vec3d base = point(base_axis.x, base_axis.y);
    const double x = base[0] + end.column / scene_.pixels_per_mm, y = base[1] - end.row / scene_.pixels_per_mm;
    const bool beside =
        std::abs(x) * scene_.pixels_per_mm > 0.5 * scene_.columns || std::abs(y) * scene_.pixels_per_mm > 0.5 * scene_.rows;
    optics::Cell<double> cell = end.cell;
    bool by_lens = true;
    if (!scene_.ideal && scene_.surround != Surround::opaque) {  // rays may change cells: their lens is the first that they meet
        const auto [leaves_x, leaves_y] = come_down_to(vertex_plane_);
        cell = optics::cell_at(lattice, leaves_x, leaves_y);
        const auto [to_x, to_y] = optics::to_array(lattice, ray.to.x, ray.to.y);
        by_lens = first_lens(scene_, extent, {{ray.at.x, ray.at.y, start_z_}, {to_x, to_y, ray.to.z}}, cell);
    }
    const Place from_base = optics::axis_of(lattice, cell);
    return {true,
            beside ? 0 : end.weight,
            true,
            by_lens,
            x,
            y,
            point(base_axis.x + from_base.x, base_axis.y + from_base.y),
            {base_.i + cell.i, base_.j + cell.j},
            scene_.ideal ? cosines(scene_, extent, on_panel, ray, cell) : 1};
}

double checked_viewing_distance_mm(const Subject& s) {
    const double distance = s.viewing_distance_mm(), nearest = nearest_eye_mm(s.geometry());
    if (!(distance > nearest))
        throw InputError("--viewing-distance-mm",
                         fmt::format("{:.6g} mm from the panel is inside the display, whose lenses and diffuser "
                                     "reach to {:.6g} mm; give a greater distance",
                                     distance, nearest));
    return distance;
}

}  // namespace lfdsim
