// A light field as pictures: a grid of cameras that look at one rectangle. Floor 0: plain data. docs/model.md, "Grids of views".
#pragma once
#include "base/input_error.h"

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace lfdsim {

/// The most cameras of a grid, along each side and all together.
inline constexpr int most_views_a_side = 1024, most_views = 16384;

/// Pinhole cameras in one plane, each of which shows exactly the focus: an upright rectangle parallel to that plane, in which a
/// point has the same place in all pictures (zero parallax). Their pictures are those of off-axis frusta, or of parallel cameras
/// whose pictures are shifted and cut. Positions are from the rectangle's middle, x to the viewer's right and y up.
struct ViewGrid {
    int columns = 1, rows = 1;                     // of cameras: column 0 on the left, row 0 at the top
    std::vector<std::array<double, 2>> camera_mm;  // x and y of each, row by row; x rises along a row, y falls from row to row
    double distance_mm = 0;                        // from the cameras' plane to the rectangle
    double width_mm = 0, height_mm = 0;            // of the rectangle
    double depth_mm = 0;                           // of the rectangle in front of the lenses' viewer-side vertex plane
    double border_mm = 0;                          // width by which the border of a view continues beyond the rectangle

    std::size_t views() const { return camera_mm.size(); }
    const std::array<double, 2>& camera(int column, int row) const {
        return camera_mm[std::size_t(row) * std::size_t(columns) + std::size_t(column)];
    }
    bool operator==(const ViewGrid&) const = default;
};

/// Returns the positions of cameras at these x (left to right) and y (top to bottom), row by row.
std::vector<std::array<double, 2>> camera_places(const std::vector<double>& x_mm, const std::vector<double>& y_mm);

/// Returns n positions `step` apart about 0, ascending (with a negative step, descending).
std::vector<double> even_places(int n, double step);

/// How the cameras of a row divide the angle of a view cone, in equal steps of the angle.
enum class ConeCameras {
    ends,  // from one end of the cone to the other: distance tan(cone (i/(n - 1) - 1/2))
    bins   // each in the middle of its n-th part: distance tan(cone ((i + 1/2)/n - 1/2))
};
inline constexpr std::string_view cone_camera_words[] = {"ends", "bins"};
/// Returns the x, mm, of the n cameras of a row in a view cone, ascending about 0; a single camera is at 0.
std::vector<double> cone_places(int n, double cone_deg, double distance_mm, ConeCameras);
/// Returns the camera positions of a grid: each row is in the cone, and rows are as far apart as the cameras of a row in the mean.
/// A single column is in the cone itself.
std::vector<std::array<double, 2>> cone_cameras(int columns, int rows, double cone_deg, double distance_mm, ConeCameras);

/// Returns the grid as it is from behind: camera k is opposite to the k-th last. With its pictures in reversed order, pseudoscopic
/// views become orthoscopic ones, and vice versa.
std::vector<std::array<double, 2>> opposite(std::vector<std::array<double, 2>> camera_mm);

/// Returns what makes a grid impossible, each with the key of a views file ("baseline_mm") as `where`; empty: the grid is valid.
std::vector<Problem> faults_of(const ViewGrid&);

}  // namespace lfdsim
