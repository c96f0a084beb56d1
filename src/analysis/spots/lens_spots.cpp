// Spots and distortion of one lens. docs/measures.md, "Spots of one lens".

#include "analysis/spots/lens_spots.h"

#include "base/constants.h"
#include "base/on_threads.h"
#include "geometry/lens_misalignment.h"
#include "geometry/pupil.h"
#include "geometry/resolve.h"
#include "optics/lattice.h"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>
#include <utility>

namespace lfdsim {
namespace {

constexpr int bundle_rays = 256, pixel_rays = 64, fan_rays = 1001, most_places = 96;  // bundle_rays and pixel_rays: across a bundle

/// Returns a size at depth z, or 0 if it is within the rounding of double precision.
double without_rounding(double mm, double z) { return mm < 1e-9 + 1e-14 * std::abs(z) ? 0 : mm; }

}  // namespace

std::vector<LensField> trace_fields(const Subject& s, const LensTrace& lens) {
    const Lattice<double>& l = s.geometry().lattice;
    const double edge = l.half_pitch[0], corner = optics::corners_of_cell(l).y[1];
    std::vector<LensField> fields{{"axis", "on the axis", {0, 0}, {}, {}},
                                  {"half", "half way to the edge", {edge / 2, 0}, {}, {}},
                                  {"edge", "edge of the field", {edge, 0}, {}, {}}};
    if (!l.strips) fields.push_back({"corner", "corner", {edge, corner}, {}, {}});
    for (LensField& f : fields) {
        f.light = bundle(lens, f.panel, bundle_rays);
        f.rims = fans(lens, f.panel, fan_rays);
    }
    return fields;
}

Spot spot_at(const Subject& s, const LensField& f, double z) {
    if (f.light.rays.empty() || f.rims.meridional.empty()) return {nan, nan, nan, nan, nan};
    Spot spot{without_rounding(centroid_at(f.light, z).rms, z), without_rounding(width_at(f.rims.meridional, z).mm, z),
              is_strips(s.display().array) ? nan : without_rounding(width_at(f.rims.sagittal, z).mm, z), nan, nan};
    if (!s.display().diffuser) return spot;
    const double z_diffuser = *s.geometry().diffuser_z_mm - s.geometry().rear_principal_mm,
                 height = std::hypot(f.panel[0], f.panel[1]);
    const Point u = height > 0 ? Point{f.panel[0] / height, f.panel[1] / height} : Point{1, 0}, v{-u[1], u[0]};
    spot.meridional_diffused =
        without_rounding(width_at(diffused(f.rims.meridional, z_diffuser, diffuser_angle(s.display(), s.geometry(), u)), z).mm, z);
    if (is_strips(s.display().array)) return spot;
    spot.sagittal_diffused =
        without_rounding(width_at(diffused(f.rims.sagittal, z_diffuser, diffuser_angle(s.display(), s.geometry(), v)), z).mm, z);
    return spot;
}

std::vector<double> spot_depths_mm(const Theory& t) {
    // depth_of_field_mm is the published one, symmetric about L.
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
        step[k] = views > most_places ? lens_pitch_mm(g, k) / places[k] : display.panel.pixel_pitch_mm;
    }
    const auto [columns, rows] = places;
    const double L = t.central_depth_mm, gap = g.gap_mm;
    // Returns the distance for the panel point, in pixel images; NaN if it is outside the cell or dark.
    const auto miss = [&](Point panel) {
        if (!optics::in_cell(lattice, panel[0], panel[1], 1e-9 * lattice.pitch[0])) return nan;
        const Bundle light = bundle(lens, panel, pixel_rays);
        if (light.rays.empty()) return nan;
        // At L a ray is at x + m L, and the nodal line, of slope -P/g through H', at -P L/g. Both are divided by L, so that L may
        // be infinite; a pixel's image is then a/g wide.
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
    // A quarter of the pixels is traced: the others are its mirror images.
    on_threads(threads, [&] {
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

void note_left_out_errors(const Subject& s, Result& result) {
    const Errors& e = s.display().errors;
    std::string keys;
    for (const auto& [key, given] : std::initializer_list<std::pair<const char*, bool>>{{"wedge_deg", is_wedged(e)},
                                                                                        {"bow_mm", e.bow_mm != 0},
                                                                                        {"height_sd_mm", e.height_sd_mm != 0},
                                                                                        {"tilt_sd_deg", e.tilt_sd_deg != 0},
                                                                                        {"curvature_sd", e.curvature_sd != 0},
                                                                                        {"table", e.given != nullptr}})
        if (given) keys += fmt::format("{}errors.{}", keys.empty() ? "" : ", ", key);
    if (keys.empty()) return;
    const std::string note = fmt::format("of one perfect lens, parallel to the panel: {} left out", keys);
    for (const auto& [name, figure] : result.figures.items())
        if (!name.ends_with("_error") && !result.notes.contains(name)) result.note(name, note);
    result.remarks.push_back(fmt::format(
        "Spots, and depths of field by their width, are those of one perfect lens, parallel to the panel. Left out: {}.", keys));
}

}  // namespace lfdsim
