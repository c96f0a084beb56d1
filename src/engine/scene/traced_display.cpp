#include "engine/scene/traced_display.h"

#include "base/constants.h"
#include "engine/estimator/limits.h"
#include "geometry/camera.h"
#include "geometry/resolve.h"
#include "optics/direction_numbers.h"

#include "engine/devices/kernel.h"
#include "engine/scene/misalignment.h"
#include "geometry/diffuser_profile.h"
#include "geometry/lens_misalignment.h"
#include "geometry/prescription.h"
#include "geometry/subpixels.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace lfdsim {

namespace {

using optics::Shape;

/// A lattice with each of its numbers rounded to S.
template <class S>
Lattice<S> rounded(const Lattice<double>& from) {
    const auto both = [](const double(&of)[2], S(&to)[2]) {
        for (int k = 0; k < 2; ++k) to[k] = S(of[k]);
    };
    Lattice<S> to{};
    both(from.pitch, to.pitch);
    both(from.per_pitch, to.per_pitch);
    both(from.half_pitch, to.half_pitch);
    both(from.count, to.count);
    both(from.offset, to.offset);
    to.cos_turn = S(from.cos_turn);
    to.sin_turn = S(from.sin_turn);
    to.staggered = from.staggered;
    to.hexagonal = from.hexagonal;
    to.strips = from.strips;
    return to;
}

template <class S>
optics::Interface<S> interface(double above, double below) {
    const double r = (above - below) / (above + below);
    return {S(above / below), S(above), S(below), S(1 - r * r)};
}

template <class S>
optics::SurfaceData<S> surface_data(const PlacedSurface& from) {
    optics::SurfaceData<S> to{};
    const bool terms = has_aspheric_terms(from);
    to.shape = terms ? Shape::asphere : from.curvature_per_mm == 0 ? Shape::plane : from.conic == 0 ? Shape::sphere : Shape::conic;
    to.terms = terms ? std::int32_t(from.even_asphere.size()) : 0;
    if (from.even_asphere.size() > max_asphere_terms)
        throw InputError("lens.surface.even_asphere", "has more terms than the " + std::to_string(max_asphere_terms) + " allowed");
    for (int i = 0; i < to.terms; ++i) to.asphere[i] = S(from.even_asphere[i]);
    to.z = S(from.z_mm);
    to.curvature = S(from.curvature_per_mm);
    to.conic = S(from.conic);
    to.semi_aperture = S(from.semi_aperture_mm);
    const double rim = sag_mm(from, from.semi_aperture_mm);
    to.rim = S(rim);
    to.c_rim = S(from.curvature_per_mm * rim);
    const auto [low, high] = sag_range_mm(from);
    to.low = S(low);
    to.high = S(high);
    to.media = interface<S>(from.index_above, from.index_below);
    return to;
}

template <class S>
void add_lens(optics::TracedDisplay<S>& scene, const Geometry& geometry) {
    const auto& surfaces = geometry.surfaces;
    scene.ideal = surfaces.front().form == SurfaceForm::thin;
    scene.glued = geometry.glued;
    if (scene.ideal) {
        scene.ideal_z = S(geometry.vertex_plane_mm);
        scene.ideal_power = S(1 / surfaces.front().focal_length_mm);
        scene.zone_top = scene.zone_bottom = scene.ideal_z;
        return;
    }
    if (surfaces.size() > max_surfaces)
        throw InputError("lens.surface", "has more than the " + std::to_string(max_surfaces) + " surfaces allowed");
    scene.surface_count = std::int32_t(surfaces.size());
    double wall_top = -INFINITY, wall_bottom = INFINITY;
    for (std::size_t k = 0; k < surfaces.size(); ++k) {
        const PlacedSurface& s = surfaces[surfaces.size() - 1 - k];  // the viewer's side first
        scene.surface[k] = surface_data<S>(s);
        const double rim = rim_z_mm(s);
        wall_top = std::max(wall_top, rim);
        wall_bottom = std::min(wall_bottom, rim);
    }
    const PlacedSurface& first = surfaces.back();
    const auto [low, high] = sag_range_mm(first);
    const double rim = sag_mm(first, first.semi_aperture_mm);
    scene.concave_front = low < rim - 1e-9 || first.z_mm + rim < wall_top - 1e-9;
    scene.zone_top = S(scene.concave_front ? wall_top : first.z_mm + high);
    scene.zone_bottom = S(scene.concave_front ? wall_top : first.z_mm + low);
    scene.body_top = S(geometry.top_z_mm);
    scene.body_bottom = S(geometry.base_z_mm);
    scene.wall_bottom = S(wall_bottom);
    scene.concave_back = surfaces.front().z_mm + sag_range_mm(surfaces.front())[1] > wall_bottom + 1e-9;
}

// The holes of the lenses (engine/estimator/strata.h). Seen from above, at angles up to the slope of its cap at the rim, a round
// lens is the circle of its rim; one that fills its cell is the cell, each edge at the height of its middle. A stop in front of the
// lens may be narrower.
template <class S>
void add_holes(optics::TracedDisplay<S>& scene, const Display& display, const Geometry& geometry, double start_z) {
    const PlacedSurface& first = geometry.surfaces.back();
    std::array<double, 2> z{};
    double radius = display.array.aperture == Aperture::circle ? first.semi_aperture_mm : 0;
    std::array<double, 2> edge{geometry.lattice.half_pitch[0], geometry.lattice.half_pitch[1]};
    // The border is taken at the root mean square distance of a hexagon's border from its axis; strips end at their sides only.
    if (geometry.lattice.hexagonal) edge.fill(edge[0] * std::sqrt(10.0) / 3);
    if (geometry.lattice.strips) edge[1] = edge[0];
    for (std::size_t k = 0; k < 2; ++k) z[k] = first.z_mm + sag_mm(first, radius > 0 ? radius : edge[k]);
    scene.lit_between = display.array.surround != Surround::opaque;
    if (stop_at_entrance(display, geometry) && (radius == 0 || *display.lens.stop_radius_mm < radius)) {
        radius = *display.lens.stop_radius_mm;
        z.fill(geometry.stop_z_mm);
        scene.lit_between = false;
    }
    const bool strips = is_strips(display.array);
    scene.hole_radius = S(strips ? 0 : radius);
    scene.hole_half = S(strips && radius > 0 ? radius : geometry.lattice.half_pitch[0]);
    for (std::size_t k = 0; k < 2; ++k) scene.holes_below[k] = S(start_z - z[k]);
}

template <class S>
void add_layers(optics::TracedDisplay<S>& scene, const Geometry& geometry) {
    const std::vector<PlacedLayer>& layers = geometry.layers;
    if (layers.size() > max_layers)
        throw InputError("panel.layer", "has more than the " + std::to_string(max_layers) + " layers allowed");
    scene.layer_count = std::int32_t(layers.size());
    scene.layers_top = S(geometry.layers_top_mm);
    double above = 1;
    for (std::size_t k = 0; k < layers.size(); ++k) {
        const PlacedLayer& layer = layers[layers.size() - 1 - k];
        scene.layer[k] = {S(layer.thickness_mm), interface<S>(above, layer.index)};
        above = layer.index;
    }
}

template <class S>
optics::Emission<S> make_emission(const Panel& panel) {
    optics::Emission<S> to{};
    to.whole = lights_whole_pixels(panel);
    if (to.whole) return to;
    const std::vector<PanelPlane> all = planes(panel);
    for (const LitPart& from : bounded_parts(panel)) {
        if (to.count == max_subpixel_parts)
            throw InputError("panel.subpixel", "comes to more than the " + std::to_string(max_subpixel_parts) + " parts allowed");
        optics::SubpixelPart<S>& part = to.part[to.count++];
        part.channel = from.channel;
        part.plane = std::int32_t(std::ranges::find(all, from.plane) - all.begin());
        part.share = S(from.share);
        for (std::size_t k = 0; k < 2; ++k) {
            const double cell = from.plane.cell[k];
            part.cell[k] = from.plane.cell[k];
            part.per_cell[k] = S(1 / cell);
            part.pixel[k] = from.plane.pixel[k];
            part.from[k] = S(from.from[k] / cell);
            part.to[k] = S(from.to[k] / cell);
            part.per[k] = S(cell / (from.to[k] - from.from[k]));
        }
    }
    return to;
}

}  // namespace

