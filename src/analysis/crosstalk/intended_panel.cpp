#include "analysis/crosstalk/intended_panel.h"

#include "analysis/core/eye_rays.h"
#include "base/constants.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lfdsim {
namespace {

Display with_sampling(Display d, ContentSampling sampling) {
    d.content.sampling = sampling;
    return d;
}

}  // namespace

MeantPanel::MeantPanel(const Display& d, const Geometry& g, ContentSampling sampling)
    : pickup_(d, g),
      size_{double(d.panel.pixels[0]), double(d.panel.pixels[1])},
      pixel_mm_(d.panel.pixel_pitch_mm),
      gap_mm_(g.gap_mm) {
    const Display made = with_sampling(d, sampling);
    const std::size_t channels = d.panel.subpixels == SubpixelLayout::none ? 1 : 3;
    for (std::size_t channel = 0; channel < channels; ++channel) pixels_.emplace_back(made, channel);
}

void MeantPanel::ViewerSlopes::add(double slope) {
    constexpr double rounding = 1e-9;
    const auto same = [&](double other) { return std::isnan(slope) ? std::isnan(other) : std::abs(other - slope) <= rounding; };
    if (count_ < slopes_.size() && std::ranges::none_of(all(), same)) slopes_[count_++] = slope;
}

std::optional<MeantPanel::ShiningPoint> MeantPanel::at(double x_mm, double y_mm, const ChannelWeights& weights) const {
    const ChannelPixels::Place place{x_mm / pixel_mm_ + 0.5 * size_[0], 0.5 * size_[1] - y_mm / pixel_mm_};
    for (std::size_t channel = 0; channel < pixels_.size(); ++channel) {
        const double weight = pixels_.size() > 1 ? weights[channel] : std::accumulate(weights.begin(), weights.end(), 0.);
        if (weight == 0) continue;
        const auto shining = pixels_[channel].at(place);
        if (!shining) continue;  // subpixels do not overlap: the first that emits is the only one
        // Pitches are given to a nanometre, so that a border n lenses from the middle is known to n/2 nanometres.
        const Point shown = mm(shining->shown);
        const ViewerSlopes found = slopes(shown, 0.5e-6 * (1 + std::hypot(shown[0], shown[1]) / pickup_.lattice().pitch[0]));
        if (std::ranges::all_of(found.all(), [](double slope) { return std::isnan(slope); })) return {};
        return ShiningPoint{weight * shining->brightness, found};
    }
    return {};
}

double MeantPanel::share_on_borders() const {
    constexpr double near_pixels = 0.02;
    double all = 0, on_borders = 0;
    for (const Choice& c : even_choices(1 << 12))
        for (const ChannelPixels& pixels : pixels_) {
            const auto shining = pixels.at({(0.5 + 0.5 * c[0]) * size_[0], (0.5 + 0.5 * c[1]) * size_[1]});
            if (!shining) continue;
            const ViewerSlopes found = slopes(mm(shining->shown), near_pixels * pixel_mm_);
            const auto lenses = std::ranges::count_if(found.all(), [](double slope) { return !std::isnan(slope); });
            if (lenses > 0) all += shining->brightness;
            if (lenses > 1) on_borders += shining->brightness;
        }
    return all > 0 ? on_borders / all : 0;
}

MeantPanel::ViewerSlopes MeantPanel::slopes(const Point& point, double margin) const {
    ViewerSlopes found(slope(point));
    if (!pickup_.near_border(point[0], point[1], margin)) return found;
    // The owners of points around, on the other sides of the borders
    constexpr int directions = 8;
    for (int k = 0; k < directions; ++k) {
        const double turn = 2 * pi * k / directions;
        found.add(slope({point[0] + 2 * margin * std::cos(turn), point[1] + 2 * margin * std::sin(turn)}));
    }
    return found;
}

double MeantPanel::slope(const Point& point) const {
    const auto [x, y] = point;
    const NodalLine line = pickup_.line(x, y);
    if (!line.owned) return nan;
    const Lattice<double>& lattice = pickup_.lattice();
    const double per_mm = (pickup_.scale - 1) / gap_mm_;  // 1/E
    // The slope is (e C - P)/g. Misaligned lenses have different gaps: the slope of their line through R, seen from the screen's
    // middle, is m + R/E.
    const optics::Vec2<double> towards =
        pickup_.irregular() ? optics::Vec2<double>{line.mx + line.x * per_mm, line.my + line.y * per_mm}
                            : optics::Vec2<double>{(line.x * pickup_.scale - x) / gap_mm_, (line.y * pickup_.scale - y) / gap_mm_};
    if (!lattice.strips) return towards.x;
    // Along the line of eyes, which crosses the strips obliquely
    return optics::to_array(lattice, towards.x, towards.y).x / across_strips(lattice);
}

}  // namespace lfdsim
