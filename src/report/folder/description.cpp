#include "report/folder/description.h"

#include "analysis/core/figure_json.h"
#include "base/constants.h"
#include "display/keys.h"
#include "geometry/lattice.h"
#include "geometry/resolve.h"
#include "geometry/sharp_range.h"
#include "geometry/subpixels.h"

#include <fmt/format.h>
#include <cctype>
#include <cmath>
#include <sstream>

namespace lfdsim {
namespace {

// Each json_of() returns a value as JSON; absent ones are null.
template <class T>
Json json_of(const T& value) {
    if constexpr (has_words<T>)
        return std::string(word(value));
    else if constexpr (std::is_floating_point_v<T>)
        return number_json(value);
    else
        return value;
}
Json json_of(const Pitch& value) { return value.is_one() ? json_of(value[0]) : Json(value); }
Json json_of(const Glass& glass) {
    const std::vector<double>& c = glass.coefficients;
    if (!glass.name.empty()) return glass.name;
    if (glass.formula == Formula::nd_vd) return {{"nd", c[0]}, {"vd", c[1]}};
    return {{std::string(key_of(glass.formula)), c}};
}
template <class T>
Json json_of(const std::optional<T>& value) {
    return value ? json_of(*value) : Json();
}

/// Returns the angles that the screen subtends horizontally and vertically from the axis at the camera's distance, 2 atan(w / 2E):
/// w the smaller of the array's bounding box and the panel's side over 1 + g/E. NaN from inside the display.
std::vector<double> screen_field_deg(const Display& d, const Geometry& g) {
    const double eye = camera_distance_mm(d) - g.rear_principal_mm, c = std::abs(g.lattice.cos_turn),
                 s = std::abs(g.lattice.sin_turn);
    if (!(camera_distance_mm(d) > nearest_eye_mm(g))) return {nan, nan};
    const auto field = [&](double array_mm, double panel_mm) {
        return 2 * std::atan(std::min(array_mm, panel_mm / (1 + g.gap_mm / eye)) / (2 * eye)) / degree;
    };
    return {field(c * g.array_width_mm + s * g.array_height_mm, g.panel_width_mm),
            field(s * g.array_width_mm + c * g.array_height_mm, g.panel_height_mm)};
}

}  // namespace

std::vector<Setting> settings(const Display& display) {
    std::vector<Setting> all;
    visit_all(display, [&](const std::string& path, const KeyInfo& key, ConstValueRef value, ConstValueRef fresh) {
        const auto json = [](ConstValueRef ref) { return std::visit([](const auto* v) { return json_of(*v); }, ref); };
        const Json now = json(value);
        // A key's default is that of a fresh struct; required keys have none.
        all.push_back({std::string(table_of_path(path)), std::string(key.name), now, !key.required && now == json(fresh),
                       std::string(key.absent)});
    });
    return all;
}

std::vector<Figure> figures(const Display& d, const Geometry& g) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    std::vector<double> aperture(g.clear_aperture_mm.begin(), g.clear_aperture_mm.begin() + (differs_by_axis(d.array) ? 2 : 1));
    return {
        {"gap_mm", {g.gap_mm}, "g, panel to the front principal plane"},
        {"base_z_mm", {g.base_z_mm}, "lowest point of a lens"},
        {"front_principal_mm", {g.front_principal_mm}, "panel-side principal plane"},
        {"rear_principal_mm", {g.rear_principal_mm}, "viewer-side principal plane"},
        {"vertex_plane_mm", {g.vertex_plane_mm}, "viewer-side vertex plane: depths count from here"},
        {"top_z_mm", {g.top_z_mm}, "highest point of a lens"},
        {"stop_z_mm", {g.stop_z_mm}, "plane of the aperture stop, if there is one"},
        {"diffuser_z_mm", {g.diffuser_z_mm.value_or(none)}, "diffuser", "", "there is no diffuser"},
        {"glass_radius_mm", {g.glass_radius_mm}, "radius of a lens"},
        {"clear_aperture_mm", aperture, "D, clear aperture of a lens: its pupil as the viewer sees it"},
        {"panel_width_mm", {g.panel_width_mm}, "panel, width"},
        {"panel_height_mm", {g.panel_height_mm}, "panel, height"},
        {"array_width_mm", {g.array_width_mm}, "lens array, width"},
        {"array_height_mm", {g.array_height_mm}, "lens array, height"},
        {"screen_field_deg", screen_field_deg(d, g),
         "field of view of the screen from the camera's distance, horizontal and vertical",
         "2 atan(w / 2E), w the smaller of the array's width and the panel's over 1 + g/E",
         "the camera is inside the display or behind it"},
        {"frame_width_mm", {g.frame_width_mm}, "camera's frame in the plane through its target, width"},
        {"focus_distance_mm", {g.focus_distance_mm}, "camera's focus along the line of sight"},
        {"content_depth_mm",
         {g.content_depth_mm},
         "depth of the model's centre; of objects: midway between the nearest and the furthest"},
        {"content_height_mm", {g.content_height_mm.value_or(none)}, "height of the model", "", "each object has its own height"}};
}

