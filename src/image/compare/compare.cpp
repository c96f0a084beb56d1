#include "image/compare/compare.h"

#include "base/input_error.h"
#include "image/compare/region.h"
#include "image/compare/ssim.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <array>
#include <cmath>
#include <limits>

namespace lfdsim {
namespace {

struct RowDifference {
    double squares = 0, max = -1;
    int column = 0, channel = 0;
};

// Fills all figures but SSIM. Sums are made row by row in order, so that the number of threads changes no bit.
void compare_light(const Image& a, const Image& b, const Rect& region, Comparison& result) {
    std::vector<RowDifference> rows(std::size_t(region.y1 - region.y0));
    tbb::parallel_for(region.y0, region.y1, [&](int y) {
        RowDifference& row = rows[std::size_t(y - region.y0)];
        const float *pa = a.at(region.x0, y), *pb = b.at(region.x0, y);
        for (int i = 0; i < (region.x1 - region.x0) * 3; ++i) {
            const double difference = std::abs(double(pa[i]) - double(pb[i]));
            row.squares += difference * difference;
            if (difference > row.max) {
                row.max = difference;
                row.column = region.x0 + i / 3;
                row.channel = i % 3;
            }
        }
    });
    double squares = 0;
    result.max_difference = -1;
    for (std::size_t r = 0; r < rows.size(); ++r) {
        squares += rows[r].squares;
        if (rows[r].max <= result.max_difference) continue;
        result.max_difference = rows[r].max;
        result.max_column = rows[r].column;
        result.max_row = region.y0 + int(r);
        result.max_channel = rows[r].channel;
    }
    result.rmse = std::sqrt(squares / (3.0 * double(region.x1 - region.x0) * double(rows.size())));
    result.psnr_db = squares > 0 ? -20 * std::log10(result.rmse) : std::numeric_limits<double>::infinity();
}

}  // namespace

Comparison compare(const Image& a, const Image& b, std::optional<Rect> wanted) {
    if (a.width != b.width || a.height != b.height)
        throw InputError("", fmt::format("the pictures are {} x {} and {} x {} pixels; only equal sizes can be compared", a.width,
                                         a.height, b.width, b.height));
    const Rect region = wanted.value_or(Rect{0, 0, a.width, a.height});
    if (region.x0 < 0 || region.y0 < 0 || region.x1 > a.width || region.y1 > a.height)
        throw InputError("", fmt::format("the region {},{},{},{} exceeds the picture of {} x {} pixels", region.x0, region.y0,
                                         region.x1, region.y1, a.width, a.height));
    const int columns = region.x1 - region.x0, rows = region.y1 - region.y0;
    if (columns < ssim_window || rows < ssim_window)
        throw InputError("", fmt::format("{} x {} pixels are too few to compare; at least {} x {} are needed", columns, rows,
                                         ssim_window, ssim_window));
    Comparison result{};
    result.ssim = ssim(a, b, std::array{Region::of(region)}).front();
    compare_light(a, b, region, result);
    return result;
}

}  // namespace lfdsim
