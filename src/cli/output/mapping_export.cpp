#include "cli/output/mapping_export.h"

#include "base/constants.h"
#include "base/json_utf8.h"
#include "cli/output/companion.h"
#include "cli/output/output.h"
#include "cli/program/input_files.h"
#include "content/pickup/lens_mapping.h"
#include "geometry/lattice.h"
#include "image/formats/image_file.h"
#include "report/plots/svg.h"

#include <fmt/format.h>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <vector>

namespace lfdsim::cli {
namespace {

namespace fs = std::filesystem;

constexpr int values_per_node = 5;  // x, y, slope x, slope y, light

/// The line along which most light of a panel point u travels, and the light relative to that of the point on the axis; NaN where
/// there is none. A LensMapping has its difference to the nodal line, whose slope is -u/g.
struct NodeLine {
    double ux, uy, x, y, mx, my, light;  // u and the line's point in the plane of H', mm; its slopes; light, 1 on the axis
};
NodeLine node_line(const LensMapping& map, const Geometry& g, bool strips, int i, int j) {
    const auto place = [&](std::size_t k, int n) {
        return map.nodes()[k] > 1 ? map.reach_mm()[k] * (2. * n / (map.nodes()[k] - 1) - 1) : 0;
    };
    const double ux = place(0, i), uy = place(1, j);
    const LineShift& shift = map.node(i, j);
    const bool lit = map.share(i, j) > 0;
    const auto of_light = [&](double value) { return lit ? value : nan; };
    return {ux,
            uy,
            of_light(double(shift.x)),
            of_light(strips ? nan : double(shift.y)),
            of_light(double(shift.mx) - ux / g.gap_mm),
            of_light(strips ? nan : double(shift.my) - uy / g.gap_mm),
            map.share(i, j)};
}

/// Returns the values of all nodes, values_per_node each, by rows from the top as in pictures, one map after the other.
std::vector<float> table_of(const std::vector<LensMapping>& maps, const Geometry& g, bool strips) {
    std::vector<float> values;
    for (const LensMapping& map : maps)
        for (int j = map.nodes()[1]; j-- > 0;)
            for (int i = 0; i < map.nodes()[0]; ++i) {
                const NodeLine n = node_line(map, g, strips, i, j);
                for (const double value : {n.x, n.y, n.mx, n.my, n.light}) values.push_back(float(value));
            }
    return values;
}

/// Writes the table as layers COLOUR.slope and COLOUR.place; the picture is the slopes of the middle map.
void write_exr(const fs::path& path, const std::vector<LensMapping>& maps, const std::vector<float>& values) {
    const int width = maps[0].nodes()[0], height = maps[0].nodes()[1];
    WriteOptions options;
    Image first;
    for (std::size_t m = 0; m < maps.size(); ++m) {
        Image slopes(width, height), places(width, height);
        for (int n = 0; n < width * height; ++n) {
            const float* const from = &values[(m * std::size_t(width * height) + std::size_t(n)) * values_per_node];
            float *const slope = slopes.at(n % width, n / width), *const place = places.at(n % width, n / width);
            slope[0] = from[2], slope[1] = from[3], slope[2] = from[4];
            place[0] = from[0], place[1] = from[1], place[2] = 0;
        }
        const std::string colour = maps.size() > 1 ? colour_of_channel[m] : "all";
        if (m == maps.size() / 2) first = slopes;
        options.layers.push_back({colour + ".slope", std::move(slopes)});
        options.layers.push_back({colour + ".place", std::move(places)});
    }
    write_image(path, first, options);
}

/// Returns the content of NAME.json.
Json sidecar(const Display& d, const Geometry& g, const std::vector<LensMapping>& maps, const std::string& file) {
    const LensMapping& map = maps[0];
    Json wavelengths = Json::array(), names = Json::array();
    for (std::size_t m = 0; m < maps.size(); ++m) {
        names.push_back(maps.size() > 1 ? colour_of_channel[m] : "all");
        if (maps.size() > 1) wavelengths.push_back(d.panel.wavelengths_nm[m]);
    }
    const auto axis = [&](std::size_t k, const char* direction) {
        return Json{{"first_mm", (k == 1 ? 1 : -1) * map.reach_mm()[k]},
                    {"last_mm", (k == 1 ? -1 : 1) * map.reach_mm()[k]},
                    {"count", map.nodes()[k]},
                    {"direction", direction}};
    };
    return {{"lfdsim", LFDSIM_VERSION},
            {"file", file},
            {"what",
             "For panel points u under a lens, relative to its axis: the line along which most of their light travels on the "
             "viewer's side, with equal weight for all parts of the lens's aperture. The line is (x, y) + (slope_x, slope_y) (z - "
             "plane_z_mm) from the lens's axis; all in the array's frame, rotated relative to the panel's by array_turn_deg "
             "(counter-clockwise to the viewer)"},
            {"npy_axes", {"colour", "row", "column", "value"}},
            {"values",
             {{{"name", "x_mm"}, {"unit", "mm"}},
              {{"name", "y_mm"}, {"unit", "mm"}},
              {{"name", "slope_x"}, {"unit", "1"}},
              {{"name", "slope_y"}, {"unit", "1"}},
              {{"name", "light"},
               {"unit", "relative to the light of the point on the axis; 0: none leaves the lens, and the other values are NaN"}}}},
            {"exr_layers", "COLOUR.slope: R slope_x, G slope_y, B light; COLOUR.place: R x_mm, G y_mm"},
            {"columns", axis(0, "u along the array's x")},
            {"rows", axis(1, "u along the array's y, from the top")},
            {"colours", names},
            {"wavelengths_nm", wavelengths},
            {"plane_z_mm", g.rear_principal_mm},
            {"gap_mm", g.gap_mm},
            {"array_turn_deg", g.turn_deg},
            {"strips", is_strips(d.array)},
            {"nodal_line", "has x = y = 0 and the slope -u / gap_mm"},
            {"display", d.name}};
}

/// Returns the plot of a grid of panel points in the plane of slopes, in which nodal lines make straight lines; of strips the
/// difference of the slope from that of the nodal line.
Plot plot_of(const std::vector<LensMapping>& maps, const Geometry& g, bool strips, const std::string& name) {
    Plot plot{
        "mapping", "Where the lens sends light, " + (name.empty() ? "array's frame" : name), "slope along x", "slope along y", {}};
    if (strips) {
        plot.x_label = "panel point from the lens's axis, mm";
        plot.y_label = "slope across the strip less that of the nodal line";
    } else {
        plot.equal_axes = true;
    }
    constexpr int lines = 9;
    const auto trace = [&](const LensMapping& map, Series& out, bool nodal) {
        const auto add = [&](int i, int j) {
            const NodeLine n = node_line(map, g, strips, i, j);
            out.x.push_back(strips ? n.ux : nodal ? -n.ux / g.gap_mm : n.mx);
            out.y.push_back(strips ? n.mx + n.ux / g.gap_mm : nodal ? -n.uy / g.gap_mm : n.my);
        };
        const auto gap = [&] { out.x.push_back(nan), out.y.push_back(nan); };
        const auto [columns, rows] = map.nodes();
        for (int k = 0; k < (strips ? 1 : lines); ++k, gap())
            for (int i = 0; i < columns; ++i) add(i, k * (rows - 1) / (lines - 1));
        for (int k = 0; k < (strips ? 0 : lines); ++k, gap())
            for (int j = 0; j < rows; ++j) add(k * (columns - 1) / (lines - 1), j);
    };
    if (!strips) trace(maps[0], plot.series.emplace_back(Series{"nodal", {}, {}}), true);
    for (std::size_t m = 0; m < maps.size(); ++m)
        trace(maps[m], plot.series.emplace_back(Series{maps.size() > 1 ? colour_of_channel[m] : "traced", {}, {}}), false);
    return plot;
}

fs::path beside(const std::string& path, const char* ending) { return fs::path(path).replace_extension(ending); }

/// Whether a file is what sidecar() wrote beside a mapping of that name.
bool is_sidecar(const fs::path& path, const std::string& mapping) {
    std::error_code none;
    if (std::uintmax_t(1) << 20 < fs::file_size(path, none) || none) return false;
    std::ifstream file(path, std::ios::binary);
    const Json json = Json::parse(file, nullptr, false);
    return json.is_object() && json.contains("lfdsim") && json.value("file", Json()) == mapping;
}

}  // namespace

void MappingOption::check(const std::string& output) const {
    if (!given()) return;
    if (!output.empty() && fs::weakly_canonical(fs::absolute(path())) == fs::weakly_canonical(fs::absolute(output)))
        throw InputError("--output, --mapping", "name the same file; give two names");
    const fs::path ending = fs::path(path()).extension();
    if (ending != ".npy" && ending != ".exr")
        throw InputError(mapping_.name(), fmt::format("{}: the name must end in .npy or .exr", path()));
    check_output(path());
    // The two other files are those of an earlier run if the .json says that it is of this file.
    const bool own = is_sidecar(beside(path(), ".json"), fs::path(path()).filename());
    for (const char* other : {".json", ".svg"}) check_companion(beside(path(), other), own, replace_);
}

void MappingOption::write(const Display& display, const Geometry& geometry, int threads) const {
    Display mean = display;
    mean.content.pickup = PickupKind::traced;
    const std::vector<LensMapping> maps = lens_mappings(mean, geometry, threads);
    const bool strips = is_strips(display.array);
    const std::vector<float> values = table_of(maps, geometry, strips);
    const std::int64_t width = maps[0].nodes()[0], height = maps[0].nodes()[1];
    if (fs::path(path()).extension() == ".npy")
        write_npy(path(), std::array<std::int64_t, 4>{std::int64_t(maps.size()), height, width, values_per_node}, values);
    else
        write_exr(path(), maps, values);
    write_text(beside(path(), ".json"), json_file(sidecar(display, geometry, maps, fs::path(path()).filename())));
    write_text(beside(path(), ".svg"), svg(plot_of(maps, geometry, strips, display.name)));
}

}  // namespace lfdsim::cli
