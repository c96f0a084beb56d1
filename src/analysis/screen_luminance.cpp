#include "analysis/uniformity.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lfdsim {
namespace {

constexpr int most_parts_along = 16, rays_a_part = 1 << 14;

/// Columns and rows: of as few lenses each, the same number along both, as make no more than most_parts_along.
std::array<int, 2> parts_along(const std::array<std::int64_t, 2>& lenses) {
    const std::int64_t together = (std::max(lenses[0], lenses[1]) + most_parts_along - 1) / most_parts_along;
    return {int(std::max<std::int64_t>(lenses[0] / together, 1)), int(std::max<std::int64_t>(lenses[1] / together, 1))};
}

/// A number in [-1, 1] that chooses a lens: made to choose one of part `k` of `parts`.
double within_part(double number, int k, int parts, std::int64_t lenses) {
    const double first = double(k * lenses / parts), end = double((k + 1) * lenses / parts);
    return 2 * (first + (0.5 + 0.5 * number) * (end - first)) / double(lenses) - 1;
}

}  // namespace

int screen_luminance_parts(const Display& d) {
    const auto [columns, rows] = parts_along(d.array.count);
    return columns * rows;
}

ScreenLuminance screen_luminance(const EyeRays& rays, const Display& d, const Vec3d& eye, Parts& parts) {
    const std::array<std::int64_t, 2> lenses = d.array.count;
    const auto [columns, rows] = parts_along(lenses);
    ScreenLuminance screen{columns, rows, {}};
    screen.values.resize(std::size_t(screen.columns) * std::size_t(screen.rows));
    const int rays_each = rays_a_part * rays.more_for(eye);
    parts.run(columns * rows, [&](int part) {
        double sum = 0;
        for (Choice choice : even_choices(rays_each, std::uint32_t(part))) {
            choice[4] = within_part(choice[4], part % screen.columns, screen.columns, lenses[0]);
            choice[5] = within_part(choice[5], screen.rows - 1 - part / screen.columns, screen.rows, lenses[1]);
            sum += rays.look(eye, choice).light;
        }
        screen.values[std::size_t(part)] = sum / rays_each;
    });
    return screen;
}

double ScreenLuminance::least() const { return *std::min_element(values.begin(), values.end()); }
double ScreenLuminance::greatest() const { return *std::max_element(values.begin(), values.end()); }
double ScreenLuminance::mean() const { return std::accumulate(values.begin(), values.end(), 0.) / double(values.size()); }

double ScreenLuminance::least_inside() const {
    const auto inside = [](int k, int count) { return std::abs((k + 0.5) / count - 0.5) <= 0.4; };
    double least = greatest();
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
            if (inside(row, rows) && inside(column, columns))
                least = std::min(least, values[std::size_t(row) * std::size_t(columns) + std::size_t(column)]);
    return least;
}

PitchLuminance pitch_luminance(const EyeRays& rays, const Display& d, const Vec3d& eye, Parts& parts) {
    constexpr int side = PitchLuminance::side;
    const double pitch = d.array.pitch_mm;
    const int rays_each = rays_a_part * rays.more_for(eye);
    // From the array's centre to the axis of one of the lenses of its middle half
    const auto axis = [&](std::int64_t lenses, double number) {
        const std::int64_t first = lenses / 4, count = lenses - 2 * first;
        const std::int64_t lens = first + std::min(std::int64_t((0.5 + 0.5 * number) * double(count)), count - 1);
        return (double(lens) + 0.5 - 0.5 * double(lenses)) * pitch;
    };
    const auto cell = [](double number) { return std::size_t(std::min(int((0.5 + 0.5 * number) * side), side - 1)); };
    std::vector<std::vector<double>> sums(pitch_luminance_parts);
    parts.run(pitch_luminance_parts, [&](int part) {
        std::vector<double>& sum = sums[std::size_t(part)];
        sum.resize(side * side);
        for (const Choice& c : even_choices(rays_each, std::uint32_t(part))) {
            const Vec3d at =
                rays.point(axis(d.array.count[0], c[4]) + 0.5 * pitch * c[0], axis(d.array.count[1], c[5]) + 0.5 * pitch * c[1]);
            sum[(side - 1 - cell(c[1])) * side + cell(c[0])] += rays.look_through(eye, at, c[2], c[3]).light;
        }
    });
    // The choices are a net: as many of them lie in each of the cells.
    const double each = double(pitch_luminance_parts) * rays_each / (side * side);
    PitchLuminance luminance{std::vector<double>(side * side)};
    for (std::size_t k = 0; k < luminance.values.size(); ++k) {
        double light = 0;
        for (const std::vector<double>& sum : sums) light += sum[k];
        luminance.values[k] = light / each;
    }
    return luminance;
}

std::vector<double> PitchLuminance::profile(int axis) const {
    std::vector<double> means(side, 0);
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column)
            means[std::size_t(axis == 0 ? column : side - 1 - row)] += values[std::size_t(row * side + column)] / side;
    return means;
}

double michelson(const std::vector<double>& values) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return *high > 0 ? (*high - *low) / (*high + *low) : 0;
}

}  // namespace lfdsim
