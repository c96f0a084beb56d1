#include "analysis/moire/wave_sums.h"

#include "base/constants.h"
#include "base/sinc.h"

#include <cmath>

namespace lfdsim {

void WaveSums::add(const WaveSums& other) {
    for (std::size_t k = 0; k < blocks_.size(); ++k)
        for (std::size_t set = 0; set < independent_sets; ++set) blocks_[k][set] += other.blocks_[k][set];
}

std::complex<double> WaveSums::wave(const Frequency& f, int without) const {
    const double step_x = (f[0] - about_[0]) * width_ / side, step_y = (f[1] - about_[1]) * height_ / side;  // periods a block
    std::array<std::complex<double>, side> turn_x, turn_y;
    for (int k = 0; k < side; ++k) {
        turn_x[std::size_t(k)] = std::polar(1., -2 * pi * step_x * (k + 0.5 - 0.5 * side));
        turn_y[std::size_t(k)] = std::polar(1., -2 * pi * step_y * (k + 0.5 - 0.5 * side));
    }
    // Over a block the wave turns by step_x and step_y periods: its phase is that of the block's middle, and sinc makes up for
    // the average.
    std::complex<double> sum = 0;
    for (std::size_t j = 0; j < side; ++j) {
        std::complex<double> row = 0;
        for (std::size_t i = 0; i < side; ++i)
            for (int set = 0; set < independent_sets; ++set)
                if (set != without) row += blocks_[j * side + i][std::size_t(set)] * turn_x[i];
        sum += row * turn_y[j];
    }
    return sum / (double(independent_sets - (without >= 0)) * sinc(step_x) * sinc(step_y));
}

Frequency WaveSums::peak(const Frequency& from, int without) const {
    Frequency best = from;
    double most = std::abs(wave(best, without));
    // Hill climbing: a step along an axis is taken while it raises the amplitude, then steps are halved.
    for (double step = 0.5; step > finest_step; step *= 0.5)
        for (bool moved = true; moved;) {
            moved = false;
            for (const auto& [x, y] : {std::array{step, 0.}, {-step, 0.}, {0., step}, {0., -step}}) {
                const Frequency next{best[0] + x / width_, best[1] + y / height_};
                if (std::abs(next[0] - about_[0]) * width_ > 1.5 || std::abs(next[1] - about_[1]) * height_ > 1.5) continue;
                if (const double here = std::abs(wave(next, without)); here > most) {
                    best = next;
                    most = here;
                    moved = true;
                }
            }
        }
    return best;
}

}  // namespace lfdsim
