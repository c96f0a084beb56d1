#include "base/constants.h"
#include "base/input_error.h"
#include "image/compare/blur.h"
#include "image/overlay/overlay.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <algorithm>
#include <cmath>
#include <limits>

namespace lfdsim {
namespace {

constexpr int cell_side = 8;                            // pixels; more than a blur or a misplaced corner moves light
constexpr double least_share = 0.05;                    // of the brightest cell: darker ones do not determine a gain
constexpr double least_used = 0.01, most_blur_px = 64;  // share of the screen that must not be saturated; pixels of the view

/// Mean light of a square of pixels that are on the screen and not saturated.
struct MeanSquare {
    double pixels = 0;
    std::array<double, 3> simulated{}, photograph{};
};

/// Calls visit(x) for the pixels of a row that are not saturated.
template <class Visit>
void for_used_pixels(const Aligned& photo, const Region::Row& row, int y, const Visit& visit) {
    for (int x = row.from; x < row.to; ++x)
        if (!photo.saturated[std::size_t(y) * std::size_t(photo.light.width) + std::size_t(x)]) visit(x);
}

/// Returns the squares of cell_side pixels that have pixels in use.
std::vector<MeanSquare> cells_of(const Image& simulated, const Aligned& photo) {
    const int across = (simulated.width + cell_side - 1) / cell_side, down = (simulated.height + cell_side - 1) / cell_side;
    std::vector<MeanSquare> cells(std::size_t(across) * std::size_t(down));
    for (std::size_t k = 0; k < photo.screen.rows.size(); ++k) {
        const int y = photo.screen.top + int(k);
        for_used_pixels(photo, photo.screen.rows[k], y, [&](int x) {
            MeanSquare& cell = cells[std::size_t(y / cell_side) * std::size_t(across) + std::size_t(x / cell_side)];
            ++cell.pixels;
            for (std::size_t c = 0; c < 3; ++c) {
                cell.simulated[c] += simulated.at(x, y)[c];
                cell.photograph[c] += photo.light.at(x, y)[c];
            }
        });
    }
    std::erase_if(cells, [](const MeanSquare& cell) { return cell.pixels == 0; });
    for (MeanSquare& cell : cells)
        for (std::size_t c = 0; c < 3; ++c) {
            cell.simulated[c] /= cell.pixels;
            cell.photograph[c] /= cell.pixels;
        }
    return cells;
}

struct Weighted {
    double value, weight;
};
double median(std::vector<Weighted> all) {
    std::sort(all.begin(), all.end(), [](const Weighted& a, const Weighted& b) { return a.value < b.value; });
    double half = 0;
    for (const Weighted& w : all) half += w.weight / 2;
    for (const Weighted& w : all)
        if ((half -= w.weight) <= 0) return w.value;
    return all.back().value;
}

/// Returns the slope of photograph = gain x simulation in channel c. It starts with the least sum of absolute residuals, which is
/// the weighted median of quotients; then come least squares with Tukey's weights (1 - (r/reach)^2)^2, which ignore outliers (a
/// reflection, a finger).
double gain(const std::vector<MeanSquare>& cells, std::size_t c) {
    double brightest = 0;
    for (const MeanSquare& cell : cells) brightest = std::max(brightest, cell.simulated[c]);
    std::vector<Weighted> quotients;
    for (const MeanSquare& cell : cells)
        if (cell.simulated[c] >= least_share * brightest)
            quotients.push_back({cell.photograph[c] / cell.simulated[c], cell.pixels * cell.simulated[c]});
    double slope = median(quotients);
    for (int step = 0; step < 20; ++step) {
        std::vector<Weighted> residuals;
        for (const MeanSquare& cell : cells)
            if (cell.simulated[c] >= least_share * brightest)
                residuals.push_back({std::abs(cell.photograph[c] - slope * cell.simulated[c]), cell.pixels});
        const double reach = 4.685 * 1.4826 * median(residuals);  // 1.4826 x the median is the standard deviation of normal ones
        if (reach <= 1e-9 * slope * brightest) break;             // the fit is almost exact
        double products = 0, squares = 0;
        for (const MeanSquare& cell : cells) {
            const double s = cell.simulated[c], p = cell.photograph[c], r = (p - slope * s) / reach;
            if (s < least_share * brightest || std::abs(r) >= 1) continue;
            const double weight = cell.pixels * (1 - r * r) * (1 - r * r);
            products += weight * s * p;
            squares += weight * s * s;
        }
        slope = products / squares;
    }
    return slope;
}

/// Returns the mean of the three channels of each pixel, each channel divided by its gain.
std::vector<float> gray(const Image& image, const std::array<double, 3>& gain) {
    std::vector<float> result(image.rgb.size() / 3);
    const float r = float(1 / (3 * gain[0])), g = float(1 / (3 * gain[1])), b = float(1 / (3 * gain[2]));
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = r * image.rgb[3 * i] + g * image.rgb[3 * i + 1] + b * image.rgb[3 * i + 2];
    return result;
}

/// Returns the sum of of_row(row, y) over a region, added in row order for any number of threads.
template <class OfRow>
double sum_over_rows(const Region& region, const OfRow& of_row) {
    std::vector<double> sums(region.rows.size());
    tbb::parallel_for(std::size_t(0), sums.size(), [&](std::size_t k) { sums[k] = of_row(region.rows[k], region.top + int(k)); });
    double total = 0;
    for (const double sum : sums) total += sum;
    return total;
}

/// Returns where in [0, most] a function with one minimum has it, to 0.5 % or better: brackets it by doubling from 0.5, then
/// uses golden sections. Where the job is cancelled, the result is somewhere in the bracket.
template <class Function>
double minimum(const Function& f, double most, const Job& job) {
    double low = 0, middle = 0, high = 0.5, best = f(0);
    for (double at_high = f(high); at_high < best && high < most && !job.cancelled(); at_high = f(high)) {
        best = at_high;
        low = middle;
        middle = high;
        high = std::min(2 * high, most);
    }
    constexpr double golden = 0.6180339887498949;
    double a = high - golden * (high - low), b = low + golden * (high - low), at_a = f(a), at_b = f(b);
    while (high - low > 0.005 * high && !job.cancelled()) {
        if (at_a <= at_b) {
            high = b;
            b = a;
            at_b = at_a;
            a = high - golden * (high - low);
            at_a = f(a);
        } else {
            low = a;
            a = b;
            at_a = at_b;
            b = low + golden * (high - low);
            at_b = f(b);
        }
        if (high < 0.25) return 0;  // blur() then changes nothing
    }
    return (low + high) / 2;
}

/// Returns the blur with the least squares of photograph - k x blurred view, with the best k for each blur: a blur carries light
/// across the borders of cells, so the gains of the sharp view differ from those of the blurred one. With the best k the squares
/// are p.p - (b.p)^2/(b.b), p the photograph and b the blurred view.
double fitted_blur(const Image& simulated, const Aligned& photo, const std::array<double, 3>& gain, const Job& job) {
    const std::vector<float> sharp = gray(simulated, {1, 1, 1}), seen = gray(photo.light, gain);
    const int width = simulated.width, height = simulated.height;
    const auto products = [&](const std::vector<float>& a, const std::vector<float>& b) {
        return sum_over_rows(photo.screen, [&](const Region::Row& row, int y) {
            double sum = 0;
            for_used_pixels(photo, row, y, [&](int x) {
                const std::size_t i = std::size_t(y) * std::size_t(width) + std::size_t(x);
                sum += double(a[i]) * double(b[i]);
            });
            return sum;
        });
    };
    const double of_seen = products(seen, seen);
    const auto squares = [&](double sigma) {
        std::vector<float> blurred = sharp;
        blur(blurred, width, height, 1, sigma);
        const double mixed = products(blurred, seen);
        return of_seen - mixed * mixed / products(blurred, blurred);
    };
    return minimum(squares, std::min(most_blur_px, std::min(width, height) / 8.0), job);
}

/// Returns the share of the screen's pixels that are not saturated.
double used_share(const Aligned& photo) {
    const double used = sum_over_rows(photo.screen, [&](const Region::Row& row, int y) {
        double count = 0;
        for_used_pixels(photo, row, y, [&](int) { ++count; });
        return count;
    });
    return used / double(photo.screen.pixels());
}

}  // namespace

std::array<double, 3> fit_gains(const Image& simulated, const Aligned& photo, double black) {
    if (photo.screen.pixels() == 0)
        throw InputError("", "the photograph shows no part of the screen that the view shows; check the corners");
    if (const double used = used_share(photo); used < least_used)
        throw InputError("",
                         fmt::format("the photograph is saturated on {:.1f} % of the screen; expose it less", 100 * (1 - used)));
    const std::vector<MeanSquare> cells = cells_of(simulated, photo);
    std::array<double, 3> result{};
    double sum = 0;
    int known = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        double in_view = 0, in_photograph = 0;
        for (const MeanSquare& cell : cells) {
            in_view = std::max(in_view, cell.simulated[c]);
            in_photograph = std::max(in_photograph, cell.photograph[c]);
        }
        if (in_view <= 0) continue;
        if (in_photograph > black) result[c] = gain(cells, c);
        if (!(result[c] > 0))
            throw InputError(
                "", fmt::format("the photograph's {} channel is black between the corners, the view's is not; check the corners, "
                                "or expose it more",
                                colour_of_channel[c]));
        sum += result[c];
        ++known;
    }
    if (known == 0) throw InputError("", "the view is black all over the screen; there is nothing to compare with");
    for (double& g : result)
        if (g == 0) g = sum / known;  // a colour that the view does not have
    return result;
}