template <class S>
StoredDisplay<S> make_traced_display(const Display& display, const Geometry& geometry) {
    StoredDisplay<S> scene{};
    const LensArray& array = display.array;
    scene.columns = std::uint32_t(display.panel.pixels[0]);
    scene.rows = std::uint32_t(display.panel.pixels[1]);
    scene.pixels_per_mm = S(1 / display.panel.pixel_pitch_mm);
    scene.emission_exponent = S(display.panel.emission_exponent);
    scene.emission = make_emission<S>(display.panel);

    scene.aperture = array.aperture;
    scene.aperture_radius = S(geometry.glass_radius_mm);
    scene.has_stop = display.lens.stop_radius_mm.has_value();
    const double stop = display.lens.stop_radius_mm.value_or(0);
    scene.stop_z = S(geometry.stop_z_mm);
    scene.stop_radius2 = S(stop * stop);
    add_lens(scene, geometry);
    add_layers(scene, geometry);

    scene.surround = array.surround;
    scene.lattice = rounded<S>(geometry.lattice);
    for (int k = 0; k < 2; ++k) scene.pitch_pixels[k] = S(geometry.lattice.pitch[k] / display.panel.pixel_pitch_mm);
    scene.rotated = geometry.turn_deg != 0;

    scene.fresnel = display.render.fresnel;
    scene.has_diffuser = display.diffuser.has_value();
    const double first = geometry.entrance_z_mm;
    if (display.diffuser) {
        scene.diffuser_profile = display.diffuser->profile;
        scene.start_above = S(*geometry.diffuser_z_mm - first);
        scene.small_angles = scene.diffuser_profile == Profile::box;
        for (int axis = 0; axis < 2; ++axis) {
            const ProfileFigures& figures = figures_of(scene.diffuser_profile);
            const double angle_deg = display.diffuser->angle_deg[axis], scale = figures.scale * angle_deg * degree;
            scene.angle_scale[axis] = S(scale);
            scene.within_horizon[axis] = S(angle_deg > 0 ? 2 * figures.below(89 / angle_deg) - 1 : 1);
            scene.small_angles = scene.small_angles && scale <= 0.05;
        }
    }
    add_holes(scene, display, geometry, geometry.diffuser_z_mm.value_or(first));
    scene.box_filter = display.camera.pixel_filter == PixelFilter::box;
    scene.thin_lens = display.camera.pupil_diameter_mm.value_or(0) > 0;
    place_lenses(display, geometry, scene);
    return scene;
}

