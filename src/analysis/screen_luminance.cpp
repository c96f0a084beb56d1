#include "analysis/screen_parts.h"
#include "analysis/uniformity.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lfdsim {
namespace {

constexpr int most_parts_along = 16, rays_a_part = 1 << 14;

}  // namespace

int screen_luminance_parts(const Display& d) { return ScreenParts(d, most_parts_along).count(); }

ScreenLuminance screen_luminance(const EyeRays& rays, const Display& d, const Vec3d& eye, Parts& parts) {
    const ScreenParts all(d, most_parts_along);
    ScreenLuminance screen{all.columns(), all.rows(), {}, {}};
    screen.parts.resize(std::size_t(all.count()));
    for (int k = 0; k < all.count(); ++k) screen.lenses.push_back(all.block(k).lenses());
    const int rays_each = rays_a_part / independent_sets * rays.more_for(eye);
    parts.run(all.count(), [&](int part) {
        const LensBlock block = all.block(part);
        for (int set = 0; set < independent_sets; ++set) {
            double sum = 0;
            for (const Choice& choice : even_choices(rays_each, set_number(d.render.seed, independent_sets * part + set)))
                sum += rays.look(eye, all.within(block, choice)).light;
            screen.parts[std::size_t(part)][std::size_t(set)] = sum / rays_each;
        }
    });
    return screen;
}

std::vector<double> means(const std::vector<Sums>& all) {
    std::vector<double> result;
    for (const Sums& sums : all) result.push_back(total(sums) / independent_sets);
    return result;
}

std::vector<double> ScreenLuminance::values() const { return means(parts); }
double ScreenLuminance::least() const { return std::ranges::min(values()); }
double ScreenLuminance::greatest() const { return std::ranges::max(values()); }

Estimate ScreenLuminance::mean() const {
    Sums sums{};
    double all = 0;
    for (std::size_t part = 0; part < parts.size(); ++part) {
        all += lenses[part];
        for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += lenses[part] * parts[part][k];
    }
    for (double& sum : sums) sum /= all;
    return estimate(sums);
}

Estimate ScreenLuminance::uniformity_percent(bool inside) const {
    const auto counts = [&](std::size_t part) {
        const auto central = [](int k, int count) { return std::abs((k + 0.5) / count - 0.5) <= 0.4; };
        return !inside || (central(int(part) / columns, rows) && central(int(part) % columns, columns));
    };
    Estimate least{std::numeric_limits<double>::infinity(), 0}, greatest{0, 0};
    double squares = 0;  // of the parts' errors
    for (std::size_t k = 0; k < parts.size(); ++k) {
        const Estimate part = estimate(parts[k]);
        squares += part.error * part.error / double(parts.size());
        if (part.value > greatest.value) greatest = part;
        if (counts(k) && part.value < least.value) least = part;
    }
    if (!(greatest.value > 0)) return {0, 0};
    const double ratio = least.value / greatest.value, typical = std::sqrt(squares);
    const double error = std::max(least.error, typical) + ratio * std::max(greatest.error, typical);
    return {100 * ratio, 100 * error / greatest.value};
}

PitchLuminance pitch_luminance(const EyeRays& rays, const Display& d, const Vec3d& eye, Parts& parts) {
    constexpr int side = PitchLuminance::side;
    const Lattice<double>& lattice = rays.lattice();
    const int rays_each = rays_a_part * rays.more_for(eye);
    // One of the columns or rows of the array's middle half
    const auto in_middle = [&](std::size_t k, double choice) {
        const auto all = std::int64_t(lattice.count[k]), first = all / 4, count = all - 2 * first;
        return double(first + std::min(std::int64_t((0.5 + 0.5 * choice) * double(count)), count - 1));
    };
    const auto cell = [](double number) { return std::size_t(std::min(int((0.5 + 0.5 * number) * side), side - 1)); };
    std::vector<std::vector<double>> sums(pitch_luminance_parts);  // part k is of set k modulo their number
    parts.run(pitch_luminance_parts, [&](int part) {
        std::vector<double>& sum = sums[std::size_t(part)];
        sum.resize(side * side);
        for (const Choice& c : even_choices(rays_each, set_number(d.render.seed, part))) {
            const auto axis = optics::axis_in_array(lattice, optics::Cell<double>{in_middle(0, c[4]), in_middle(1, c[5])});
            const Vec3d at = rays.point(axis.x + lattice.half_pitch[0] * c[0], axis.y + 0.5 * lattice.pitch[1] * c[1]);
            sum[(side - 1 - cell(c[1])) * side + cell(c[0])] += rays.look_through(eye, at, c[2], c[3]).light;
        }
    });
    // The choices are a net: equally many of them lie in each cell.
    const double each = double(pitch_luminance_parts) / independent_sets * rays_each / (side * side);
    PitchLuminance luminance{std::vector<Sums>(side * side)};
    for (std::size_t part = 0; part < sums.size(); ++part)
        for (std::size_t k = 0; k < sums[part].size(); ++k) luminance.places[k][part % independent_sets] += sums[part][k] / each;
    return luminance;
}

std::vector<double> PitchLuminance::values() const { return means(places); }

std::vector<Sums> PitchLuminance::profile(int axis) const {
    std::vector<Sums> along(side, Sums{});
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column)
            for (std::size_t k = 0; k < independent_sets; ++k)
                along[std::size_t(axis == 0 ? column : side - 1 - row)][k] += places[std::size_t(row * side + column)][k] / side;
    return along;
}

double michelson(const std::vector<double>& values) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return *high > 0 ? (*high - *low) / (*high + *low) : 0;
}

Estimate michelson(const std::vector<Sums>& values) {
    Sums found{};
    for (int set = 0; set < independent_sets; ++set) {
        const auto [low, high] = std::ranges::minmax_element(values, {}, [&](const Sums& v) { return total(v, set); });
        const double least = (*low)[std::size_t(set)], greatest = (*high)[std::size_t(set)];
        found[std::size_t(set)] = greatest + least > 0 ? (greatest - least) / (greatest + least) : 0;
    }
    Estimate contrast = estimate(found);
    contrast.value = std::clamp(contrast.value, 0., 1.);
    // Sets that miss the true places by chance give too little contrast, all sets together too much.
    contrast.error = std::hypot(contrast.error, michelson(means(values)) - contrast.value);
    return contrast;
}

}  // namespace lfdsim
