// The measure of spots: its tables, diagrams and curves. docs/measures.md, "Spots of one lens".

#include "analysis/spots/spot.h"

#include "analysis/core/figure_json.h"
#include "analysis/spots/lens_spots.h"
#include "analysis/spots/spot_colour.h"
#include "base/constants.h"
#include "checks/depth_words.h"
#include "geometry/pupil.h"
#include "geometry/resolve.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <utility>

namespace lfdsim {
namespace {

constexpr int shown_rays = 22, focus_steps = 121;  // across a diagram's bundle; depths of the curves

/// Adds the sizes of all spots, as a table and for scripts. `depths` are from H', results from the vertex plane: `from_vertex` is
/// added.
void tell_spots(const Subject& s, const std::vector<LensField>& fields, const std::vector<double>& depths, double from_vertex,
                Result& result) {
    DataTable table{"spot", {}};
    Json& spots = result.figures["spots"] = Json::array();
    for (const LensField& f : fields) {
        const double angle = std::atan(std::hypot(f.panel[0], f.panel[1]) / s.geometry().gap_mm) / degree;
        const double share = fields.front().light.light > 0 ? f.light.light / fields.front().light.light : nan;
        for (const double z : depths) {
            const Spot spot = spot_at(s, f, z);
            const std::pair<const char*, double> row[] = {{"panel_x_mm", f.panel[0]},
                                                          {"panel_y_mm", f.panel[1]},
                                                          {"field_deg", angle},
                                                          {"through_share", share},
                                                          {"depth_mm", z + from_vertex},
                                                          {"rms_radius_mm", spot.rms},
                                                          {"meridional_width_mm", spot.meridional},
                                                          {"sagittal_width_mm", spot.sagittal},
                                                          {"meridional_with_diffuser_mm", spot.meridional_diffused},
                                                          {"sagittal_with_diffuser_mm", spot.sagittal_diffused}};
            Json json{{"field", f.name}};
            std::vector<double> values;
            for (const auto& [name, value] : row) {
                if (spots.empty()) table.columns.push_back({name, {}});
                values.push_back(value);
                json[name] = number_json(value);
            }
            table.add_row(values);
            if (std::isnan(spot.rms))
                result.note(fmt::format("spots.{}", spots.size()), "no light of this panel point gets through the lens");
            spots.push_back(std::move(json));
        }
    }
    if (!s.display().diffuser)
        for (const char* name : {"meridional_with_diffuser_mm", "sagittal_with_diffuser_mm"})
            result.note(fmt::format("spots.{}", name), "there is no diffuser");
    if (is_strips(s.display().array))
        for (const char* name : {"sagittal_width_mm", "sagittal_with_diffuser_mm"})
            result.note(fmt::format("spots.{}", name), "cylindrical lenses have line foci; widths and radii are across the strips");
    result.tables.push_back(std::move(table));
}

/// Returns a diagram of a field's spots at the first, middle and last depth, side by side at one scale, each about its centroid,
/// with the outline of a panel pixel's image, the spot size that theory allows.
Plot diagram(const Subject& s, const LensTrace& lens, const LensField& field, const std::vector<double>& depths,
             double from_vertex) {
    const Bundle light = bundle(lens, field.panel, shown_rays);
    Plot plot{fmt::format("spot_{}", field.name),
              fmt::format("Spots of one lens, {}", field.title),
              "mm; one depth beside the other",
              "mm",
              {},
              {},
              true};
    Series outline{"image of a panel pixel", {}, {}};
    const double pixel_slope = s.display().panel.pixel_pitch_mm / s.geometry().gap_mm;
    double x0 = 0;
    for (const double z : {depths.front(), depths[depths.size() / 2], depths.back()}) {
        // Each spot, or pixel image if that is wider, has its width and a tenth more.
        const Centroid middle = centroid_at(light, z);
        const double half = 0.5 * pixel_slope * std::abs(z);
        double left = half, right = half;
        for (const LensRay& ray : light.rays) {
            left = std::max(left, middle.x - ray.x - ray.mx * z);
            right = std::max(right, ray.x + ray.mx * z - middle.x);
        }
        x0 += 1.1 * left;
        Series spot{depth_in_words(z + from_vertex), {}, {}, true};
        for (const LensRay& ray : light.rays) {
            spot.x.push_back(x0 + ray.x + ray.mx * z - middle.x);
            spot.y.push_back(ray.y + ray.my * z - middle.y);
        }
        for (const Point& corner : {Point{-1, -1}, Point{1, -1}, Point{1, 1}, Point{-1, 1}, Point{-1, -1}, Point{nan, nan}}) {
            outline.x.push_back(x0 + half * corner[0]);
            outline.y.push_back(half * corner[1]);
        }
        plot.series.push_back(std::move(spot));
        x0 += 1.1 * right;
    }
    plot.series.push_back(std::move(outline));
    return plot;
}

/// Adds curves of RMS radius and full width over depth.
void tell_focus(const Subject& s, const std::vector<LensField>& fields, const std::vector<double>& depths, double from_vertex,
                Result& result) {
    std::vector<double> places;
    for (int k = 0; k < focus_steps; ++k)
        places.push_back(depths.front() + (depths.back() - depths.front()) * k / (focus_steps - 1));
    std::vector<double> at;
    for (const double z : places) at.push_back(z + from_vertex);
    Curves rms("spot_through_focus", "Spot size through focus", "depth in front of the lenses, mm", "RMS radius, mm",
               {"depth_mm", at});
    Plot width{"spot_width", "Width of the spot on the axis", "depth in front of the lenses, mm", "full width, mm", {}};
    // Paraxially a spot is D_L |1 - z/L| wide; for infinite L it has the width D_L at all depths.
    std::vector<double> theory;
    const double L = s.theory().central_depth_mm, D = light_width_mm(s.display(), s.geometry())[0];
    for (const double z : places) theory.push_back(D * std::abs(std::isinf(L) ? 1 : z / L - 1));
    width.series.push_back({"paraxial", at, theory});
    for (const LensField& f : fields) {
        std::vector<double> radius, full, diffused_width;
        for (const double z : places) {
            const Spot spot = spot_at(s, f, z);
            radius.push_back(spot.rms);
            full.push_back(spot.meridional);
            diffused_width.push_back(spot.meridional_diffused);
        }
        rms.add(f.title, fmt::format("{}_rms_radius_mm", f.name), std::move(radius));
        if (&f != &fields.front()) continue;
        width.series.push_back({"traced", at, full});
        if (s.display().diffuser) width.series.push_back({"with the diffuser", at, diffused_width});
        rms.table.columns.push_back({"axis_width_mm", full});
        rms.table.columns.push_back({"axis_width_with_diffuser_mm", diffused_width});
    }
    if (std::isfinite(L)) {
        for (Plot* plot : {&rms.plot, &width}) plot->marks.push_back({"central depth plane", L + from_vertex});
        width.marks.push_back({"image of a panel pixel", s.theory().pixel_image_mm, false});
    }
    result.add(std::move(rms));
    result.plots.push_back(std::move(width));
}

/// Adds largest and RMS distortion, and its map.
void tell_distortion(const Subject& s, const Distortion& d, Result& result) {
    double most = 0, sum = 0;
    int open = 0;
    for (const double x : d.pixel_images) {
        if (std::isnan(x)) continue;
        most = std::max(most, x);
        sum += x * x;
        ++open;
    }
    const double rms = open > 0 ? std::sqrt(sum / open) : nan, mm = s.theory().pixel_image_mm;
    if (open == 0) most = nan;
    const double in_mm = std::isfinite(mm) ? mm : nan;
    DataTable table{"spot_distortion", {}};
    const auto add = [&](const std::string& name, double value) {
        result.add("distortion." + name, value);
        table.columns.push_back({name, {value}});
    };
    add("max_pixel_images", most);
    add("rms_pixel_images", rms);
    add("max_mm", most * in_mm);
    add("rms_mm", rms * in_mm);
    add("lit_share", double(open) / double(d.pixel_images.size()));
    if (open == 0)
        result.note("distortion", "no light of any pixel of the elemental image gets through the lens");
    else if (!std::isfinite(mm))
        for (const char* name : {"max_mm", "rms_mm"})
            result.note(fmt::format("distortion.{}", name), "images of pixels are at infinity: see pixel_images");
    result.tables.push_back(std::move(table));
    if (open > 0) {
        const double p[] = {lens_pitch_mm(s.geometry(), 0), lens_pitch_mm(s.geometry(), 1)};
        result.maps.push_back({"spot_distortion", "Distortion of the elemental image", "x on the panel from the lens's axis, mm",
                               "y on the panel, mm", "distance from the nodal line, images of a panel pixel", -p[0] / 2, p[0] / 2,
                               -p[1] / 2, p[1] / 2, d.columns, d.rows, d.pixel_images, 0, std::max(most, 1e-3)});
    }
    result.add_line(most,
                    {.label = "Distortion of the elemental image: largest",
                     .unit = "pixel images",
                     .theory = 0.,
                     .remark = "distance of a panel pixel's light from where the elemental images place it; theory predicts none"});
    result.add_line(rms, {.label = "Distortion of the elemental image: RMS", .unit = "pixel images", .theory = 0.});
}

}  // namespace

std::int64_t spot_steps(const Subject&) { return 4; }

Result measure_spot(Subject& s, Job& job) {
    Result result;
    const LensTrace lens(s.display(), s.geometry());
    const double from_vertex = s.geometry().rear_principal_mm - s.geometry().vertex_plane_mm;
    const std::vector<double> depths = spot_depths_mm(s.theory());
    const std::vector<LensField> fields = trace_fields(s, lens);
    if (job.cancelled()) throw Stopped{};
    job.advance(1);
    result.add("central_depth_mm", s.theory().central_depth_mm + from_vertex);
    result.add("pixel_image_mm", s.theory().pixel_image_mm);
    tell_spots(s, fields, depths, from_vertex, result);
    for (const LensField& f : fields) result.plots.push_back(diagram(s, lens, f, depths, from_vertex));
    tell_colours(s, fields, result);
    tell_focus(s, fields, depths, from_vertex, result);
    if (job.cancelled()) throw Stopped{};
    job.advance(1);

    const double L = s.theory().central_depth_mm, D = light_width_mm(s.display(), s.geometry())[0];
    for (const std::size_t k : {std::size_t(0), depths.size() / 2, depths.size() - 1}) {
        const double z = depths[k];
        result.add_line(spot_at(s, fields.front(), z).meridional,
                        {.label = fmt::format("Full width of the spot on the axis, {}", depth_in_words(z + from_vertex)),
                         .unit = "mm",
                         .theory = D * std::abs(std::isinf(L) ? 1 : z / L - 1),
                         .remark = "theory is paraxial: the difference is aberration"});
    }
    const double middle = depths[depths.size() / 2];
    for (const LensField& f : fields)
        result.add_line(
            spot_at(s, f, middle).rms,
            {.label = fmt::format("RMS radius of the spot, {}, {}", f.title, depth_in_words(middle + from_vertex)),
             .unit = "mm",
             .remark = is_strips(s.display().array)
                           ? "of the light of a Lambertian panel point in the plane across the strips, about its centroid"
                           : "of the light of a Lambertian panel point about its centroid"});
    tell_distortion(s, distortion(s.display(), s.geometry(), s.theory(), s.threads(), job), result);
    job.advance(2);
    note_left_out_errors(s, result);
    if (fields.front().light.rays.empty())
        result.remarks.push_back("No light of the panel point on a lens's axis gets through it.");
    if (s.display().array.surround != Surround::opaque)
        result.remarks.push_back("Spots are those of one isolated lens: light through walls and through other lenses is left out.");
    return result;
}

}  // namespace lfdsim
