#include "engine/views/grid_view.h"

#include "display/keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

/// Calls add(i, share) for the pixels i = 0 .. count - 1, which begin at `first` + i, of which the interval from .. to covers a
/// part; the shares are those of the interval.
template <class Add>
void each_part(double from, double to, int first, int count, const Add& add) {
    for (int i = std::max(first, int(std::floor(from))); i < std::min(double(first + count), to); ++i)
        add(i - first, (std::min(i + 1., to) - std::max(double(i), from)) / (to - from));
}

}  // namespace

GridCamera grid_camera(const Display& display, const Geometry& geometry, const ViewGrid& grid, int column, int row, int width,
                       int height) {
    // The picture is centred on the camera's axis and reaches to the far ends of the focus, in square pixels.
    const auto [x, y] = grid.camera(column, row);
    const double pixel = 0.5 * std::min(grid.width_mm / width, grid.height_mm / height);
    const double half_columns = std::ceil((std::abs(x) + 0.5 * grid.width_mm) / pixel),
                 half_rows = std::ceil((std::abs(y) + 0.5 * grid.height_mm) / pixel);
    const std::string place = fmt::format("the camera in column {}, row {} of the grid", column, row);
    if (!(4 * half_columns * half_rows < two_to_31))
        throw InputError(place,
                         "is so far off axis that its picture has 2^31 pixels or more; give smaller views or a smaller baseline");
    GridCamera made{display, {}, 0, 0, grid.width_mm / width / pixel, grid.height_mm / height / pixel};
    Camera& camera = made.display.camera;
    const double focus_z = geometry.vertex_plane_mm + grid.depth_mm;
    camera.position_mm = {x, y, focus_z + grid.distance_mm};
    camera.target_mm = {x, y, focus_z};
    camera.up = {0, 1, 0};
    camera.fov_deg.reset();
    camera.focus_distance_mm.reset();
    camera.frame_width_mm = 2 * half_columns * pixel;
    camera.resolution = {std::int64_t(2 * half_columns), std::int64_t(2 * half_rows)};
    made.left = half_columns - (0.5 * grid.width_mm + x) / pixel;
    made.top = half_rows - (0.5 * grid.height_mm - y) / pixel;
    made.crop = {int(std::floor(made.left)), int(std::floor(made.top)),
                 int(std::min(2 * half_columns, std::ceil(made.left + grid.width_mm / pixel))),
                 int(std::min(2 * half_rows, std::ceil(made.top + grid.height_mm / pixel)))};
    if (std::vector<Problem> problems = validate(made.display); !problems.empty()) {
        for (Problem& problem : problems) problem.where = place + ": " + problem.where;
        throw InputError(std::move(problems));
    }
    return made;
}

Rendering grid_view(const GridCamera& made, const SummedPanel& panel, int width, int height, RenderOptions options, Job& job) {
    options.crop = made.crop;
    Rendering r = render(made.display, resolve(made.display), panel, options, job);
    // The mean over each pixel's area, along rows, then along columns
    const Image& fine = r.image;
    Image even(width, fine.height), view(width, height);
    for (int i = 0; i < width; ++i)
        each_part(made.left + i * made.per_column, made.left + (i + 1) * made.per_column, made.crop.x0, fine.width,
                  [&](int from, double share) {
                      for (int j = 0; j < fine.height; ++j)
                          for (int c = 0; c < 3; ++c) even.at(i, j)[c] += float(share) * fine.at(from, j)[c];
                  });
    for (int j = 0; j < height; ++j)
        each_part(made.top + j * made.per_row, made.top + (j + 1) * made.per_row, made.crop.y0, fine.height,
                  [&](int from, double share) {
                      for (int k = 0; k < 3 * width; ++k) view.at(0, j)[k] += float(share) * even.at(0, from)[k];
                  });
    r.image = std::move(view);
    return r;
}

}  // namespace lfdsim
