#include "analysis/meant_panel.h"

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

std::optional<MeantPanel::Meant> MeantPanel::at(double x_mm, double y_mm, const ChannelWeights& weights) const {
    const ChannelPixels::Place place{x_mm / pixel_mm_ + 0.5 * size_[0], 0.5 * size_[1] - y_mm / pixel_mm_};
    for (std::size_t channel = 0; channel < pixels_.size(); ++channel) {
        const double weight = pixels_.size() > 1 ? weights[channel] : std::accumulate(weights.begin(), weights.end(), 0.);
        if (weight == 0) continue;
        const auto shining = pixels_[channel].at(place);
        if (!shining) continue;  // subpixels do not overlap: the first that shines is the only one
        const auto meant = slope(shining->shown);
        if (!meant) return {};
        return Meant{weight * shining->brightness, *meant};
    }
    return {};
}

std::optional<double> MeantPanel::slope(const ChannelPixels::Place& place) const {
    const double x = (place[0] - 0.5 * size_[0]) * pixel_mm_, y = (0.5 * size_[1] - place[1]) * pixel_mm_;
    const NodalLine line = pickup_.line(x, y);
    if (!line.owned) return {};
    const Lattice<double>& lattice = pickup_.lattice();
    const double per_mm = (pickup_.scale - 1) / gap_mm_;  // 1/E
    // e C - P over g. Lenses that stand by themselves have gaps of their own: their lines' slope, seen from the middle.
    const optics::Place<double> towards =
        pickup_.irregular() ? optics::Place<double>{line.mx + line.x * per_mm, line.my + line.y * per_mm}
                            : optics::Place<double>{(line.x * pickup_.scale - x) / gap_mm_, (line.y * pickup_.scale - y) / gap_mm_};
    if (!lattice.strips) return towards.x;
    return optics::to_array(lattice, towards.x, towards.y).x /
           lattice.cos_turn;  // along the rows, which cross the strips obliquely
}

}  // namespace lfdsim