template StoredDisplay<float> make_traced_display<float>(const Display&, const Geometry&);
template StoredDisplay<double> make_traced_display<double>(const Display&, const Geometry&);

optics::RayOrigin make_ray_origin(const Display& display, const Geometry& geometry) {
    optics::RayOrigin view{};
    const Camera& camera = display.camera;
    const CameraAxes axes = camera_axes(camera);
    std::ranges::copy(camera.position_mm, view.position);
    std::ranges::copy(axes.forward, view.forward);
    std::ranges::copy(axes.right, view.right);
    std::ranges::copy(axes.up, view.up);
    view.distance = axes.distance_mm;
    view.width = std::int32_t(camera.resolution[0]);
    view.height = std::int32_t(camera.resolution[1]);
    view.pixel_mm = geometry.frame_width_mm / double(camera.resolution[0]);
    view.pupil_radius = camera.pupil_diameter_mm.value_or(0) / 2;
    view.frame_per_focus = view.distance / geometry.focus_distance_mm;
    view.start_z = geometry.diffuser_z_mm.value_or(geometry.entrance_z_mm);
    view.lattice = geometry.lattice;
    view.wedged = is_wedged(display.errors);
    wedge_of(display.errors, geometry, view.wedge);
    view.panel_width = geometry.panel_width_mm;
    view.panel_height = geometry.panel_height_mm;
    view.pixels_per_mm = 1 / display.panel.pixel_pitch_mm;
    view.seed = std::uint64_t(display.render.seed);
    return view;
}

