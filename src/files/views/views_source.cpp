#include "files/views/views_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <regex>

#include "base/constants.h"
#include "files/views/views_internal.h"

namespace lfdsim {
namespace {

namespace fs = std::filesystem;

constexpr const char* forms =
    "give a folder with views.toml, with parameters.cfg (HCI 4D) or with names such as out_00_00_-1.5_2.5_.png (Stanford archive) "
    "or 000_000.png (ROW_COLUMN), or a quilt such as name_qs8x6a0.75.png";

// Returns a quilt as one row of views, in the order of its tiles.
ViewsSource find_quilt(const fs::path& file) {
    const std::optional<QuiltName> name = quilt_name(file);
    if (!name) throw InputError(file.string(), fmt::format("has no _qsCOLUMNSxROWSaASPECT in its name; {}", forms));
    ViewsSource source;
    source.form = ViewsForm::quilt;
    source.name = file.string();
    source.tiles = {name->columns, name->rows};
    source.columns = name->columns * name->rows;
    source.aspect = name->aspect;
    source.pictures = {file};
    const fs::path described = fs::path(file).replace_extension(".toml");
    if (std::error_code none; fs::exists(described, none)) detail::describe_quilt(described, source);
    return source;
}

double mean_step(const std::vector<std::array<double, 2>>& cameras, int columns, int rows) {
    const std::size_t last = cameras.size() - 1;
    double sum = 0;
    if (columns > 1) {
        for (int j = 0; j < rows; ++j) {
            const std::size_t first = std::size_t(j) * std::size_t(columns);
            sum += cameras[first + std::size_t(columns) - 1][0] - cameras[first][0];
        }
        return std::abs(sum) / rows / (columns - 1);
    }
    return rows > 1 ? std::abs(cameras[0][1] - cameras[last][1]) / (rows - 1) : 0;
}

}  // namespace

std::string_view name_of(ViewsForm form) {
    constexpr std::string_view names[] = {"HCI 4D", "Stanford archive", "ROW_COLUMN names", "numbered pictures", "quilt"};
    return names[std::size_t(form)];
}

double ViewsSource::step() const { return cameras.empty() ? 0 : mean_step(cameras, columns, rows); }

ViewsSource find_views(const fs::path& path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (error == std::errc::permission_denied) throw InputError(path.string(), fmt::format("cannot be read: {}", error.message()));
    if (path.empty() || !fs::exists(status))
        throw InputError(path.string(), fmt::format("there is no such folder or file; {}", forms));
    if (fs::is_directory(status)) {
        if (fs::exists(path / "views.toml", error)) return detail::described_views(path / "views.toml");
        if (fs::exists(path / "parameters.cfg", error)) return detail::hci_views(path);
        if (std::optional<ViewsSource> found = detail::stanford_views(path)) return *found;
        if (std::optional<ViewsSource> found = detail::row_column_views(path)) return *found;
        throw InputError(path.string(), fmt::format("contains no grid of views in a known form; {}", forms));
    }
    if (path.extension() == ".toml") return detail::described_views(path);
    if (path.filename() == "parameters.cfg") return detail::hci_views(path.has_parent_path() ? path.parent_path() : ".");
    return find_quilt(path);
}

void flip(ViewsSource& source) {
    std::reverse(source.pictures.begin(), source.pictures.end());
    std::reverse(source.depths.begin(), source.depths.end());
    source.cameras = opposite(std::move(source.cameras));
    source.flipped = !source.flipped;
}

std::optional<QuiltName> quilt_name(const fs::path& path) {
    static const std::regex tag(R"(_qs(\d{1,4})x(\d{1,4})a(\d{1,6}(\.\d{1,12})?)$)");
    const std::string stem = path.stem().string();
    std::smatch found;
    if (!std::regex_search(stem, found, tag)) return {};
    const QuiltName name{std::stoi(found[1]), std::stoi(found[2]), std::stod(found[3])};
    if (name.columns < 1 || name.rows < 1 || name.columns * name.rows > most_views_a_side)
        throw InputError(path.string(), fmt::format("is named as a quilt of {} x {} views; allowed are 1 to {} in all",
                                                    name.columns, name.rows, most_views_a_side));
    if (!(name.aspect >= 0.01 && name.aspect <= 100))
        throw InputError(path.string(), fmt::format("is named as a quilt of the aspect {}; allowed is 0.01 to 100", name.aspect));
    return name;
}

ViewGrid placed(const ViewsSource& source, const ViewsWish& wish, const ViewsPlace& place, double focus_aspect,
                std::vector<std::string>& notes) {
    // The focus: its depth, width and height. Lengths of the source are scaled as its width is.
    ViewGrid grid;
    grid.columns = source.columns;
    grid.rows = source.rows;
    grid.depth_mm = wish.depth_mm.value_or(source.depth_mm.value_or(place.depth_mm));
    const double fits = std::min(place.panel_width_mm, place.panel_height_mm * focus_aspect);
    grid.width_mm = wish.width_mm.value_or(source.for_display ? source.width_mm.value_or(fits) : fits);
    grid.height_mm = grid.width_mm / focus_aspect;
    const double scale = source.width_mm ? grid.width_mm / *source.width_mm : 1;
    const bool placed_in_cone = source.cameras.empty() || source.cone_deg || !source.in_mm;
    if (wish.cone && (wish.baseline_mm || !(placed_in_cone || wish.cone_deg)))
        throw InputError("--cone",
                         wish.baseline_mm
                             ? "places the cameras in a view cone, --baseline-mm at equal distances; give one of them"
                             : "places the cameras in a view cone, but their positions are given; give --view-cone-deg, too");
    // Views of which nothing is known are placed as the display shows quilts: the k-th of n parts of each elemental image has view
    // k, whatever its camera's position was.
    const bool unsaid = source.cameras.empty() && !source.cone_deg && !source.cone && !source.distance_mm && !wish.baseline_mm &&
                        !wish.cone_deg && !wish.cone && !wish.distance_mm;
    const bool as_shown = unsaid && place.view_cone_deg && place.zone_width_mm > 0 && grid.rows == 1;
    // The distance B from the cameras to the focus: as wished, as the files say, or the viewing distance.
    if (wish.distance_mm)
        grid.distance_mm = *wish.distance_mm;
    else if (source.distance_mm)
        grid.distance_mm = *source.distance_mm * scale;
    else if (std::isinf(place.viewing_distance_mm))
        throw InputError(source.name,
                         "does not state the distance from its cameras to the focus, and the viewing distance is infinite; give "
                         "--camera-distance-mm");
    else {
        grid.distance_mm = place.viewing_distance_mm - place.vertex_plane_mm - grid.depth_mm;
        if (!as_shown) notes.push_back(fmt::format("cameras at the viewing distance, {:.6g} mm from the focus", grid.distance_mm));
    }
    const ConeCameras cone =
        wish.cone.value_or(source.cone.value_or(source.form == ViewsForm::quilt ? ConeCameras::ends : ConeCameras::bins));
    // The cameras: by a baseline that is wished, by a cone that is wished, by the files, or by the display.
    const auto in_cone = [&](double cone_deg) { return cone_cameras(grid.columns, grid.rows, cone_deg, grid.distance_mm, cone); };
    if (wish.baseline_mm && source.cameras.empty())
        grid.camera_mm =
            camera_places(even_places(grid.columns, (*wish.baseline_mm)[0]), even_places(grid.rows, -(*wish.baseline_mm)[1]));
    else if (wish.baseline_mm) {  // the wish is the mean step: uneven positions remain uneven
        grid.camera_mm = source.cameras;
        double low[2] = {infinity, infinity}, high[2] = {-infinity, -infinity};
        for (const auto& at : source.cameras)
            for (std::size_t k = 0; k < 2; ++k) low[k] = std::min(low[k], at[k]), high[k] = std::max(high[k], at[k]);
        const int parts[2] = {grid.columns - 1, grid.rows - 1};
        for (auto& at : grid.camera_mm)
            for (std::size_t k = 0; k < 2; ++k)
                at[k] = parts[k] > 0 ? at[k] * (*wish.baseline_mm)[k] * parts[k] / (high[k] - low[k]) : 0;
    } else if (wish.cone_deg && !source.cameras.empty() && !source.in_mm) {
        grid.camera_mm = source.cameras;
        const int row = grid.columns > 1 ? grid.columns : grid.rows, steps = cone == ConeCameras::ends ? row - 1 : row;
        const double wanted = 2 * grid.distance_mm * std::tan(0.5 * *wish.cone_deg * degree) / std::max(steps, 1);
        for (auto& at : grid.camera_mm)
            for (double& value : at) value *= source.step() > 0 ? wanted / source.step() : 0;
    } else if (wish.cone_deg || ((wish.cone || wish.distance_mm) && source.cone_deg)) {
        grid.camera_mm = in_cone(wish.cone_deg ? *wish.cone_deg : *source.cone_deg);
    } else if (!source.cameras.empty() && !source.in_mm) {
        throw InputError(source.name,
                         "gives its cameras' positions in an unknown unit; give --baseline-mm from camera to camera, or "
                         "--view-cone-deg that they span");
    } else if (!source.cameras.empty()) {
        grid.camera_mm = source.cameras;
        for (auto& at : grid.camera_mm)
            for (double& value : at) value *= scale;
    } else if (as_shown) {
        grid.camera_mm = camera_places(even_places(grid.columns, place.zone_width_mm / grid.columns), {0});
        grid.border_mm = place.lens_mm;  // there are lenses beside the panel's outermost pixels, too
    } else {
        const double of_display = place.view_cone_deg.value_or(usual_cone_deg);
        grid.camera_mm = in_cone(source.cone_deg.value_or(of_display));
        if (!source.cone_deg)
            notes.push_back(
                fmt::format("a view cone of {} degrees{}", of_display, place.view_cone_deg ? ", that of the display" : ""));
    }
    if (std::vector<Problem> faults = faults_of(grid); !faults.empty()) {
        const bool as_stated = !wish.baseline_mm && !wish.cone_deg && !source.cameras_key.empty();
        for (Problem& fault : faults)
            fault.where = as_stated && fault.where == "baseline_mm" ? source.cameras_key : source.name + ": " + fault.where;
        throw InputError(std::move(faults));
    }
    return grid;
}

}  // namespace lfdsim
