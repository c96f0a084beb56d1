#include "image/overlay/overlay.h"

#include <tbb/parallel_for.h>
#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

/// Samples a photograph at points, bilinearly between the centres of the four pixels around each.
class PhotographSampler {
  public:
    PhotographSampler(const Image& image, double saturation)
        : image_(image), saturation_(float(std::min(saturation, double(std::numeric_limits<float>::max())))) {}

    /// Adds the light at a point to sum[0..2], and returns whether one of the four pixels is saturated.
    bool add(const Point& p, float* sum) const {
        // In this order NaN, from a sample on the horizon, becomes 0.
        const double x = std::min(std::max(0.0, p[0] - 0.5), image_.width - 1.0);
        const double y = std::min(std::max(0.0, p[1] - 0.5), image_.height - 1.0);
        const int column = int(x), row = int(y);
        const float u = float(x - column), v = float(y - row);
        const std::size_t right = column + 1 < image_.width ? 3 : 0;
        const float *above = image_.at(column, row), *below = image_.at(column, std::min(row + 1, image_.height - 1));
        float most = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            const float a = above[c], b = above[c + right], d = below[c], e = below[c + right];
            most = std::max({most, a, b, d, e});
            const float top = a + u * (b - a), bottom = d + u * (e - d);
            sum[c] += top + v * (bottom - top);
        }
        return most >= saturation_;
    }

  private:
    const Image& image_;
    const float saturation_;
};

/// Reduces the region to pixels whose centres the photograph shows; in each row these are one interval.
void keep_covered(Region& region, const Homography& to_photograph, const Image& photograph) {
    const auto covered = [&](int x, int y) {
        const Point p = to_photograph(x + 0.5, y + 0.5);
        return p[0] >= 0 && p[1] >= 0 && p[0] <= photograph.width && p[1] <= photograph.height;
    };
    for (std::size_t k = 0; k < region.rows.size(); ++k) {
        Region::Row& row = region.rows[k];
        const int y = region.top + int(k);
        while (row.from < row.to && !covered(row.from, y)) ++row.from;
        while (row.from < row.to && !covered(row.to - 1, y)) --row.to;
    }
}

/// Returns the number of samples along a side of a pixel with which they are at most one pixel of the photograph apart, 64 at most.
int samples_along(const Point& derivative) {
    constexpr double most = 64;
    return int(std::clamp(std::ceil(std::hypot(derivative[0], derivative[1]) - 1e-9), 1.0, most));
}

}  // namespace

Aligned align(const Image& photograph, const Corners& in_photograph, int view_width, int view_height, const Corners& in_view,
              double saturation, std::optional<Rect> part, const Job& job) {
    const Homography to_photograph(in_view, in_photograph);
    Aligned result{Image(view_width, view_height), Region::polygon(in_view, view_width, view_height), {}};
    result.saturated.resize(std::size_t(view_width) * std::size_t(view_height));
    if (part) result.screen = result.screen.intersected(Region::of(*part));
    keep_covered(result.screen, to_photograph, photograph);

    const PhotographSampler sampler(photograph, saturation);
    tbb::parallel_for(std::size_t(0), result.screen.rows.size(), [&](std::size_t k) {
        if (job.cancelled()) return;
        const Region::Row& row = result.screen.rows[k];
        const int y = result.screen.top + int(k);
        for (int x = row.from; x < row.to; ++x) {
            const auto [along_x, along_y] = to_photograph.derivatives(x + 0.5, y + 0.5);
            const int columns = samples_along(along_x), rows = samples_along(along_y);
            float sum[3] = {};
            bool saturated = false;
            for (int j = 0; j < rows; ++j)
                for (int i = 0; i < columns; ++i)
                    saturated |= sampler.add(to_photograph(x + (i + 0.5) / columns, y + (j + 0.5) / rows), sum);
            float* pixel = result.light.at(x, y);
            for (int c = 0; c < 3; ++c) pixel[c] = sum[c] / float(columns * rows);
            result.saturated[std::size_t(y) * std::size_t(view_width) + std::size_t(x)] = saturated;
        }
    });
    return result;
}

}  // namespace lfdsim