namespace {

/// Returns the lateral shift of each channel at the viewing distance, mm, the largest of all pixels of a cell; none without
/// subpixels.
std::vector<double> colour_shifts_mm(const Display& d, const Geometry& g, const Theory& t) {
    if (d.panel.subpixels == SubpixelLayout::none) return {};
    const std::array<std::int64_t, 2> cell = subpixel_cell(d.panel).size;
    // p'/p - 1 = g/(D' - z_H'), p as built
    const double gap_per_distance = t.along[0].elemental_pitch_mm / g.lattice.pitch[0] - 1;
    std::vector<double> shifts;
    for (int channel = 0; channel < 3; ++channel) {
        double most = 0;
        for (std::int64_t row = 0; row < cell[1]; ++row)
            for (std::int64_t column = 0; column < cell[0]; ++column)
                if (const auto off = centroid(d.panel, channel, column, row))
                    most = std::max(most, std::hypot((*off)[0], (*off)[1]));
        const bool central = most < 1e-12;  // zero apart from rounding
        shifts.push_back(central ? 0 : most * d.panel.pixel_pitch_mm / gap_per_distance);
    }
    return shifts;
}

/// Returns the published depth of field, 2 |L| P_I / D; NaN where half of it is |L| or more, so that it would reach the lenses.
double published_depth_mm(const Theory& t) {
    return 0.5 * t.depth_of_field_mm < std::abs(t.central_depth_mm) ? t.depth_of_field_mm : nan;
}

/// Whether an eye far away sees no dark parts between the lenses: the pupil is the whole cell.
bool fills_cells(const Display& d, const Geometry& g) {
    return d.array.aperture == Aperture::cell && g.pupil.cells >= 1 - 1e-9 &&
           g.pupil.radius_mm >= outer_radius_mm(d, g) * (1 - 1e-9);
}

/// Returns the sharp depths, named as in `analyze dof`, and the resolution limits as the eye sees them.
std::vector<Figure> sharpness(const Display& d, const Geometry& g, const Theory& t) {
    constexpr const char* inside = "the camera is inside the display or behind it";
    const double eye = camera_distance_mm(d), z = g.content_depth_mm;
    const bool pinhole = d.lens.type() == LensType::pinhole, before = eye > nearest_eye_mm(g);
    const char* none = pinhole   ? "a pinhole has no image plane"
                       : !before ? inside
                                 : "no depth on this side of the lenses is sharp by theory";
    const auto ends = [&](const DepthSpan& span) { return before ? std::vector{span.low, span.high} : std::vector{nan, nan}; };
    constexpr auto interval = Figure::Presentation::interval;
    constexpr const char *lens = "a lens's spot D |1 - z/L| is no wider than the pitch p", *pixel = "|1/z - 1/L| <= a / (g D)";
    const SharpRange by_lens = sharp_by_lens(g, t, eye), by_pixel = sharp_by_pixel(g, t, eye);
    std::vector<double> at_lenses, at_content;  // along x', and along y' where that differs
    for (std::size_t axis = 0; axis < (differs_by_axis(d.array) ? 2 : 1); ++axis) {
        at_lenses.push_back(before ? cycles_per_degree(g, t.along[axis].lens_sampling_limit_per_mm, 0, eye) : nan);
        const double finest = std::min(lens_limit_per_mm(d, g, t, z, eye, axis), pixel_limit_per_mm(d, g, z));
        at_content.push_back(before && eye - g.vertex_plane_mm > z ? cycles_per_degree(g, finest, z, eye) : nan);
    }
    return {
        {"by_lens_behind_mm", ends(by_lens.behind), "depth of field by the lens, behind the lenses", lens, none, interval},
        {"by_lens_in_front_mm", ends(by_lens.in_front), "depth of field by the lens, in front of the lenses, to the viewer at most",
         lens, none, interval},
        {"by_pixel_behind_mm", ends(by_pixel.behind), "depth of field by the pixel, behind the lenses", pixel, none, interval},
        {"by_pixel_in_front_mm", ends(by_pixel.in_front),
         "depth of field by the pixel, in front of the lenses, to the viewer at most", pixel, none, interval},
        {"at_the_lenses_per_degree", at_lenses, "resolution limit at the lenses, as the eye sees it", "E / 2p per radian", inside},
        {"at_the_content_per_degree", at_content,
         "resolution limit of lenses and pixels at the content's depth, as the eye sees it",
         "the smaller of E / 2p and (E - z) g / (2 a |z|) per radian", "the camera is inside the display or behind the content"}};
}

}  // namespace

