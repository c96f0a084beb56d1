#include "analysis/core/channel_pixels.h"

#include "base/constants.h"
#include "base/sinc.h"
#include "content/pickup/shown_points.h"

#include <algorithm>
#include <cmath>

namespace lfdsim {

bool has_colours(const Display& d) { return d.panel.subpixels != SubpixelLayout::none || disperses(d); }

std::vector<LightPath> light_paths(const Display& d, const Geometry& green, std::size_t channel) {
    if (!disperses(d)) return {{green, 1}};
    std::vector<LightPath> all;
    for (const Node& node : wavelengths_of(d, int(channel))) all.push_back({resolve(d, node.wavelength_nm), node.weight});
    return all;
}

ChannelPixels::ChannelPixels(const Display& d, std::size_t channel) : size_{double(d.panel.pixels[0]), double(d.panel.pixels[1])} {
    for (const LitPart& lit : lit_parts(d.panel)) {
        if (lit.channel != 3 && lit.channel != int(channel)) continue;
        const double column = lit.plane.pixel[0], row = lit.plane.pixel[1];
        Place middle{};
        if (made_by_channel(d)) middle = centroid(d.panel, int(channel), lit.plane.pixel[0], lit.plane.pixel[1]).value_or(middle);
        parts_.push_back({lit, {column + 0.5 + middle[0], row + 0.5 + middle[1]}, {column, row}});
    }
}

std::optional<ChannelPixels::Shining> ChannelPixels::at(const Place& place) const {
    for (const ChannelRect& part : parts_) {
        Place corner{};
        bool inside = true;
        // The rectangle is half-open and repeats with its cell: the position is compared from the corner of the cell in which it
        // lies.
        for (std::size_t k = 0; k < 2; ++k) {
            const double cell = part.lit.plane.cell[k];
            corner[k] = std::floor(place[k] / cell) * cell;
            inside = inside && place[k] - corner[k] >= part.lit.from[k] && place[k] - corner[k] < part.lit.to[k];
        }
        if (inside) {
            const auto from_corner = [&](const Place& p) { return Place{corner[0] + p[0], corner[1] + p[1]}; };
            // A rectangle that shows a pixel off the panel is dark.
            const Place pixel = from_corner(part.pixel);
            for (std::size_t k = 0; k < 2; ++k)
                if (pixel[k] < 0 || pixel[k] >= size_[k]) return {};
            return Shining{part.lit.brightness(), from_corner(part.shown)};
        }
    }
    return {};
}

std::complex<double> ChannelPixels::wave(double nu_x, double nu_y) const {
    std::complex<double> sum = 0;
    for (const auto& [lit, shown, pixel] : parts_) {
        const double off_x = 0.5 * (lit.from[0] + lit.to[0]) - shown[0], off_y = 0.5 * (lit.from[1] + lit.to[1]) - shown[1];
        sum += std::polar(lit.share, 2 * pi * (nu_x * off_x + nu_y * off_y)) * sinc(nu_x * (lit.to[0] - lit.from[0])) *
               sinc(nu_y * (lit.to[1] - lit.from[1]));
    }
    return sum;
}

ChannelPixels::Place ChannelPixels::middle() const {
    Place sum{};
    for (const auto& [lit, shown, pixel] : parts_)
        for (std::size_t k = 0; k < 2; ++k) sum[k] += lit.share * (0.5 * (lit.from[k] + lit.to[k]) - shown[k]);
    return sum;
}

double ChannelPixels::narrowest(double x, double y) const {
    double width = 1;
    for (const auto& [lit, shown, pixel] : parts_)
        width = std::min(width, std::max(std::abs(x) * (lit.to[0] - lit.from[0]), std::abs(y) * (lit.to[1] - lit.from[1])));
    return width;
}

double ChannelPixels::gain() const {
    double most = 0;
    for (const auto& [lit, shown, pixel] : parts_) most = std::max(most, lit.brightness());
    return most;
}

}  // namespace lfdsim
