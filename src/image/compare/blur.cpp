#include "image/compare/blur.h"

#include <tbb/parallel_for.h>
#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

/// Returns the weights of the distances 0, 1, ... up to 4 sigma; those of both sides sum to 1.
std::vector<float> half_gaussian(double sigma) {
    std::vector<double> weights(1, 1.0);
    double sum = 1;
    for (int k = 1; k <= 4 * sigma; ++k) {
        weights.push_back(std::exp(-0.5 * k * k / (sigma * sigma)));
        sum += 2 * weights.back();
    }
    std::vector<float> result;
    for (const double w : weights) result.push_back(float(w / sum));
    return result;
}

}  // namespace

void blur(std::vector<float>& values, int columns, int rows, int channels, double sigma) {
    const std::vector<float> weights = half_gaussian(sigma);
    const int reach = int(weights.size()) - 1;
    if (reach == 0) return;
    const std::size_t row_length = std::size_t(columns) * std::size_t(channels);

    // The Gaussian is a product of one across and one down: first across, each row with repeated pixels at its ends, then down.
    std::vector<float> across(values.size());
    tbb::parallel_for(0, rows, [&](int row) {
        const float* from = &values[std::size_t(row) * row_length];
        float* to = &across[std::size_t(row) * row_length];
        std::vector<float> padded(row_length + 2 * std::size_t(reach) * std::size_t(channels));
        for (int x = -reach; x < columns + reach; ++x)
            std::copy_n(from + std::clamp(x, 0, columns - 1) * channels, channels, &padded[std::size_t((x + reach) * channels)]);
        const float* middle = &padded[std::size_t(reach * channels)];
        for (std::size_t i = 0; i < row_length; ++i) to[i] = weights[0] * middle[i];
        for (int k = 1; k <= reach; ++k) {
            const float *left = middle - k * channels, *right = middle + k * channels, w = weights[std::size_t(k)];
            for (std::size_t i = 0; i < row_length; ++i) to[i] += w * (left[i] + right[i]);
        }
    });
    tbb::parallel_for(0, rows, [&](int row) {
        const auto source = [&](int r) { return &across[std::size_t(std::clamp(r, 0, rows - 1)) * row_length]; };
        float* to = &values[std::size_t(row) * row_length];
        const float* middle = source(row);
        for (std::size_t i = 0; i < row_length; ++i) to[i] = weights[0] * middle[i];
        for (int k = 1; k <= reach; ++k) {
            const float *above = source(row - k), *below = source(row + k), w = weights[std::size_t(k)];
            for (std::size_t i = 0; i < row_length; ++i) to[i] += w * (above[i] + below[i]);
        }
    });
}

}  // namespace lfdsim