Estimator estimator_of(const Display& display) {
    const bool spreads = display.diffuser || display.camera.pixel_filter == PixelFilter::box;
    return spreads ? display.render.estimator : Estimator::point;
}

Display by_points(const Display& display) {
    Display of = display;
    if (estimator_of(of) != Estimator::point) of.render.samples = of.render.samples.value_or(points_on_gpu);
    of.render.estimator = Estimator::point;
    return of;
}

std::int64_t samples_of(const Display& display) {
    if (sample_dimensions(display) == 0) return 1;
    if (estimator_of(display) == Estimator::point) return display.render.samples.value_or(default_points);
    const double strata = std::ceil(std::sqrt(double(display.render.samples.value_or(4))));
    return std::int64_t(strata) * std::int64_t(strata);
}

int sample_dimensions(const Display& display) {
    if (display.camera.pupil_diameter_mm.value_or(0) > 0) return 6;
    if (display.camera.pixel_filter == PixelFilter::box) return 4;
    return display.diffuser ? 2 : 0;
}

namespace {

/// The width of the picture's pixels, projected along the line of sight onto the diffuser's plane; mm.
double pixel_on_diffuser(const optics::RayOrigin& view) {
    return view.pixel_mm * std::abs((view.position[2] - view.start_z) / (view.forward[2] * view.distance));
}

/// The width that a diffused ray spans along an axis in the plane of the holes; mm.
double diffused_span(const optics::TracedDisplay<float>& scene, int axis) {
    return 2 * double(scene.holes_below[axis]) * std::tan(std::min(double(scene.angle_scale[axis]), 1.5));
}

}  // namespace

BlockShape block_shape(const optics::TracedDisplay<float>& scene, const optics::RayOrigin& view, int strata, bool rough) {
    using L = FilteredLimits;
    constexpr BlockShape none{false, 4};
    const Lattice<float>& lattice = scene.lattice;
    if (!scene.has_diffuser || scene.box_filter || scene.thin_lens || scene.misaligned.given || scene.rotated || lattice.strips ||
        lattice.staggered || lattice.hexagonal)
        return none;
    const double pixel = pixel_on_diffuser(view);
    double alike = std::min(lattice.pitch[0], lattice.pitch[1]);  // mm over which pixels of a block may see the same
    bool weak = true;
    for (int k = 0; k < 2; ++k) {
        const double span = diffused_span(scene, k);
        if (!(span > L::least_span * pixel)) return none;
        weak = weak && span < L::weak_span * pixel && span < L::weak * double(lattice.pitch[k]);
        alike = std::min(alike, span);
    }
    // How far, in panel pixels, a ray through one point of a lens moves from one pixel of the picture to the next.
    const double below = double(scene.holes_below[0]), leap = pixel / below * (view.start_z - below) * view.pixels_per_mm;
    if (weak || leap > L::leaping) return none;
    // Many strata ask for a fine picture, in which nonlinear motion over a block would show.
    const double wide = strata > 2 * few_strata ? L::block_finest
                        : strata > few_strata   ? L::block_fine
                        : rough                 ? L::block_rough
                                                : L::block_usual;
    const double half_as_wide = std::min(2 * wide, rough ? L::half_block_rough : L::half_block_usual);
    const int side = 16 * pixel < wide * alike ? 16 : 8 * pixel < half_as_wide * alike ? 8 : 4;
    return {side > 4 || strata <= few_strata, side};
}

bool cuts_pixel(const optics::TracedDisplay<float>& scene, const optics::RayOrigin& view) {
    return scene.box_filter && std::max(diffused_span(scene, 0), diffused_span(scene, 1)) < pixel_on_diffuser(view);
}

const optics::DirectionNumbers& sobol_directions() {
    static constexpr optics::DirectionNumbers directions = optics::sobol_directions();
    return directions;
}

}  // namespace lfdsim
