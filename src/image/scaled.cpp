#include "image/scaled.h"

#include <tbb/parallel_for.h>
#include <algorithm>
#include <cmath>
#include <vector>

namespace lfdsim {
namespace {

/// Divides [0, from] into `to` equal parts and calls add(i, share) for each unit interval [i, i + 1] that part k covers, with the
/// share of the part that lies in it.
template <class Add>
void each_covered(int k, int from, int to, Add add) {
    const double scale = double(from) / to, begin = k * scale, end = std::min((k + 1) * scale, double(from));
    for (int i = int(begin); i < end; ++i) add(i, (std::min(i + 1., end) - std::max(double(i), begin)) / (end - begin));
}

}  // namespace

Image scaled(const Image& image, int width, int height) {
    // The mean over an area is one over columns of means over rows: first `even`, scaled across, then down.
    Image even(width, image.height), result(width, height);
    tbb::parallel_for(0, image.height, [&](int y) {
        for (int x = 0; x < width; ++x) {
            double sum[3] = {};
            each_covered(x, image.width, width, [&](int i, double share) {
                for (int c = 0; c < 3; ++c) sum[c] += share * image.at(i, y)[c];
            });
            for (int c = 0; c < 3; ++c) even.at(x, y)[c] = float(sum[c]);
        }
    });
    tbb::parallel_for(0, height, [&](int y) {
        std::vector<double> sum(std::size_t(width) * 3);
        each_covered(y, image.height, height, [&](int i, double share) {
            const float* row = even.at(0, i);
            for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += share * row[k];
        });
        std::copy(sum.begin(), sum.end(), result.at(0, y));
    });
    return result;
}

Image reduced(const Image& image, int columns) {
    if (columns < 1 || columns >= image.width) return image;
    return scaled(image, columns, std::max(1, int(std::lround(double(image.height) * columns / image.width))));
}

}  // namespace lfdsim
