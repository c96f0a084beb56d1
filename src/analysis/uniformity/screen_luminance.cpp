// Luminance over the screen and within a lens pitch. docs/measures.md, "Uniformity and efficiency".

#include "analysis/core/screen_parts.h"
#include "analysis/uniformity/uniformity.h"

#include "base/constants.h"
#include "geometry/screen.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lfdsim {
namespace {

constexpr int most_parts_along = 16, rays_a_part = 1 << 14;
// Lines count for the luminance within a pitch in this part of the panel's width and height, not at the screen's rim.
constexpr double inner_panel = 0.75;

}  // namespace

int screen_luminance_parts(const Display& d, const Geometry& g) { return ScreenParts(d, g, most_parts_along).count(); }

ScreenLuminance screen_luminance(const EyeRays& rays, const Display& d, const Geometry& g, const Vec3d& eye, Parts& parts) {
    const ScreenParts all(d, g, most_parts_along);
    ScreenLuminance screen{all.columns(), all.rows(), all.size_mm(), {}};
    screen.parts.resize(std::size_t(all.count()));
    const int rays_each = rays_a_part / independent_sets * rays.more_for(eye);
    parts.run(all.count(), [&](int part) {
        const LensBlock block = all.block(part);
        ScreenLuminance::LuminancePart& found = screen.parts[std::size_t(part)];
        double on_screen = 0;
        for (int set = 0; set < independent_sets; ++set) {
            double sum = 0, lines = 0;
            for (const Choice& choice : even_choices(rays_each, set_number(d.render.seed, independent_sets * part + set))) {
                const Sight sight = rays.look(eye, all.within(block, choice));
                sum += sight.light;
                lines += sight.on_screen;
            }
            found.light[std::size_t(set)] = lines > 0 ? sum / lines : 0;
            on_screen += lines / (double(rays_each) * independent_sets);
        }
        found.lenses = block.lenses() * on_screen;
        found.whole = on_screen >= least_on_screen;
        found.is_inner = all.is_inner(block, eye);
    });
    return screen;
}

std::vector<double> means(const std::vector<Sums>& all) {
    std::vector<double> result;
    for (const Sums& sums : all) result.push_back(total(sums) / independent_sets);
    return result;
}

std::vector<double> ScreenLuminance::values() const {
    std::vector<double> all;
    for (const LuminancePart& part : parts) all.push_back(part.whole ? total(part.light) / independent_sets : nan);
    return all;
}
double ScreenLuminance::least() const {
    double least = nan;
    for (const double value : values()) least = std::fmin(least, value);
    return least;
}
double ScreenLuminance::greatest() const {
    double greatest = nan;
    for (const double value : values()) greatest = std::fmax(greatest, value);
    return greatest;
}

Estimate ScreenLuminance::mean() const {
    Sums sums{};
    double all = 0;
    for (const LuminancePart& part : parts) {
        all += part.lenses;
        for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += part.lenses * part.light[k];
    }
    for (double& sum : sums) sum /= all;
    return estimate(sums);
}

Estimate ScreenLuminance::uniformity_percent(bool inside) const {
    Estimate least{std::numeric_limits<double>::infinity(), 0}, greatest{0, 0};
    double squares = 0, count = 0;  // of the parts' errors
    for (const LuminancePart& part : parts) {
        if (!part.whole) continue;
        const Estimate light = estimate(part.light);
        squares += light.error * light.error;
        ++count;
        if (light.value > greatest.value) greatest = light;
        if ((!inside || part.is_inner) && light.value < least.value) least = light;
    }
    if (count == 0 || std::isinf(least.value)) return {nan, nan};
    if (!(greatest.value > 0)) return {0, 0};
    // Errors of Lmin/Lmax to first order
    const double ratio = least.value / greatest.value, typical = std::sqrt(squares / count);
    const double error = std::max(least.error, typical) + ratio * std::max(greatest.error, typical);
    return {100 * ratio, 100 * error / greatest.value};
}

PitchLuminance pitch_luminance(const EyeRays& rays, const Display& d, const Geometry& g, const Vec3d& eye, Parts& parts) {
    constexpr int side = PitchLuminance::side;
    const Lattice<double>& lattice = rays.lattice();
    const int rays_each = rays_a_part * rays.more_for(eye);
    // Returns one of the columns or rows of the array's middle half.
    const auto in_middle = [&](std::size_t k, double choice) {
        const auto all = std::int64_t(lattice.count[k]), first = all / 4, count = all - 2 * first;
        return double(first + std::min(std::int64_t((0.5 + 0.5 * choice) * double(count)), count - 1));
    };
    const auto cell = [](double number) { return std::size_t(std::min(int((0.5 + 0.5 * number) * side), side - 1)); };
    // The light of a square of the lens's cell and the number of its lines.
    struct CellSum {
        double light = 0, lines = 0;
    };
    std::vector<std::vector<CellSum>> sums(pitch_luminance_parts);  // part k belongs to set k modulo their number
    const PanelBehind panel(g);
    parts.run(pitch_luminance_parts, [&](int part) {
        std::vector<CellSum>& sum = sums[std::size_t(part)];
        sum.resize(side * side);
        for (const Choice& c : even_choices(rays_each, set_number(d.render.seed, part))) {
            const auto axis = optics::axis_in_array(lattice, optics::Cell<double>{in_middle(0, c[4]), in_middle(1, c[5])});
            const double up = 0.5 * lattice.pitch[1] * c[1];
            const Vec3d at = rays.point(axis.x + lattice.half_pitch[0] * c[0], axis.y + up);
            if (!panel.meets(eye, at[0], at[1], inner_panel)) continue;
            // Along strips nothing repeats: the position is taken modulo the pitch.
            const double turns = up / lattice.pitch[0], number = lattice.strips ? 2 * (turns - std::floor(turns)) - 1 : c[1];
            CellSum& seen = sum[(side - 1 - cell(number)) * side + cell(c[0])];
            seen.light += rays.look_through(eye, at, c[2], c[3]).light;
            ++seen.lines;
        }
    });
    PitchLuminance luminance{std::vector<Sums>(side * side)};
    for (std::size_t k = 0; k < luminance.places.size(); ++k)
        for (std::size_t set = 0; set < independent_sets; ++set) {
            CellSum all;
            for (std::size_t part = set; part < sums.size(); part += independent_sets) {
                all.light += sums[part][k].light;
                all.lines += sums[part][k].lines;
            }
            luminance.places[k][set] = all.lines > 0 ? all.light / all.lines : 0;
        }
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
    // Single sets may miss the true positions by chance and give too little contrast; all sets together give too much.
    contrast.error = std::hypot(contrast.error, michelson(means(values)) - contrast.value);
    return contrast;
}

}  // namespace lfdsim
