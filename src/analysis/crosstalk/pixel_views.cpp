#include "analysis/crosstalk/pixel_views.h"

#include "analysis/core/eye_rays.h"
#include "base/constants.h"

#include <algorithm>
#include <cmath>
#include <complex>

namespace lfdsim {
namespace {

constexpr double most_views = 2e6;

/// Returns the mean of exp(2 pi i s/step) over pixels, s the slopes for which their centres are intended. Its size is 1 if the
/// centres have the same positions in all views; its phase is that position.
std::complex<double> alignment(const Panel& panel, const MeantPanel& pixels, double step) {
    const auto number = [](double choice, std::int64_t count) { return std::floor((0.5 + 0.5 * choice) * double(count)); };
    std::complex<double> sum = 0;
    int found = 0;
    for (const Choice& c : even_choices(1 << 12))
        if (const auto slope = pixels.slope_of_pixel(number(c[0], panel.pixels[0]), number(c[1], panel.pixels[1]))) {
            sum += std::polar(1., 2 * pi * *slope / step);
            ++found;
        }
    return found > 0 ? sum / double(found) : 0;
}

}  // namespace

double image_along_eyes_mm(const Display& d, const Geometry& g) {
    return theory(d, g).along[0].elemental_pitch_mm / across_share(g.lattice);
}

double viewing_zone_mm(const Display& d, const Geometry& g, double eye_mm) { return eye_mm * image_along_eyes_mm(d, g) / g.gap_mm; }

PixelViews::PixelViews(const Subject& s, const MeantPanel& pixels) : step_(s.display().panel.pixel_pitch_mm / s.geometry().gap_mm) {
    // Images are a whole number of pixels wide if images and pixels come apart by less than a pixel over the whole array.
    const double across = image_along_eyes_mm(s.display(), s.geometry()) / s.display().panel.pixel_pitch_mm,
                 nearest = std::round(across);
    const bool whole = nearest >= 1 && std::abs(across - nearest) * (s.geometry().lattice.count[0] - 1) < 1;
    const double width = std::min(whole ? nearest : across, most_views);
    // The last whole view has its middle at k + m with |k + m| + 1/2 <= width/2.
    const auto last = [&](double innermost) { return std::floor(0.5 * (width - 1) - innermost + 1e-9); };
    if (whole && std::fmod(nearest, 2) == 0) innermost_ = 0.5;
    // Centres half a step from the middles, mean of cos(2 pi (s/step - m)) < -1/2, lie near borders of views.
    const double other = 0.5 - innermost_;
    const std::complex<double> about = alignment(s.display().panel, pixels, step_);
    if ((about * std::polar(1., -2 * pi * innermost_)).real() < -0.5 && last(other) >= 0) innermost_ = other;
    if (last(innermost_) >= 0) count_ = 2 * std::int64_t(last(innermost_)) + (innermost_ > 0 ? 2 : 1);
}

std::vector<double> PixelViews::middles(std::int64_t most) const {
    const std::int64_t last = (count_ - 1) / 2, first = last + 1 - count_, stride = (count_ + most - 1) / most;
    std::vector<double> all;
    for (std::int64_t k = count_ > 0 ? first / stride * stride : 1; k <= last; k += stride) all.push_back(double(k) + innermost_);
    return all;
}

}  // namespace lfdsim
