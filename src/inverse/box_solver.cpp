#include "inverse/box_solver.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace lfdsim {

BoxSolver::BoxSolver(std::vector<float> start, std::vector<float> centre, std::vector<float> bound, double prior)
    : centre_(std::move(centre)), bound_(std::move(bound)), prior_(float(prior)), x_(std::move(start)), point_(x_) {}

void BoxSolver::step(const std::vector<float>& gradient) {
    constexpr std::size_t chunk = 1 << 16;
    const std::size_t chunks = (x_.size() + chunk - 1) / chunk;
    const auto for_chunks = [&](const auto& do_it) {
        tbb::parallel_for(std::size_t(0), chunks,
                          [&](std::size_t k) { do_it(k, k * chunk, std::min(x_.size(), (k + 1) * chunk)); });
    };
    // x' = clamp(y - (M'(My - t) + p (y - c)) / d). Where (y - x') . d (x' - x) > 0, the last movement leads away from the minimum.
    std::vector<double> turns(chunks, 0);
    std::vector<float> moved(x_.size());  // x' - x
    for_chunks([&](std::size_t k, std::size_t from, std::size_t to) {
        for (std::size_t j = from; j < to; ++j) {
            if (!(bound_[j] > 0)) continue;
            const float d = bound_[j] + prior_, y = point_[j];
            const float next = std::clamp(y - (gradient[j] + prior_ * (y - centre_[j])) / d, 0.f, 1.f);
            moved[j] = next - x_[j];
            turns[k] += double(y - next) * double(d) * double(moved[j]);
            x_[j] = next;
        }
    });
    // y' = x' + (t_k - 1)/t_(k+1) (x' - x), t_(k+1) = (1 + sqrt(1 + 4 t_k^2))/2; when it turns back, t = 1 and y' = x'.
    double turn = 0;
    for (const double t : turns) turn += t;
    const double next_pace = turn > 0 ? 1 : 0.5 * (1 + std::sqrt(1 + 4 * pace_ * pace_));
    const float further = turn > 0 ? 0 : float((pace_ - 1) / next_pace);
    pace_ = next_pace;
    for_chunks([&](std::size_t, std::size_t from, std::size_t to) {
        for (std::size_t j = from; j < to; ++j) point_[j] = x_[j] + further * moved[j];
    });
}

}  // namespace lfdsim
