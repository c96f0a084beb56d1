#include "image/compare/likeness.h"

#include "image/compare/ssim_window.h"

#include <tbb/parallel_for.h>
#include <array>
#include <limits>

namespace lfdsim {

double covered_share(const double (&sums)[cover_sums], std::int64_t pixels) {
    const double n = double(pixels), of_p = sums[of_photograph], variance = sums[of_photograph_squared] - of_p * of_p / n;
    return variance > 1e-9 * sums[of_photograph_squared] ? (sums[of_both] - sums[of_view] * of_p / n) / variance
                                                         : std::numeric_limits<double>::quiet_NaN();
}

Likeness likeness(Image view, float gain, const Image& photograph, const Region& screen, const Region& content) {
    for (float& light : view.rgb) light *= gain;
    const std::vector<double> values = ssim(view, photograph, std::array{screen, content});

    const Region region = screen.intersected(Region::of({0, 0, view.width, view.height}));
    std::vector<std::array<double, cover_sums>> rows(region.rows.size());
    tbb::parallel_for(std::size_t(0), rows.size(), [&](std::size_t k) {
        const int y = region.top + int(k);
        const auto a = [&](int x) { return double(luma(view.at(x, y))); };
        const auto b = [&](int x) { return double(luma(photograph.at(x, y))); };
        rows[k][of_view] = sum_of_row(region.rows[k], a);
        rows[k][of_photograph] = sum_of_row(region.rows[k], b);
        rows[k][of_both] = sum_of_row(region.rows[k], [&](int x) { return a(x) * b(x); });
        rows[k][of_photograph_squared] = sum_of_row(region.rows[k], [&](int x) { return b(x) * b(x); });
    });
    double sums[cover_sums] = {};
    for (const auto& row : rows)
        for (std::size_t k = 0; k < cover_sums; ++k) sums[k] += row[k];
    return {values[0], values[1], covered_share(sums, region.pixels())};
}

}  // namespace lfdsim
