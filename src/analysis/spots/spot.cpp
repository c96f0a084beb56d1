#include "analysis/spots/spot.h"

#include "analysis/spots/spot_colour.h"

#include "base/constants.h"
#include "checks/depth_words.h"
#include "geometry/pupil.h"
#include "optics/lattice.h"

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <algorithm>
#include <cmath>

// docs/model.md, "Spots of one lens".
namespace lfdsim {
namespace {

constexpr int bundle_rays = 256, pixel_rays = 64, shown_rays = 22, fan_rays = 1001, focus_steps = 121, most_places = 96;

/// A point of the panel under the lens, and its light.
struct Field {
    const char *name, *title;
    Point panel;
    Bundle light;
    Fans rims;
};

std::vector<Field> trace_fields(const Subject& s, const LensTrace& lens) {
    const LensArray& array = s.display().array;
    const double edge = array.pitch_mm[0] / 2,
                 corner = array.lattice == LatticeKind::hexagon ? edge / std::sqrt(3) : array.pitch_mm[1] / 2;
    std::vector<Field> fields{{"axis", "on the axis", {0, 0}, {}, {}},
                              {"half", "half way to the edge", {edge / 2, 0}, {}, {}},
                              {"edge", "edge of the field", {edge, 0}, {}, {}}};
    if (!is_strips(array)) fields.push_back({"corner", "corner", {edge, corner}, {}, {}});
    for (Field& f : fields) {
        f.light = bundle(lens, f.panel, bundle_rays);
        f.rims = fans(lens, f.panel, fan_rays);
    }
    return fields;
}

struct Spot {
    double rms, meridional, sagittal, meridional_diffused, sagittal_diffused;
};

/// A size at depth z within double precision: rays that meet in one point leave some 1e-14 mm.
double told(double mm, double z) { return mm < 1e-9 + 1e-14 * std::abs(z) ? 0 : mm; }

Spot spot_at(const Subject& s, const Field& f, double z) {
    if (f.light.rays.empty() || f.rims.meridional.empty()) return {nan, nan, nan, nan, nan};
    Spot spot{told(centroid_at(f.light, z).rms, z), told(width_at(f.rims.meridional, z).mm, z),
              is_strips(s.display().array) ? nan : told(width_at(f.rims.sagittal, z).mm, z), nan, nan};
    if (!s.display().diffuser) return spot;
    const double z_diffuser = *s.geometry().diffuser_z_mm - s.geometry().rear_principal_mm,
                 height = std::hypot(f.panel[0], f.panel[1]);
    const Point u = height > 0 ? Point{f.panel[0] / height, f.panel[1] / height} : Point{1, 0}, v{-u[1], u[0]};
    spot.meridional_diffused = told(width_at(diffused(f.rims.meridional, z_diffuser, diffuser_angle(s.display(), u)), z).mm, z);
    if (is_strips(s.display().array)) return spot;
    spot.sagittal_diffused = told(width_at(diffused(f.rims.sagittal, z_diffuser, diffuser_angle(s.display(), v)), z).mm, z);
    return spot;
}

/// The table of all spots, as CSV and JSON.
void tell_spots(const Subject& s, const std::vector<Field>& fields, const std::vector<double>& depths, double from_vertex,
                Result& result) {
    DataTable table{"spot", {}};
    Json& spots = result.figures["spots"] = Json::array();
    for (const Field& f : fields) {
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

/// The spots of a field at the first, middle and last depth, side by side at one scale, each about its centroid, and the outline of
/// a panel pixel's image: the spot size that theory allows.
Plot diagram(const Subject& s, const LensTrace& lens, const Field& field, const std::vector<double>& depths, double from_vertex) {
    const Bundle light = bundle(lens, field.panel, shown_rays);
    Plot plot{fmt::format("spot_{}", field.name),
              fmt::format("Spots of one lens, {}", field.title),
              "mm; the depths side by side",
              "mm",
              {},
              {},
              true};
    Series outline{"image of a panel pixel", {}, {}};
    const double pixel_slope = s.display().panel.pixel_pitch_mm / s.geometry().gap_mm;
    double x0 = 0;
    for (const double z : {depths.front(), depths[depths.size() / 2], depths.back()}) {
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

/// Radius and width against depth.
void tell_focus(const Subject& s, const std::vector<Field>& fields, const std::vector<double>& depths, double from_vertex,
                Result& result) {
    std::vector<double> places;
    for (int k = 0; k < focus_steps; ++k)
        places.push_back(depths.front() + (depths.back() - depths.front()) * k / (focus_steps - 1));
    std::vector<double> at;
    for (const double z : places) at.push_back(z + from_vertex);
    Curves rms("spot_through_focus", "Spot size through focus", "depth in front of the lenses, mm", "RMS radius, mm",
               {"depth_mm", at});
    Plot width{"spot_width", "Width of the spot on the axis", "depth in front of the lenses, mm", "full width, mm", {}};
    std::vector<double> theory;
    const double L = s.theory().central_depth_mm, D = light_width_mm(s.display(), s.geometry())[0];
    for (const double z : places) theory.push_back(D * std::abs(std::isinf(L) ? 1 : z / L - 1));
    width.series.push_back({"paraxial", at, theory});
    for (const Field& f : fields) {
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
        const Pitch& p = s.display().array.pitch_mm;
        result.maps.push_back({"spot_distortion", "Distortion of the elemental image", "x on the panel from the lens's axis, mm",
                               "y on the panel, mm", "distance from the nodal line, images of a panel pixel", -p[0] / 2, p[0] / 2,
                               -p[1] / 2, p[1] / 2, d.columns, d.rows, d.pixel_images, 0, std::max(most, 1e-3)});
    }
    result.add_line(most,
                    {.label = "Distortion of the elemental image: largest",
                     .unit = "pixel images",
                     .theory = 0.,
                     .remark = "how far a panel pixel's light lands from where the elemental images place it; theory has none"});
    result.add_line(rms, {.label = "Distortion of the elemental image: RMS", .unit = "pixel images", .theory = 0.});
}

}  // namespace

std::vector<double> spot_depths_mm(const Theory& t) {
    const double L = t.central_depth_mm, near = depth_mm(t.depth_near_per_mm);
    if (std::isinf(L)) return {near, 1.5 * near, 2 * near, 3 * near, 4 * near};
    const double half = std::min(0.5 * t.depth_of_field_mm, 0.9 * std::abs(L));
    return {L - half, L - half / 2, L, L + half / 2, L + half};
}

Centroid centroid_at(const Bundle& light, double z) {
    const double n = double(light.rays.size());
    double x = 0, y = 0, sum = 0;
    for (const LensRay& r : light.rays) {
        x += r.x + r.mx * z;
        y += r.y + r.my * z;
    }
    x /= n;
    y /= n;
    for (const LensRay& r : light.rays) {
        const double dx = r.x + r.mx * z - x, dy = r.y + r.my * z - y;
        sum += dx * dx + dy * dy;
    }
    return {x, y, std::sqrt(sum / n)};
}

Distortion distortion(const Display& display, const Geometry& g, const Theory& t, int threads, const Job& job) {
    const LensTrace lens(display, g);
    std::array<int, 2> places;
    std::array<double, 2> step;
    const Lattice<double>& lattice = g.lattice;
    for (const std::size_t k : {0u, 1u}) {
        const double views = k == 1 && lattice.strips ? 1 : t.along[k].views;
        places[k] = int(std::clamp(std::round(views), 1., double(most_places)));
        step[k] = views > most_places ? display.array.pitch_mm[k] / places[k] : display.panel.pixel_pitch_mm;
    }
    const auto [columns, rows] = places;
    const double L = t.central_depth_mm, gap = g.gap_mm;
    const auto miss = [&](Point panel) {
        if (!optics::in_cell(lattice, panel[0], panel[1], 1e-9 * lattice.pitch[0])) return nan;
        const Bundle light = bundle(lens, panel, pixel_rays);
        if (light.rays.empty()) return nan;
        // Both lines as slopes from the axis's point at H', so that L may be infinite: at L a pixel's image is a |L| / g wide.
        double x = 0, y = 0;
        for (const LensRay& r : light.rays) {
            x += r.mx + r.x / L;
            y += r.my + r.y / L;
        }
        const double rays = double(light.rays.size());
        const double images = std::hypot(x / rays + panel[0] / gap, y / rays + panel[1] / gap) * gap / display.panel.pixel_pitch_mm;
        return images < 1e-9 ? 0 : images;  // within double precision
    };
    Distortion result{columns, rows, std::vector<double>(std::size_t(columns) * std::size_t(rows), nan)};
    const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism,
                                      std::size_t(std::max(threads, tbb::info::default_concurrency())));
    tbb::task_arena arena(threads > 0 ? threads : tbb::info::default_concurrency());
    arena.execute([&] {
        tbb::parallel_for(0, (places[1] + 1) / 2, [&](int j) {
            for (int i = 0; i < (places[0] + 1) / 2 && !job.cancelled(); ++i) {
                const double value = miss({(i + 0.5 - places[0] / 2.) * step[0], (places[1] / 2. - j - 0.5) * step[1]});
                for (const int row : {j, places[1] - 1 - j})
                    for (const int column : {i, places[0] - 1 - i})
                        result.pixel_images[std::size_t(row) * std::size_t(places[0]) + std::size_t(column)] = value;
            }
        });
    });
    if (job.cancelled()) throw Stopped{};
    return result;
}

std::int64_t spot_steps(const Subject&) { return 4; }

Result measure_spot(Subject& s, Job& job) {
    Result result;
    const LensTrace lens(s.display(), s.geometry());
    const double from_vertex = s.geometry().rear_principal_mm - s.geometry().vertex_plane_mm;
    const std::vector<double> depths = spot_depths_mm(s.theory());
    const std::vector<Field> fields = trace_fields(s, lens);
    if (job.cancelled()) throw Stopped{};
    job.advance(1);
    result.add("central_depth_mm", s.theory().central_depth_mm + from_vertex);
    result.add("pixel_image_mm", s.theory().pixel_image_mm);
    tell_spots(s, fields, depths, from_vertex, result);
    for (const Field& f : fields) result.plots.push_back(diagram(s, lens, f, depths, from_vertex));
    std::vector<SpotField> coloured;
    for (const Field& f : fields) coloured.push_back({f.name, f.title, f.panel});
    tell_colours(s, coloured, result);
    tell_focus(s, fields, depths, from_vertex, result);
    if (job.cancelled()) throw Stopped{};
    job.advance(1);

    const double L = s.theory().central_depth_mm, D = light_width_mm(s.display(), s.geometry())[0];
    for (const std::size_t k : {std::size_t(0), depths.size() / 2, depths.size() - 1}) {
        const double z = depths[k];
        result.add_line(
            spot_at(s, fields.front(), z).meridional,
            {.label = fmt::format("Full width of the spot on the axis, {:.4g} mm in front of the lenses", z + from_vertex),
             .unit = "mm",
             .theory = D * std::abs(std::isinf(L) ? 1 : z / L - 1),
             .remark = "theory is paraxial: what differs is aberration"});
    }
    const double middle = depths[depths.size() / 2];
    for (const Field& f : fields)
        result.add_line(
            spot_at(s, f, middle).rms,
            {.label = fmt::format("RMS radius of the spot, {}, {:.4g} mm in front of the lenses", f.title, middle + from_vertex),
             .unit = "mm",
             .remark = is_strips(s.display().array)
                           ? "of the light of a Lambertian panel point in the plane across the strips, about its centroid"
                           : "of the light of a Lambertian panel point about its centroid"});
    tell_distortion(s, distortion(s.display(), s.geometry(), s.theory(), s.threads(), job), result);
    job.advance(2);
    if (fields.front().light.rays.empty())
        result.remarks.push_back("No light of the panel point on a lens's axis gets through it.");
    if (s.display().array.surround != Surround::opaque)
        result.remarks.push_back(
            "Spots are those of one lens by itself: light through walls and through other lenses is left out.");
    return result;
}

}  // namespace lfdsim