std::vector<Figure> figures(const Display& d, const Geometry& g, const Theory& t) {
    // Where the axes differ, a figure has two values.
    const bool by_axis = differs_by_axis(d.array);
    const auto along = [&](double AxisTheory::*figure) {
        const double x = t.along[0].*figure, y = t.along[1].*figure;
        return by_axis ? std::vector{x, y} : std::vector{x};
    };
    constexpr const char* inside = "the camera is inside the display or behind it";
    constexpr const char* pinhole = "a pinhole has no image plane";
    const bool pinhole_lens = d.lens.type() == LensType::pinhole;
    constexpr const char* no_gaps = "lenses that fill their cells have no gaps";
    const bool gaps = !fills_cells(d, g);
    const auto closing = [&](double AxisTheory::*figure) {
        return gaps ? along(figure) : std::vector<double>(along(figure).size(), nan);
    };
    const bool flat = line_of_eyes(g.lattice) == 1;  // strips' fields of view and views are counted along columns then
    std::vector<double> views_elemental = along(&AxisTheory::elemental_pitch_mm);
    for (double& views : views_elemental) views /= d.panel.pixel_pitch_mm * across_share(g.lattice);
    // Fields of view, lengths of a lens, and depth of field.
    std::vector<Figure> all = {
        {"fov_deg", along(&AxisTheory::fov_deg), "field of view of one lens, in which an eye may move", "2 atan(p / 2g)"},
        {"fov_exact_deg", along(&AxisTheory::fov_exact_deg),
         "field of view of one lens through the layers on the panel, not paraxial",
         "Snell's law, from p'/2 on the panel to the axis at the lens", "a glass lens has aberrations; analyze fov includes them"},
        {"fov_horizontal_deg",
         {flat ? nan : t.fov_of_eyes_deg},
         "field of view of strips along the panel's rows",
         "2 atan(p / (2 g cos(slant)))",
         is_strips(d.array) ? same_from_both_sides(g.lattice) : "only strips have a slant"},
        {"fov_elemental_deg", along(&AxisTheory::fov_elemental_deg),
         g.lattice.strips ? "field of view of whole elemental images across the strips (along a row: lfdsim new --fov-deg)"
                          : "field of view of whole elemental images, as lfdsim new --fov-deg",
         "2 atan(p' / 2g)"},
        {"focal_length_mm", {t.focal_length_mm}, "f, focal length of a lens", "paraxial, of the lens's surfaces in air", pinhole},
        {"gap_mm", {t.gap_mm}, "g, gap", "panel to the front principal plane, layers by thickness / index"},
        {"central_depth_mm",
         {t.central_depth_mm},
         "L, central depth plane, from the rear principal plane",
         "1/L = 1/f - 1/g",
         pinhole},
        {"pixel_image_mm", {t.pixel_image_mm}, "P_I, image of a panel pixel on the central depth plane", "a |L| / g", pinhole},
        {"depth_of_field_mm",
         {published_depth_mm(t)},
         "depth of field, as published",
         "2 |L| P_I / D, for ranges less deep than |L|",
         pinhole_lens ? pinhole : "the published formula holds for a range about L that does not reach the lenses"},
        {"depth_near_mm", {depth_mm(t.depth_near_per_mm)}, "", "1 / (1/L + a / (g D))", pinhole, Figure::Presentation::for_scripts},
        {"depth_far_mm", {depth_mm(t.depth_far_per_mm)}, "", "1 / (1/L - a / (g D))", pinhole, Figure::Presentation::for_scripts},
        {"depth_near_diopters",
         {1000 * t.depth_near_per_mm},
         "depth of field by the pixel, nearest 1/z",
         "1/L + a / (g D)",
         pinhole},
        {"depth_far_diopters",
         {1000 * t.depth_far_per_mm},
         "depth of field by the pixel, farthest 1/z",
         "1/L - a / (g D)",
         pinhole}};
    for (Figure& f : sharpness(d, g, t)) all.push_back(std::move(f));
    // Views, viewing zones, resolution, and gaps between lenses.
    const std::vector<Figure> rest{
        {"views", along(&AxisTheory::views), "N, views across",
         flat ? "p / (a |sin(slant)|), along a column" : "p / a; for strips, along a row, p / (a cos(slant))"},
        {"views_elemental", views_elemental, "views of whole elemental images: panel pixels across each",
         flat ? "p' / (a |sin(slant)|), along a column" : "p' / a; for strips, along a row, p' / (a cos(slant))"},
        {"view_step_deg", along(&AxisTheory::view_step_deg), "angle from view to view",
         flat ? "field of view / N, both along a column" : "field of view / N, of strips both along a row"},
        {"viewing_zone_parallel_deg", along(&AxisTheory::viewing_zone_parallel_deg),
         "angle within which the whole screen is seen, with elemental images at lens pitch",
         "2 atan(p / 2g - (m - 1) p / 2E), m lenses across, the eye at E", inside},
        {"viewing_zone_deg", along(&AxisTheory::viewing_zone_deg),
         "angle within which the whole screen is seen from the camera's distance",
         "2 atan(p' / 2g - (m - 1) p/2 |1/E - 1/D'|), made for D'", inside},
        {"eyebox_mm", along(&AxisTheory::eyebox_mm), "width of one lens's viewing zone at the camera's distance", "E p' / g",
         inside},
        {"elemental_pitch_mm", along(&AxisTheory::elemental_pitch_mm), "p', pitch of the elemental images for the viewing distance",
         "p (1 + g / D')"},
        {"lens_sampling_limit_per_mm", along(&AxisTheory::lens_sampling_limit_per_mm), "resolution limit of the lens pitch",
         "1 / 2p"},
        {"pixel_image_limit_per_mm", {t.pixel_image_limit_per_mm}, "resolution limit of the panel pixels", "1 / 2 P_I", pinhole},
        {"gap_closing_diffuser_deg", closing(&AxisTheory::gap_closing_diffuser_deg),
         "angle of a diffuser at L that closes the gaps between lenses", "2 atan(p / 2 |L|)", gaps ? pinhole : no_gaps},
        {"gap_closing_here_deg", closing(&AxisTheory::gap_closing_here_deg),
         "angle that closes the gaps at the diffuser's distance", "2 atan(p / 2d), d its height above the lenses' rims",
         gaps ? "there is no diffuser" : no_gaps}};
    all.insert(all.end(), rest.begin(), rest.end());
    if (const std::vector<double> shifts = colour_shifts_mm(d, g, t); !shifts.empty())
        all.push_back({"subpixel_shift_mm", shifts,
                       "lateral shift of red, green and blue at the viewing distance, for content made for whole pixels",
                       "distance of the subpixels from the pixel's centre x (D - z_H') / g"});
    return all;
}

