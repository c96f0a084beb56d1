#include "analysis/resolution/slanted_edge.h"

#include "base/constants.h"
#include "base/sinc.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lfdsim {
namespace {

constexpr double bins_per_pixel = 4;
constexpr double flat_share = 0.75;  // of the reach; beyond it the window falls to 0

/// Returns the cosine of the edges' slant, by which distances along a row become distances across the edge.
double cosine(const Edges& e) { return 1 / std::sqrt(1 + e.slope * e.slope); }

/// A range of columns, `to` not included.
struct PixelSpan {
    int from, to;
};
/// Returns the pixels of a row whose centres are within the reach of an edge that crosses the row's middle at `x`.
PixelSpan reached(const Edges& e, double x, int width) {
    const double half = e.reach / cosine(e);
    const auto pixel = [&](double at) { return int(std::ceil(std::clamp(at - 0.5, 0., double(width)))); };
    return {pixel(x - half), pixel(x + half)};
}

/// Interpolates bins without light (NaN) from their neighbours. Returns whether there is any light.
bool bridge(std::vector<double>& values) {
    const auto known = [](double v) { return !std::isnan(v); };
    const auto first = std::find_if(values.begin(), values.end(), known);
    if (first == values.end()) return false;
    std::fill(values.begin(), first, *first);
    for (std::size_t last = 0, k = 0; k < values.size(); ++k) {
        if (!known(values[k])) continue;
        for (std::size_t n = last + 1; n < k; ++n)
            values[n] = values[last] + (values[k] - values[last]) * double(n - last) / double(k - last);
        last = k;
    }
    const auto end = std::find_if(values.rbegin(), values.rend(), known);
    std::fill(values.rbegin(), end, *end);
    return true;
}

}  // namespace

EdgeSpread::EdgeSpread(double reach) : reach_(reach) {
    for (std::vector<Bin>& bins : sets_) bins.resize(2 * std::size_t(std::ceil(reach * bins_per_pixel)));
}

void EdgeSpread::add(const Edges& edges, const Image& picture, const Image& white) {
    const double scale = cosine(edges) * bins_per_pixel, middle = 0.5 * double(sets_[0].size());
    for (int row = 0; row < picture.height; ++row) {
        // Each half of a picture belongs to one set.
        std::vector<Bin>& bins = sets_[std::size_t((2 * pictures_ + (2 * row >= picture.height)) % independent_sets)];
        for (const Edges::EdgeLine& line : edges.lines) {
            const double x = line.at + edges.slope * (row + 0.5);
            const PixelSpan span = reached(edges, x, picture.width);
            for (int column = span.from; column < span.to; ++column) {
                const double distance = column + 0.5 - x;
                Bin& bin = bins[std::size_t(std::clamp(std::floor(distance * scale + middle), 0., double(bins.size() - 1)))];
                for (std::size_t c = 0; c < 3; ++c) {
                    const double light = picture.at(column, row)[c], full = white.at(column, row)[c];
                    bin.light[c] += line.rising ? light : full - light;
                    bin.white[c] += full;
                }
            }
        }
    }
    ++pictures_;
}

std::array<std::vector<double>, 3> EdgeSpread::mtf(std::span<const double> frequencies, int without) const {
    const std::size_t bins = sets_[0].size();
    std::array<std::vector<double>, 3> result;
    for (std::size_t c = 0; c < 3; ++c) {
        std::vector<double> spread(bins), line;
        for (std::size_t k = 0; k < bins; ++k) {
            double light = 0, white = 0;
            for (int set = 0; set < independent_sets; ++set) {
                if (set == without) continue;
                light += sets_[std::size_t(set)][k].light[c];
                white += sets_[std::size_t(set)][k].white[c];
            }
            spread[k] = white > 0 ? light / white : nan;
        }
        if (!bridge(spread)) {
            result[c].assign(frequencies.size(), nan);
            continue;
        }
        // The window is centred where as much light is missing on the right as there is on the left.
        double middle = 0.5 * double(bins);
        for (const double light : spread) middle -= light;
        middle = std::clamp(middle / bins_per_pixel, -0.5 * reach_, 0.5 * reach_);
        // The derivative of the edge spread function, under a window that is flat and falls to 0 as a cosine
        std::vector<double> places;  // pixels from the edge
        for (std::size_t k = 0; k + 1 < bins; ++k) {
            const double d = (double(k + 1) - 0.5 * double(bins)) / bins_per_pixel;
            const double out =
                std::clamp((std::abs(d - middle) / (reach_ - std::abs(middle)) - flat_share) / (1 - flat_share), 0., 1.);
            places.push_back(d);
            line.push_back((spread[k + 1] - spread[k]) * 0.5 * (1 + std::cos(pi * out)));
        }
        for (const double f : frequencies) {
            double real = 0, imaginary = 0;
            for (std::size_t k = 0; k < line.size(); ++k) {
                real += line[k] * std::cos(2 * pi * f * places[k]);
                imaginary += line[k] * std::sin(2 * pi * f * places[k]);
            }
            const double bin = sinc(f / bins_per_pixel);  // once for the bin's width, once for the difference of two bins
            result[c].push_back(std::hypot(real, imaginary) / (bin * bin));
        }
    }
    return result;
}

double falls_below(std::span<const double> frequencies, std::span<const double> curve, double level) {
    for (std::size_t k = 1; k < curve.size(); ++k)
        if (curve[k] < level && curve[k - 1] >= level)
            return frequencies[k - 1] + (frequencies[k] - frequencies[k - 1]) * (curve[k - 1] - level) / (curve[k - 1] - curve[k]);
    return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace lfdsim
