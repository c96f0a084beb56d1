#include "content/pictures/light_field.h"

#include "base/counted.h"
#include "image/scaled.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lfdsim {
namespace {

/// The two pixels around a position along one axis, and the share of the second.
struct PixelPair {
    int low, high;
    float share;
};
PixelPair neighbours(float place, int size) {
    const float at = std::clamp(place - 0.5f, 0.f, float(size - 1));
    const int low = int(at);
    return {low, std::min(low + 1, size - 1), at - float(low)};
}

void bilinear(const Image& image, float x, float y, float light[3]) {
    const PixelPair column = neighbours(x, image.width), row = neighbours(y, image.height);
    const float* const a = image.at(column.low, row.low);
    const float* const b = image.at(column.high, row.low);
    const float* const c = image.at(column.low, row.high);
    const float* const d = image.at(column.high, row.high);
    for (int k = 0; k < 3; ++k) {
        const float above = a[k] + (b[k] - a[k]) * column.share, below = c[k] + (d[k] - c[k]) * column.share;
        light[k] = above + (below - above) * row.share;
    }
}

/// Returns the index of the interval of ascending or descending positions that contains `at`; the first or the last one beyond
/// their ends.
std::size_t part_of(const std::vector<double>& places, double at, bool rising) {
    std::size_t low = 0, high = places.size() - 1;
    while (low + 1 < high) {
        const std::size_t middle = (low + high) / 2;
        ((rising ? places[middle] <= at : places[middle] >= at) ? low : high) = middle;
    }
    return low;
}

}  // namespace

ViewPyramid::ViewPyramid(Image image) {
    levels_.push_back(std::move(image));
    while (levels_.back().width > 1 || levels_.back().height > 1)
        levels_.push_back(scaled(levels_.back(), (levels_.back().width + 1) / 2, (levels_.back().height + 1) / 2));
}

void ViewPyramid::sample(float x, float y, float width, float light[3]) const {
    const float level = std::min(std::log2(std::max(width, 1.f)), float(levels_.size() - 1));
    const auto below = std::size_t(level);
    const auto at = [&](std::size_t l, float* to) {
        const Image &base = levels_.front(), &image = levels_[l];
        bilinear(image, x * float(image.width) / float(base.width), y * float(image.height) / float(base.height), to);
    };
    at(below, light);
    const float share = level - float(below);
    if (share == 0) return;
    float coarse[3];
    at(below + 1, coarse);
    for (int c = 0; c < 3; ++c) light[c] += (coarse[c] - light[c]) * share;
}

LightField::LightField(ViewGrid grid, std::vector<Image> views, std::vector<KappaMap> maps)
    : grid_(std::move(grid)), maps_(std::move(maps)) {
    if (std::vector<Problem> faults = faults_of(grid_); !faults.empty()) throw InputError(std::move(faults));
    if (views.size() != grid_.views() || (!maps_.empty() && maps_.size() != grid_.views()))
        throw InputError("views", fmt::format("{} and {} for {}", counted(views.size(), "picture"),
                                              counted(maps_.size(), "depth map"), counted(grid_.views(), "camera")));
    for (std::size_t k = 0; k < views.size(); ++k)
        if (views[k].width < 1 || views[k].width != views[0].width || views[k].height != views[0].height)
            throw InputError(fmt::format("view {}", k), fmt::format("is {} x {} pixels, the first is {} x {}", views[k].width,
                                                                    views[k].height, views[0].width, views[0].height));
    pixels_per_mm_[0] = float(views[0].width / grid_.width_mm);
    pixels_per_mm_[1] = float(views[0].height / grid_.height_mm);
    views_.reserve(views.size());
    for (Image& view : views) views_.emplace_back(std::move(view));

    column_x_.resize(std::size_t(grid_.columns));
    row_y_.resize(std::size_t(grid_.rows));
    for (int j = 0; j < grid_.rows; ++j)
        for (int i = 0; i < grid_.columns; ++i) {
            column_x_[std::size_t(i)] += grid_.camera(i, j)[0] / grid_.rows;
            row_y_[std::size_t(j)] += grid_.camera(i, j)[1] / grid_.columns;
        }
    // A pixel of a view is 1/pixels_per_mm wide in the plane of the focus, and a point moves by kappa times the cameras' step.
    const double step = grid_.columns > 1 ? (column_x_.back() - column_x_.front()) / (grid_.columns - 1)
                        : grid_.rows > 1  ? (row_y_.front() - row_y_.back()) / (grid_.rows - 1)
                                          : grid_.distance_mm;
    disparity_tolerance_ = float(1 / (step * double(pixels_per_mm_[0])));

    // The range of kappa, and the map nearest to the middle
    furthest_ = std::numeric_limits<float>::max();
    nearest_ = -furthest_;
    double from_middle = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < maps_.size(); ++k) {
        if (maps_[k].kappa.empty()) continue;
        by_depth_ = true;
        const auto& [x, y] = grid_.camera_mm[k];
        if (x * x + y * y < from_middle) from_middle = x * x + y * y, only_map_ = k;
        for (const float kappa : maps_[k].kappa)
            if (std::isfinite(kappa)) furthest_ = std::min(furthest_, kappa), nearest_ = std::max(nearest_, kappa);
    }
    if (nearest_ < furthest_) nearest_ = furthest_ = 0;  // no map has a point
    for (KappaMap& map : maps_)
        for (float& kappa : map.kappa)
            if (!std::isfinite(kappa)) kappa = furthest_;  // where nothing is, a wall behind everything
}