Json to_json(const std::vector<Setting>& all) {
    Json display = Json::object();
    for (const Setting& s : all) {
        // Down a path such as "lens.surface.0": tables by name, elements of lists by number.
        Json* table = &display;
        std::istringstream path(s.table);
        for (std::string part; std::getline(path, part, '.');)
            table = std::isdigit(static_cast<unsigned char>(part[0])) ? &(*table)[std::stoul(part)] : &(*table)[part];
        (*table)[s.key] = s.value;
    }
    return display;
}

/// Returns the name of a figure along the array's y: "fov_y_deg" for "fov_deg".
std::string name_along_y(std::string name) {
    for (const std::string_view unit : {"_per_mm", "_mm", "_nm", "_deg"})
        if (name.ends_with(unit)) return name.insert(name.size() - unit.size(), "_y");
    return name + "_y";
}

Json to_json(const std::vector<Figure>& all) {
    Json json = Json::object();
    for (const Figure& f : all) {
        const bool of_channels = f.values.size() == 3;
        if (f.kind == Figure::Presentation::interval) {
            json[f.name] = std::isnan(f.values[0]) ? Json() : numbers_json(f.values);
            continue;
        }
        json[f.name] = of_channels ? numbers_json(f.values) : number_json(f.values[0]);
        if (f.values.size() == 2) json[name_along_y(f.name)] = number_json(f.values[1]);
    }
    return json;
}

void add_notes(const std::vector<Figure>& all, const std::string& part, Json& notes) {
    for (const Figure& f : all)
        for (std::size_t k = 0; k < (f.kind == Figure::Presentation::interval ? 1 : f.values.size()); ++k)
            if (std::isnan(f.values[k])) notes[part + "." + (k == 0 ? f.name : name_along_y(f.name))] = f.undefined;
}

std::string unit_of(const std::string& name) {
    if (name.ends_with("_per_mm")) return "1/mm";
    if (name.ends_with("_per_degree")) return "cycles/degree";
    if (name.ends_with("_mm")) return "mm";
    if (name.ends_with("_nm")) return "nm";
    if (name.ends_with("_deg")) return "degrees";
    if (name.ends_with("_diopters")) return "1/m";
    return "";
}

}  // namespace lfdsim
