#include "display/view_grid.h"

#include "base/constants.h"
#include "base/counted.h"
#include "display/keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

// A camera that looks at the focus at a flatter angle than this sees nothing of use, and its pictures are nearly singular.
constexpr double steepest_slope = 20;

}  // namespace

std::vector<std::array<double, 2>> camera_places(const std::vector<double>& x_mm, const std::vector<double>& y_mm) {
    std::vector<std::array<double, 2>> places;
    for (const double y : y_mm)
        for (const double x : x_mm) places.push_back({x, y});
    return places;
}

std::vector<double> even_places(int n, double step) {
    std::vector<double> places;
    for (int i = 0; i < n; ++i) places.push_back((i - 0.5 * (n - 1)) * step + 0.);  // never -0
    return places;
}

std::vector<double> cone_places(int n, double cone_deg, double distance_mm, ConeCameras cameras) {
    const auto share = [&](int i) {  // of the cone's angle, from its middle: -1/2 to 1/2
        if (n == 1) return 0.;
        return cameras == ConeCameras::ends ? double(i) / (n - 1) - 0.5 : (i + 0.5) / n - 0.5;
    };
    std::vector<double> places;
    for (int i = 0; i < n; ++i) places.push_back(distance_mm * std::tan(cone_deg * degree * share(i)));
    return places;
}

std::vector<std::array<double, 2>> cone_cameras(int columns, int rows, double cone_deg, double distance_mm, ConeCameras cameras) {
    std::vector<double> x = cone_places(columns, cone_deg, distance_mm, cameras);
    if (columns > 1) return camera_places(x, even_places(rows, -(x.back() - x.front()) / (columns - 1)));
    std::vector<double> y = cone_places(rows, cone_deg, distance_mm, cameras);
    std::reverse(y.begin(), y.end());  // the highest first
    return camera_places(x, y);
}

std::vector<std::array<double, 2>> opposite(std::vector<std::array<double, 2>> camera_mm) {
    std::reverse(camera_mm.begin(), camera_mm.end());
    for (auto& [x, y] : camera_mm) x = -x, y = -y;
    return camera_mm;
}

std::vector<Problem> faults_of(const ViewGrid& grid) {
    std::vector<Problem> all;
    const auto length = [&](const char* key, double value, const Range& range) {
        if (!range.contains(value)) all.push_back({key, fmt::format("is {}, allowed is {}", value, range.text())});
    };
    if (grid.columns < 1 || grid.rows < 1 || grid.columns > most_views_a_side || grid.rows > most_views_a_side ||
        grid.columns * grid.rows > most_views)
        all.push_back({"columns, rows", fmt::format("{} x {} views; allowed are 1 to {} along each side and {} in all",
                                                    grid.columns, grid.rows, most_views_a_side, most_views)});
    else if (grid.views() != std::size_t(grid.columns) * std::size_t(grid.rows))
        all.push_back(
            {"columns, rows", fmt::format("{} x {} views have {}", grid.columns, grid.rows, counted(grid.views(), "camera"))});
    length("distance_mm", grid.distance_mm, positive_length);
    length("width_mm", grid.width_mm, positive_length);
    length("height_mm", grid.height_mm, positive_length);
    length("depth_mm", grid.depth_mm, any_length);
    if (!all.empty()) return all;

    // The greatest distance off axis bounds the slope of a line from a camera to the focus's middle.
    double reach = 0;
    for (const auto& [x, y] : grid.camera_mm) {
        reach = std::max({reach, std::abs(x), std::abs(y)});
        if (!any_length.contains(x) || !any_length.contains(y)) reach = infinity;
    }
    if (!(reach <= steepest_slope * grid.distance_mm))
        all.push_back({"baseline_mm", fmt::format("puts cameras {:.6g} mm off axis at a distance of {:.6g} mm; allowed is up to {} "
                                                  "times the distance. Give both in millimetres",
                                                  reach, grid.distance_mm, steepest_slope)});
    // Columns rise and rows fall strictly, by a length that a description could state.
    const auto apart = [&](int columns, int rows, auto step) {
        for (int j = 0; j < rows; ++j)
            for (int i = 0; i < columns; ++i)
                if (!(step(i, j) >= shortest_mm)) return false;
        return true;
    };
    if (!apart(grid.columns - 1, grid.rows, [&](int i, int j) { return grid.camera(i + 1, j)[0] - grid.camera(i, j)[0]; }))
        all.push_back({"baseline_mm", "each camera of a row must be to the right of the one before it"});
    if (!apart(grid.columns, grid.rows - 1, [&](int i, int j) { return grid.camera(i, j)[1] - grid.camera(i, j + 1)[1]; }))
        all.push_back({"baseline_mm", "each camera of a column must be below the one before it"});
    return all;
}

}  // namespace lfdsim