/// The camera (i, j) to the upper left, and the shares of the right and the lower ones.
struct LightField::Cell {
    int i, j;
    float s, t;
};

// Cameras may be unevenly spaced: (s, t) is the point between four of them whose bilinear mean is the line's position, by
// Newton's method, in the cell in which both are within 0 to 1.
bool LightField::cell_of(const FieldLine& line, Cell& cell) const {
    const double x = double(line.camera_x), y = double(line.camera_y);
    const int columns = grid_.columns, rows = grid_.rows;
    int i = columns > 1 ? int(part_of(column_x_, x, true)) : 0, j = rows > 1 ? int(part_of(row_y_, y, false)) : 0;
    double s = 0, t = 0;
    for (int moves = 0; moves < 4; ++moves) {
        const auto& a = grid_.camera(i, j);
        if (rows == 1 && columns == 1) break;
        if (rows == 1) {
            s = (x - a[0]) / (grid_.camera(i + 1, j)[0] - a[0]);
        } else if (columns == 1) {
            t = (y - a[1]) / (grid_.camera(i, j + 1)[1] - a[1]);
        } else {
            // The mean is a + s b + t c + s t e.
            const auto &b = grid_.camera(i + 1, j), &c = grid_.camera(i, j + 1), &d = grid_.camera(i + 1, j + 1);
            const double bx = b[0] - a[0], by = b[1] - a[1], cx = c[0] - a[0], cy = c[1] - a[1], ex = d[0] - b[0] - cx,
                         ey = d[1] - b[1] - cy;
            s = t = 0;
            for (int k = 0; k < 4; ++k) {
                const double fx = a[0] + s * bx + t * cx + s * t * ex - x, fy = a[1] + s * by + t * cy + s * t * ey - y;
                const double sx = bx + t * ex, sy = by + t * ey, tx = cx + s * ex, ty = cy + s * ey, det = sx * ty - sy * tx;
                if (fx == 0 && fy == 0) break;
                s -= (fx * ty - fy * tx) / det;
                t -= (sx * fy - sy * fx) / det;
            }
        }
        const int right = columns > 1 ? int(s > 1 && i + 2 < columns) - int(s < 0 && i > 0) : 0,
                  down = rows > 1 ? int(t > 1 && j + 2 < rows) - int(t < 0 && j > 0) : 0;
        if (right == 0 && down == 0) break;
        i += right;
        j += down;
    }
    // A camera shows the lines that are nearer to it than to other cameras, the outermost ones for half a step beyond them,
    // where the elemental images of a display for quilts end: rounding in single precision must not cut these.
    constexpr double beyond = 0.5001;
    if (!(s >= -beyond && s <= 1 + beyond && t >= -beyond && t <= 1 + beyond)) return false;
    cell = {i, j, float(std::clamp(s, 0., 1.)), float(std::clamp(t, 0., 1.))};
    return true;
}

// Along the line, from the viewer's side on, a camera sees the line's points in the plane of the focus at X = F + kappa (C - c),
// linear in kappa. The line meets the scene where kappa falls below that of the map there. Where it does so in a leap, the line
// passes behind something that this camera sees, and may emerge again.
bool LightField::surface(const KappaMap& map, const std::array<double, 2>& camera, const FieldLine& line, float& kappa) const {
    constexpr int most_steps = 512;
    const float dx = grid_.columns > 1 ? line.camera_x - float(camera[0]) : 0,
                dy = grid_.rows > 1 ? line.camera_y - float(camera[1]) : 0;
    const float per_x = float(map.width / grid_.width_mm), per_y = float(map.height / grid_.height_mm);
    const float pixels = std::hypot(dx * per_x, dy * per_y);  // of the map, for each unit of kappa
    const auto of_map = [&](float k) {
        const float x = (line.focus_x + dx * k) * per_x + 0.5f * float(map.width),
                    y = 0.5f * float(map.height) - (line.focus_y + dy * k) * per_y;
        const PixelPair column = neighbours(x, map.width), row = neighbours(y, map.height);
        const float a = map.at(column.low, row.low), b = map.at(column.high, row.low), c = map.at(column.low, row.high),
                    d = map.at(column.high, row.high);
        const auto [low, high] = std::minmax({a, b, c, d});
        // Between two surfaces the nearer texel counts: no surface is half-way.
        if (high - low > disparity_tolerance_)
            return map.at(column.share < 0.5f ? column.low : column.high, row.share < 0.5f ? row.low : row.high);
        const float above = a + (b - a) * column.share, below = c + (d - c) * column.share;
        return above + (below - above) * row.share;
    };
    const float range = nearest_ - furthest_;
    const int steps = int(std::clamp(std::ceil(2 * pixels * range), 1.f, float(most_steps)));
    const float leap = std::max(2 * range / float(steps), disparity_tolerance_);
    float before = nearest_, over_before = std::max(0.f, nearest_ - of_map(nearest_));
    // The line starts on a surface, or moves by less than half a pixel of the map over the whole range.
    if (over_before == 0 || pixels * range < 0.5f) return kappa = of_map(nearest_), true;
    for (int n = 1; n <= steps; ++n) {
        const float k = n == steps ? furthest_ : nearest_ - range * float(n) / float(steps), over = k - of_map(k);
        if (over_before > 0 && over <= 0 && over_before - over <= leap)
            return kappa = before + (k - before) * over_before / (over_before - over), true;
        before = k;
        over_before = over;
    }
    kappa = furthest_;
    return false;
}

