// Axial and lateral colour of one lens. docs/measures.md, "Colour of one lens".

#include "analysis/spots/spot_colour.h"

#include "analysis/core/estimate.h"
#include "analysis/core/figure_json.h"
#include "base/constants.h"
#include "checks/depth_words.h"
#include "display/colour.h"

#include <fmt/format.h>
#include <array>
#include <cmath>

namespace lfdsim {
namespace {

/// Rays across each grid. The grids meet the rims at different points, so that their centroids' scatter shows the error.
constexpr std::array colour_rays{193, 181, 173, 163};
constexpr int drawn_rays = 14;
constexpr const char* channel_names[] = {"r", "g", "b"};

/// A lens at a channel's wavelength, with depths from green's H'.
struct Coloured {
    Geometry geometry;
    LensTrace lens;
    double lower;  // height of green's H' over the channel's, mm

    Coloured(const Subject& s, std::size_t channel)
        : geometry(resolve(s.display(), s.display().panel.wavelengths_nm[channel])),
          lens(s.display(), geometry),
          lower(s.geometry().rear_principal_mm - geometry.rear_principal_mm) {}

    /// Returns the rays of a panel point, with depths from green's H'.
    Bundle light(Point panel, int across) const {
        Bundle found = bundle(lens, panel, across);
        for (LensRay& ray : found.rays) {
            ray.x += ray.mx * lower;
            ray.y += ray.my * lower;
        }
        return found;
    }
};

/// Returns L of a colour, mm from green's H'.
double central_depth_mm(const Subject& s, const Coloured& c) { return theory(s.display(), c.geometry).central_depth_mm - c.lower; }

/// Returns a diagram of a field's spots in all colours at a depth, mm from green's H'.
Plot colour_diagram(const LensField& field, const std::array<Bundle, 3>& light, double depth, double from_vertex) {
    Plot plot{fmt::format("spot_colour_{}", field.name),
              fmt::format("Colours of the spot, {}, {}", field.title, depth_in_words(depth + from_vertex)),
              "mm",
              "mm",
              {},
              {},
              true};
    for (std::size_t c = 0; c < 3; ++c) {
        Series spot{colour_of_channel[c], {}, {}, true, c};
        for (const LensRay& ray : light[c].rays) {
            spot.x.push_back(ray.x + ray.mx * depth);
            spot.y.push_back(ray.y + ray.my * depth);
        }
        plot.series.push_back(std::move(spot));
    }
    return plot;
}

}  // namespace

void tell_colours(const Subject& s, const std::vector<LensField>& fields, Result& result) {
    if (!disperses(s.display())) return;
    const double from_vertex = s.geometry().rear_principal_mm - s.geometry().vertex_plane_mm;
    const std::array<Coloured, 3> at{Coloured(s, 0), Coloured(s, 1), Coloured(s, 2)};
    Json& json = result.figures["colour"];
    for (std::size_t c = 0; c < 3; ++c)
        json[channel_names[c]] = {{"wavelength_nm", s.display().panel.wavelengths_nm[c]},
                                  {"focal_length_mm", number_json(at[c].geometry.focal_length_mm)},
                                  {"central_depth_mm", number_json(central_depth_mm(s, at[c]) + from_vertex)}};
    const double axial = central_depth_mm(s, at[0]) - central_depth_mm(s, at[2]);
    result.add("colour.axial_mm", axial,
               {.label = "Axial colour: central depth plane of red beyond that of blue",
                .unit = "mm",
                .remark = "paraxial, with each colour's own focal length and gap"});

    // If L is infinite, spots are compared at the middle one of the other figures' depths.
    const double L = s.theory().central_depth_mm, depth = std::isinf(L) ? spot_depths_mm(s.theory())[2] : L;
    DataTable table = DataTable::of_rows("spot_colour", {"panel_x_mm", "panel_y_mm", "channel", "x_mm", "y_mm", "rms_radius_mm"});
    Json& lateral = json["lateral"] = Json::array();
    for (const LensField& field : fields) {
        std::array<Bundle, 3> shown;
        std::array<std::array<Centroid, colour_rays.size()>, 3> middle{};
        bool through = true;
        for (std::size_t c = 0; c < 3; ++c) {
            shown[c] = at[c].light(field.panel, drawn_rays);
            for (std::size_t grid = 0; grid < colour_rays.size(); ++grid) {
                const Bundle light = at[c].light(field.panel, colour_rays[grid]);
                through = through && !light.rays.empty();
                middle[c][grid] = light.rays.empty() ? Centroid{nan, nan, nan} : centroid_at(light, depth);
            }
            const Centroid& finest = middle[c].front();
            table.add_row({field.panel[0], field.panel[1], double(c), finest.x, finest.y, finest.rms});
        }
        const auto from_green = [&](std::size_t c) {
            std::array<double, colour_rays.size()> found;
            for (std::size_t grid = 0; grid < found.size(); ++grid) {
                const Centroid &here = middle[c][grid], &green = middle[1][grid];
                const double mm = std::hypot(here.x - green.x, here.y - green.y);
                found[grid] = mm < 1e-9 ? 0 : mm;  // within double precision
            }
            return estimate(found);
        };
        const Estimate red = from_green(0), blue = from_green(2);
        Json& row_json = lateral.emplace_back(Json{{"field", field.name}});
        write_value(row_json, "red_mm", red);
        write_value(row_json, "blue_mm", blue);
        if (!through) {
            result.note(fmt::format("colour.lateral.{}", lateral.size() - 1), "no light of this panel point gets through the lens");
            continue;
        }
        result.add_line({red, blue}, {.label = fmt::format("Lateral colour, {}: red and blue from green", field.title),
                                      .unit = "mm",
                                      .remark = fmt::format("centroids of spots {}", depth_in_words(depth + from_vertex))});
        result.plots.push_back(colour_diagram(field, shown, depth, from_vertex));
    }
    result.tables.push_back(std::move(table));
}

}  // namespace lfdsim
