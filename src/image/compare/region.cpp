#include "image/compare/region.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace lfdsim {

Region Region::of(const Rect& r) { return {r.y0, std::vector<Row>(std::size_t(std::max(r.y1 - r.y0, 0)), Row{r.x0, r.x1})}; }

Region Region::polygon(std::span<const std::array<double, 2>> corners, int width, int height) {
    if (corners.size() < 3) throw std::invalid_argument("a polygon has three corners or more");
    Region region{0, std::vector<Row>(std::size_t(height), Row{0, 0})};
    for (int row = 0; row < height; ++row) {
        // A convex polygon cuts the line through a row's centres in one interval, between two of its edges.
        const double y = row + 0.5;
        double least = std::numeric_limits<double>::infinity(), most = -least;
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const auto &a = corners[k], &b = corners[(k + 1) % corners.size()];
            if ((a[1] <= y) == (b[1] <= y)) continue;
            const double x = a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
            least = std::min(least, x);
            most = std::max(most, x);
        }
        // Pixel i counts if least <= i + 0.5 < most.
        const auto column = [width](double x) { return int(std::clamp(std::ceil(x - 0.5), 0., double(width))); };
        if (least < most) region.rows[std::size_t(row)] = {column(least), column(most)};
    }
    return region;
}

std::int64_t Region::pixels() const {
    std::int64_t sum = 0;
    for (const Row& r : rows) sum += std::max(r.to - r.from, 0);
    return sum;
}

Rect Region::bounds() const {
    Rect box{};
    bool first = true;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const Row& r = rows[k];
        if (r.from >= r.to) continue;
        const int y = top + int(k);
        box = first ? Rect{r.from, y, r.to, y + 1} : Rect{std::min(box.x0, r.from), box.y0, std::max(box.x1, r.to), y + 1};
        first = false;
    }
    return box;
}

Region Region::shifted(int columns, int down) const {
    Region r = *this;
    r.top += down;
    for (Row& row : r.rows) row = {row.from + columns, row.to + columns};
    return r;
}

Region Region::intersected(const Region& other) const {
    Region r = *this;
    for (std::size_t k = 0; k < r.rows.size(); ++k) {
        const int n = top + int(k) - other.top;
        const Row with = n >= 0 && n < int(other.rows.size()) ? other.rows[std::size_t(n)] : Row{0, 0};
        r.rows[k] = {std::max(r.rows[k].from, with.from), std::min(r.rows[k].to, with.to)};
    }
    return r;
}

}  // namespace lfdsim
