#include "content/pictures/read_views.h"

#include "engine/devices/memory.h"
#include "image/compare/above_white.h"
#include "image/formats/image_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

/// Throws InputError if there is no memory for the views with their coarser levels (4/3), and one more view while those are made.
void require_views_memory(const ViewsSource& source, std::size_t views, int width, int height) {
    require_memory(source.name, fmt::format("{} views of {} x {} pixels", views, width, height),
                   picture_bytes(width, height) * (4. / 3 * double(views) + 1));
}

/// Returns the views of a quilt, in the grid's order.
std::vector<Image> tiles_of(const ViewsSource& source, const Image& quilt, std::vector<std::string>& notes) {
    const auto [columns, rows] = source.tiles;
    const std::string name = source.pictures.front().string();
    const int width = quilt.width / columns, height = quilt.height / rows;
    if (width < 1 || height < 1)
        throw InputError(name, fmt::format("is {} x {} pixels, fewer than the {} x {} views in its name; correct the name",
                                           quilt.width, quilt.height, columns, rows));
    // Views have whole pixels. Quilts for some devices have spare columns and rows; views are counted from the lower left.
    const auto spare = [&](int rest, const char* where, const char* what) {
        if (rest > 0)
            notes.push_back(rest == 1 ? fmt::format("the {} {} of pixels belongs to no view", where, what)
                                      : fmt::format("the {} {} {}s of pixels belong to no view", where, rest, what));
    };
    spare(quilt.width % columns, "rightmost", "column");
    spare(quilt.height % rows, "uppermost", "row");
    // Quilts of large devices have pixels up to 1.8 times as wide as high, so this is no error.
    if (const double squares = double(width) / height;
        source.aspect && std::abs(std::log(*source.aspect / squares)) > std::log(1.2))
        notes.push_back(
            fmt::format("views of {} x {} pixels, which are stretched to {:.4g} times as wide as high; if that is "
                        "wrong, so is the quilt's name",
                        width, height, *source.aspect));
    require_views_memory(source, source.views(), width, height);
    std::vector<Image> views;
    for (int n = 0; n < columns * rows; ++n) {
        Image view(width, height);
        const int left = n % columns * width, top = quilt.height - (n / columns + 1) * height;
        for (int y = 0; y < height; ++y) std::copy_n(quilt.at(left, top + y), std::size_t(width) * 3, view.at(0, y));
        views.push_back(std::move(view));
    }
    if (source.flipped) std::reverse(views.begin(), views.end());
    return views;
}

/// Returns the map of a file's values: kappa = d w/(n b) for a disparity of d pixels from camera to camera, with a step b and a
/// focus w wide on n pixels; kappa = B/s - 1 for the distance s from the cameras' plane (docs/model.md, "Grids of views").
KappaMap kappa_map(const ViewsSource& source, const Image& values, const ViewGrid& grid, double step_mm) {
    KappaMap map{values.width, values.height, {}};
    // Views may be placed with another ratio of focus to step than they were taken with; kappa changes by it.
    const double scale = source.width_mm && source.step() > 0 ? grid.width_mm / *source.width_mm / (step_mm / source.step()) : 1;
    for (std::size_t i = 0; i < values.rgb.size(); i += 3) {
        const double value = double(values.rgb[i]);
        double kappa;
        if (source.depth_value == DepthValue::disparity)
            kappa = value * grid.width_mm / values.width / step_mm;
        else if (value > 0)
            kappa = (*source.distance_mm / (value * source.depth_unit_mm) - 1) * scale;
        else
            kappa = INFINITY;  // nothing is there
        map.kappa.push_back(std::isfinite(kappa) ? float(std::clamp(kappa, -0.9999, 1e4)) : INFINITY);
    }
    return map;
}

/// Returns the mean step between neighbouring cameras of a row, or of a single column, mm.
double step_of(const ViewGrid& grid) {
    const auto &first = grid.camera_mm.front(), &last = grid.camera_mm.back();
    if (grid.columns > 1) return (last[0] - first[0]) / (grid.columns - 1);
    return grid.rows > 1 ? (first[1] - last[1]) / (grid.rows - 1) : 1;
}

}  // namespace

std::optional<ReadViews> read_views(const ViewsSource& source, const ViewsWish& wish, const ViewsPlace& place, Job& job) {
    std::vector<std::string> notes;
    job.stage("views", std::int64_t(source.pictures.size() + source.depths.size()));
    Image first = read_image(source.pictures.front(), Encoding::srgb);
    job.advance(1);
    std::vector<Image> views;
    if (source.form == ViewsForm::quilt)
        views = tiles_of(source, first, notes);
    else
        views.push_back(std::move(first));
    const int width = views.front().width, height = views.front().height;
    if (std::string doubt = above_white(views.front().rgb.data(), std::int64_t(width) * height, 3, LightOf::picture);
        !doubt.empty())
        notes.push_back(std::move(doubt));
    if (source.form == ViewsForm::row_column)
        notes.push_back(
            fmt::format("names are taken as ROW_COLUMN, {} x {} views from the upper left; a views.toml can say otherwise",
                        source.columns, source.rows));
    if (source.form == ViewsForm::hci && std::abs(*source.aspect * height - width) > 1)
        throw InputError(
            source.pictures.front().string(),
            fmt::format("is {} x {} pixels, but the camera of parameters.cfg makes pictures {:.4g} times as wide as high", width,
                        height, *source.aspect));
    const ViewGrid grid = placed(source, wish, place, source.aspect.value_or(double(width) / height), notes);
    require_views_memory(source, source.views() + source.depths.size(), width, height);
    for (std::size_t k = views.size(); k < source.pictures.size(); ++k) {
        if (job.cancelled()) return {};
        views.push_back(read_image(source.pictures[k], Encoding::srgb));
        if (views.back().width != width || views.back().height != height)
            throw InputError(source.pictures[k].string(),
                             fmt::format("is {} x {} pixels, {} is {} x {}; all views must have one size", views.back().width,
                                         views.back().height, source.pictures.front().filename().string(), width, height));
        job.advance(1);
    }
    const double step_mm = step_of(grid);
    std::vector<KappaMap> maps;
    for (const std::filesystem::path& depth : source.depths) {
        if (job.cancelled()) return {};
        maps.emplace_back();
        if (!depth.empty()) {
            if (holds_codes(depth))
                throw InputError(depth.string(),
                                 "has codes from 0 to white; give a depth map of numbers: .exr, .pfm, or .npy of floats");
            const Image values = read_image(depth, Encoding::linear);
            if (std::abs(std::int64_t(values.width) * height - std::int64_t(values.height) * width) > std::max(width, height))
                throw InputError(depth.string(), fmt::format("is {} x {} pixels, whose aspect is not that of the views, {} x {}",
                                                             values.width, values.height, width, height));
            maps.back() = kappa_map(source, values, grid, step_mm);
        }
        job.advance(1);
    }
    const OrderDoubt doubt = order_doubt(grid, views, maps);
    return ReadViews{LightField(grid, std::move(views), std::move(maps)), doubt, width, height, std::move(notes)};
}

}  // namespace lfdsim
