#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "display/colour.h"
#include "geometry/geometry.h"
#include "geometry/lens_misalignment.h"
#include "geometry/prescription.h"
#include "geometry/pupil.h"
#include "geometry/resolve.h"

namespace lfdsim {
namespace {

constexpr double glue_mm = 1e-6;  // a flat face this near to the layers, or to the panel, borders on them

/// Returns the reduced thickness of layers: the sum of thickness / index.
double reduced_mm(const std::vector<PlacedLayer>& layers) {
    double sum = 0;
    for (const PlacedLayer& layer : layers) sum += layer.thickness_mm / layer.index;
    return sum;
}

std::vector<PlacedLayer> placed_layers(const Panel& panel, double wavelength_nm) {
    std::vector<PlacedLayer> layers;
    for (const Layer& layer : panel.layers)
        layers.push_back({layer.thickness_mm, index_at(layer.index, layer.glass, wavelength_nm)});
    return layers;
}

/// Returns the reduced distance from the panel along a lens's axis to the vertex that an eye's rays meet first: the sum of
/// thickness / index over layers, air and glass.
double reduced_entrance_mm(const Geometry& g) {
    double sum = reduced_mm(g.layers), z = g.layers_top_mm, index = 1;
    for (const PlacedSurface& s : g.surfaces) {
        sum += (s.z_mm - z) / index;
        z = s.z_mm;
        index = s.index_above;
    }
    return sum;
}

/// Makes the lens's lowest face border on the top layer, or on the panel itself: in place of air its lower medium is that layer,
/// or, on the panel, the glass itself, so that it does not refract.
void glue(Geometry& g) {
    PlacedSurface& face = g.surfaces.front();
    face.index_below = g.layers.empty() ? face.index_above : g.layers.back().index;
}

/// Sets D for lenses of the lattice's pitch: cells grow with it, holes do not.
void clear_apertures(const LensArray& array, Geometry& g) {
    g.clear_aperture_mm.fill(2 * g.pupil.radius_mm);
    if (array.aperture != Aperture::cell) return;
    for (std::size_t k = 0; k < 2; ++k)
        g.clear_aperture_mm[k] = std::min(g.clear_aperture_mm[k], g.pupil.cells * lens_pitch_mm(g, k));
}

/// Places the lens along z, in green light: its surfaces and planes, from array.gap_mm or array.base_z_mm.
void place_lens(const Lens& lens, const LensArray& array, const Panel& panel, Geometry& g) {
    const double green_nm = panel.wavelengths_nm[green_channel];
    g.layers = placed_layers(panel, green_nm);
    for (const PlacedLayer& layer : g.layers) g.layers_top_mm += layer.thickness_mm;
    const double T = g.layers_top_mm, reduced_T = reduced_mm(g.layers);
    g.surfaces = prescription(lens, array, green_nm);
    const Cardinal paraxial = cardinal_points(g.surfaces);
    // Extents of the lens, from its first vertex
    double lowest = 0, highest = 0, vertex = 0, widest = 0;
    for (const PlacedSurface& s : g.surfaces) {
        const auto [low, high] = sag_range_mm(s);
        lowest = std::min(lowest, s.z_mm + low);
        highest = std::max(highest, s.z_mm + high);
        vertex = std::max(vertex, s.z_mm);
        widest = std::max(widest, s.semi_aperture_mm);
    }
    // z of the first vertex. A gap is reduced: the layers count as T/n, so the air between them and H is g less that.
    const double first =
        array.base_z_mm ? *array.base_z_mm - lowest : T + (array.gap_mm.value_or(0) - reduced_T) - paraxial.front_principal_mm;
    for (PlacedSurface& s : g.surfaces) s.z_mm += first;
    g.base_z_mm = array.base_z_mm ? *array.base_z_mm : first + lowest;
    g.top_z_mm = first + highest;
    g.vertex_plane_mm = first + vertex;
    g.entrance_z_mm = g.surfaces.back().z_mm;
    g.reduced_vertex_plane_mm = reduced_entrance_mm(g);
    g.front_principal_mm = first + paraxial.front_principal_mm;
    g.rear_principal_mm = first + paraxial.rear_principal_mm;
    g.focal_length_mm = paraxial.focal_length_mm;
    g.glass_radius_mm = widest;
    // the curved vertex is the first one only for a plano-convex lens that faces the panel
    const auto* ball = std::get_if<PlanoConvex>(&lens.kind);
    const bool first_curved = ball && ball->facing == Facing::panel;
    g.stop_z_mm = (first_curved ? g.surfaces.front() : g.surfaces.back()).z_mm;
    // To the last bit as given: g = f must stay exact. A flat face that is glued on has no power: g is the same without air.
    g.gap_mm = array.gap_mm.value_or(reduced_T + (g.front_principal_mm - T));
    const PlacedSurface& lowest_surface = g.surfaces.front();
    g.glued = lowest_surface.form != SurfaceForm::thin && is_plane(lowest_surface) && std::abs(g.base_z_mm - T) <= glue_mm &&
              std::abs(lowest_surface.z_mm - T) <= glue_mm;
    if (g.glued) glue(g);
    g.pupil = pupil(g.surfaces, lens.stop_radius_mm, g.stop_z_mm);
    clear_apertures(array, g);
}

/// Moves the array as a whole by its errors (docs/model.md, "Errors"). The diffuser, the content and the camera stay, so that
/// depths from the vertex plane change.
void misplace_array(const Display& d, Geometry& g) {
    const Errors& e = d.errors;
    if (e.gap_mm != 0) {
        for (PlacedSurface& s : g.surfaces) s.z_mm += e.gap_mm;
        for (double* z : {&g.base_z_mm, &g.top_z_mm, &g.entrance_z_mm, &g.vertex_plane_mm, &g.reduced_vertex_plane_mm,
                          &g.front_principal_mm, &g.rear_principal_mm, &g.gap_mm, &g.stop_z_mm})
            *z += e.gap_mm;
        if (g.pupil.inner_z) *g.pupil.inner_z += e.gap_mm;
        g.content_depth_mm -= e.gap_mm;
    }
    Lattice<double>& l = g.lattice;
    for (std::size_t k = 0; k < 2; ++k) l.offset[k] += e.shift_mm[k];
    if (e.rotation_deg != 0) {
        g.turn_deg += e.rotation_deg;
        l.cos_turn = std::cos(g.turn_deg * degree);
        l.sin_turn = std::sin(g.turn_deg * degree);
        if (l.strips) g.array_height_mm = l.pitch[1] = strip_length_mm(d.panel, g.turn_deg);
    }
    if (e.pitch_ppm == 0) return;
    const double scale = pitch_scale(e);
    for (std::size_t k = 0; k < (l.strips ? 1 : 2); ++k) {
        l.pitch[k] *= scale;
        l.per_pitch[k] = 1 / l.pitch[k];
        l.half_pitch[k] = l.pitch[k] / 2;
    }
    if (PlacedSurface& lens = g.surfaces.front(); d.array.aperture == Aperture::cell && lens.form == SurfaceForm::thin) {
        lens.semi_aperture_mm = g.glass_radius_mm =
            scale * lens.semi_aperture_mm;  // an ideal lens that fills its cell grows with it
        g.pupil = pupil(g.surfaces, d.lens.stop_radius_mm, g.stop_z_mm);
    }
    clear_apertures(d.array, g);
    g.array_width_mm *= scale;
    if (!l.strips) g.array_height_mm *= scale;
}

double distance_mm(const Vec3d& a, const Vec3d& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

}  // namespace

double middle_z_mm(const std::vector<SceneObject>& objects) {
    const auto [far, near] = std::minmax_element(objects.begin(), objects.end(), [](const SceneObject& a, const SceneObject& b) {
        return a.position_mm[2] < b.position_mm[2];
    });
    return 0.5 * (far->position_mm[2] + near->position_mm[2]);
}

Geometry resolve_unchecked(const Display& d) {
    Geometry g{};
    g.lattice = make_lattice(d.panel, d.array);
    g.turn_deg = d.array.turn_deg();
    place_lens(d.lens, d.array, d.panel, g);
    if (d.diffuser) g.diffuser_z_mm = g.vertex_plane_mm + d.diffuser->distance_mm;
    g.panel_width_mm = double(d.panel.pixels[0]) * d.panel.pixel_pitch_mm;
    g.panel_height_mm = double(d.panel.pixels[1]) * d.panel.pixel_pitch_mm;
    const auto [array_width, array_height] = array_size_mm(d.panel, d.array);
    g.array_width_mm = array_width;
    g.array_height_mm = array_height;

    const double target_mm = distance_mm(d.camera.position_mm, d.camera.target_mm);
    // the panel with a margin, also where it is narrower than the usual 16:9 frame
    g.frame_width_mm = 1.03 * std::max(g.panel_width_mm, g.panel_height_mm * 16 / 9);
    if (d.camera.frame_width_mm) g.frame_width_mm = *d.camera.frame_width_mm;
    if (d.camera.fov_deg) g.frame_width_mm = 2 * target_mm * std::tan(*d.camera.fov_deg * degree / 2);
    g.focus_distance_mm = d.camera.focus_distance_mm.value_or(target_mm);

    // By default content is on the central depth plane, in front of the lenses or (virtual) behind them. If the lenses nearly
    // collimate, that plane is too far away for any scene, and content is at the lenses.
    const double central = g.rear_principal_mm + theory(d, g).central_depth_mm - g.vertex_plane_mm;
    const double viewer = std::min(d.content.viewing_distance_mm, d.camera.position_mm[2]) - g.vertex_plane_mm;
    const double by_default = d.content.written_depth_mm.value_or(std::abs(central) <= viewer / 2 ? central : 0);
    g.content_depth_mm = d.content.depth_mm.value_or(by_default);
    g.content_height_mm = d.content.height_mm.value_or(g.panel_height_mm / 2);
    if (!d.content.objects.empty()) {  // these have positions and sizes of the description
        g.content_depth_mm = d.content.depth_mm.value_or(middle_z_mm(d.content.objects));
        g.content_height_mm = d.content.height_mm;
    }
    misplace_array(d, g);
    return g;
}

Geometry resolve(const Display& d) {
    if (std::vector<Problem> problems = validate(d); !problems.empty()) throw InputError(std::move(problems));
    return resolve_unchecked(d);
}

Geometry resolve(const Display& d, double wavelength_nm) {
    Geometry g = resolve(d);
    // Positions stay; what depends on an index is computed anew.
    const double reduced_T = reduced_mm(g.layers), front = g.front_principal_mm, first = g.surfaces.front().z_mm;
    const std::vector<PlacedSurface> lens = prescription(d.lens, d.array, wavelength_nm);
    for (std::size_t k = 0; k < lens.size(); ++k) {
        g.surfaces[k].index_below = lens[k].index_below;
        g.surfaces[k].index_above = lens[k].index_above;
    }
    g.layers = placed_layers(d.panel, wavelength_nm);
    if (g.glued) glue(g);
    g.reduced_vertex_plane_mm = reduced_entrance_mm(g);
    const Cardinal paraxial = cardinal_points(lens);
    g.front_principal_mm = first + paraxial.front_principal_mm;
    g.rear_principal_mm = first + paraxial.rear_principal_mm;
    g.focal_length_mm = paraxial.focal_length_mm;
    // The gap changes by the differences, so that it is the same to the last bit where no index does.
    g.gap_mm += (reduced_mm(g.layers) - reduced_T) + (g.front_principal_mm - front);
    return g;
}

Geometry meant_geometry(const Display& d, const Geometry& built) {
    return knows_no_errors(d) ? resolve_unchecked(without_errors(d)) : built;
}

bool stop_at_entrance(const Display& d, const Geometry& g) {
    return d.lens.stop_radius_mm && std::abs(g.stop_z_mm - g.entrance_z_mm) < 1e-9;
}

double lens_pitch_mm(const Geometry& g, std::size_t axis) {
    return g.lattice.pitch[g.lattice.hexagonal || g.lattice.strips ? 0 : axis];
}

double height_per_pitch(const Geometry& g) { return g.lattice.hexagonal ? 2 / std::sqrt(3) : 1; }

double outer_radius_mm(const Display& d, const Geometry& g) {
    return outer_radius_mm(d.array) * (g.lattice.pitch[0] / d.array.pitch_mm[0]);
}

double widest_aperture_mm(const Geometry& g) { return std::max(g.clear_aperture_mm[0], g.clear_aperture_mm[1]); }

double nearest_eye_mm(const Geometry& g) {
    return std::max({g.top_z_mm, g.vertex_plane_mm, g.rear_principal_mm, g.diffuser_z_mm.value_or(0)});
}

}  // namespace lfdsim