bool LightField::read(std::size_t view, const FieldLine& line, float kappa, const Width& width, float light[3]) const {
    const auto& camera = grid_.camera_mm[view];
    const float x = line.focus_x + (grid_.columns > 1 ? (line.camera_x - float(camera[0])) * kappa : 0),
                y = line.focus_y + (grid_.rows > 1 ? (line.camera_y - float(camera[1])) * kappa : 0);
    const ViewPyramid& picture = views_[view];
    const float column = x * pixels_per_mm_[0] + 0.5f * float(picture.width()),
                row = 0.5f * float(picture.height()) - y * pixels_per_mm_[1];
    const float beyond[2] = {float(grid_.border_mm) * pixels_per_mm_[0], float(grid_.border_mm) * pixels_per_mm_[1]};
    if (!(column >= -beyond[0] && column <= float(picture.width()) + beyond[0] && row >= -beyond[1] &&
          row <= float(picture.height()) + beyond[1]))
        return false;
    // z = B kappa/(1 + kappa)
    const float z = float(grid_.distance_mm) * kappa / (1 + kappa);
    // Projected from the camera onto the focus, the width is B/(B - z) = 1 + kappa times as large.
    const float seen_mm = width.per_mm * std::abs(z - width.waist_z_mm) * (1 + kappa);
    picture.sample(column, row, seen_mm * std::max(pixels_per_mm_[0], pixels_per_mm_[1]), light);
    return true;
}

LightField::Answer LightField::light(const FieldLine& line, const Width& width, float light[3]) const {
    std::fill_n(light, 3, 0.f);
    Cell cell{};
    if (!cell_of(line, cell)) return Answer::beside_cameras;
    struct {
        std::size_t view;
        float weight, kappa;
        bool found;
    } around[4];
    int count = 0;
    for (int k = 0; k < 4; ++k) {
        const float weight = (k & 1 ? cell.s : 1 - cell.s) * (k & 2 ? cell.t : 1 - cell.t);
        if (weight > 0)
            around[count++] = {std::size_t(cell.j + (k >> 1)) * std::size_t(grid_.columns) + std::size_t(cell.i + (k & 1)), weight,
                               0, true};
    }
    if (by_depth_) {
        float front = -std::numeric_limits<float>::max(), of_only = 0;
        bool only_done = false, only_found = false, any = false;
        for (int k = 0; k < count; ++k) {
            const std::size_t view = around[k].view;
            if (!maps_[view].kappa.empty()) {
                around[k].found = surface(maps_[view], grid_.camera_mm[view], line, around[k].kappa);
            } else {
                if (!only_done) only_found = surface(maps_[only_map_], grid_.camera_mm[only_map_], line, of_only);
                only_done = true;
                around[k].found = only_found;
                around[k].kappa = of_only;
            }
            if (around[k].found) front = std::max(front, around[k].kappa), any = true;
        }
        // The nearest surface that one camera sees on the line hides what others would see behind it.
        for (int k = 0; k < count && any; ++k)
            if (!around[k].found || front - around[k].kappa > 1.5f * disparity_tolerance_) around[k].weight = 0;
    }
    float sum = 0;
    for (int k = 0; k < count; ++k) {
        float own[3];
        if (around[k].weight == 0 || !read(around[k].view, line, around[k].kappa, width, own)) continue;
        sum += around[k].weight;
        for (int c = 0; c < 3; ++c) light[c] += around[k].weight * own[c];
    }
    if (sum == 0) return Answer::beside_focus;
    if (by_depth_)  // if not, all four weights count, which add up to 1
        for (int c = 0; c < 3; ++c) light[c] /= sum;
    return Answer::seen;
}

}  // namespace lfdsim
