// Lenses, random numbers and the chi-square test, for the tests of the optics and of the engine.
#pragma once
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "base/constants.h"
#include "engine/scene/traced_display.h"
#include "geometry/geometry.h"
#include "optics/trace.h"

namespace lfdsim {

/// 10 x 7 plano-convex lenses of pitch 4 mm before a panel of 160 x 112 pixels, seen from 400 mm.
inline Display example() {
    Display d;
    d.panel.pixels = {160, 112};
    d.panel.pixel_pitch_mm = 0.25;
    d.lens.kind = PlanoConvex{3, 2, 0.5, 1.5, Facing::viewer};
    d.array.count = {10, 7};
    d.array.pitch_mm = 4;
    d.array.gap_mm = 7;
    d.camera.position_mm = {0, 0, 400};
    d.camera.resolution = {160, 112};
    d.camera.frame_width_mm = 44;
    d.render.estimator = Estimator::point;
    d.render.samples = 8;
    return d;
}

/// The example with another lens, given by its surfaces from the panel's side to the viewer's.
inline Display with_surfaces(std::vector<Surface> surfaces) {
    Display d = example();
    d.lens = {SurfaceLens{std::move(surfaces)}, {}};
    d.array.pitch_mm = 12;
    d.array.gap_mm.reset();
    d.array.base_z_mm = 10;
    return d;
}

/// A camera at `distance_mm` from the panel's centre and `angle_deg` from its normal, to the viewer's right.
inline void look_from(Display& d, double angle_deg, double distance_mm) {
    d.camera.position_mm = {distance_mm * std::sin(angle_deg * degree), 0, distance_mm * std::cos(angle_deg * degree)};
}

/// Uniform numbers from a fixed seed.
class Random {
  public:
    explicit Random(unsigned seed) : engine_(seed) {}
    double operator()(double low, double high) { return low + (high - low) * double(engine_() >> 11) * 0x1p-53; }

  private:
    std::mt19937_64 engine_;
};

/// Chi-square of counts that should be equal, as a standard normal number by Wilson and Hilferty's cube root (1931), good to a few
/// hundredths at 15 degrees of freedom and more. Above `unlikely` by chance less than once in a million.
inline double chi_square(const std::vector<int>& counts) {
    double total = 0, sum = 0;
    for (int n : counts) total += n;
    const double wanted = total / double(counts.size()), freedom = double(counts.size()) - 1, spread = 2 / (9 * freedom);
    for (int n : counts) sum += (n - wanted) * (n - wanted) / wanted;
    return (std::cbrt(sum / freedom) - (1 - spread)) / std::sqrt(spread);
}
inline constexpr double unlikely = 4.9;

/// The bin of u, 0 <= u <= 1.
inline int bin(double u, int bins) { return std::clamp(int(u * bins), 0, bins - 1); }

}  // namespace lfdsim