Match match(const Image& simulated, const Aligned& photo, bool fit_blur, double white, double black, const Job& job) {
    // Gains, blur, and gains again for the blurred view.
    const double pixels = double(photo.screen.pixels());
    Match result{fit_gains(simulated, photo, black), 0, used_share(photo), 0, 0, 0, simulated, photo.light};
    if (fit_blur) {
        result.blur_px = fitted_blur(simulated, photo, result.gains, job);
        if (result.blur_px > 0) {
            blur(result.simulated.rgb, simulated.width, simulated.height, 3, result.blur_px);
            result.gains = fit_gains(result.simulated, photo, black);
        }
    }
    // Both in the light of the view, which is clipped where the photograph is.
    for (std::size_t i = 0; i < result.simulated.rgb.size(); ++i) {
        const double g = result.gains[i % 3];
        result.simulated.rgb[i] = float(std::min(double(result.simulated.rgb[i]), white / g));
        result.photograph.rgb[i] = float(result.photograph.rgb[i] / g);
    }
    // The figures, over the screen.
    const double squares = sum_over_rows(photo.screen, [&](const Region::Row& row, int y) {
        double sum = 0;
        for (int i = 3 * row.from; i < 3 * row.to; ++i) {
            const double difference = double(result.simulated.at(0, y)[i]) - double(result.photograph.at(0, y)[i]);
            sum += difference * difference;
        }
        return sum;
    });
    result.rmse = std::sqrt(squares / (3 * pixels));
    result.psnr_db = squares > 0 ? -20 * std::log10(result.rmse) : std::numeric_limits<double>::infinity();
    result.ssim = ssim(result.simulated, result.photograph, std::array{photo.screen}).front();
    if (std::isnan(result.ssim))
        throw InputError("",
                         fmt::format("view and photograph share {:.0f} pixels of the screen, but no square of {} x {}; check the "
                                     "corners",
                                     pixels, ssim_window, ssim_window));
    return result;
}

}  // namespace lfdsim
