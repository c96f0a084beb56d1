// Points of a panel's pixels for which their colours are computed. Floor 2.
#pragma once
#include "geometry/subpixels.h"

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

namespace lfdsim {

/// Returns whether a pixel's colours are computed for different points.
inline bool made_by_channel(const Display& d) {
    return d.panel.subpixels != SubpixelLayout::none && d.content.sampling == ContentSampling::subpixel;
}

/// The points for which a channel is computed, one for each pixel of the subpixel cell: from the pixel's centre, in pixels to the
/// right and down; nothing if the pixel does not emit the channel.
class ShownPoints {
  public:
    using Point = std::array<double, 2>;

    /// The point is the pixel's centre, or, by channel, the centroid of the channel's light. With `place` it is the point at that
    /// share of the emitting area's width (0) and height (1), counted over its rectangles one after the other.
    ShownPoints(const Panel& panel, bool by_channel, int channel, const std::optional<Point>& place = {}) {
        if (by_channel) cell_ = subpixel_cell(panel).size;
        for (std::int64_t row = 0; row < cell_[1]; ++row)
            for (std::int64_t column = 0; column < cell_[0]; ++column) {
                if (place)
                    of_.push_back(point_at(by_channel ? lit_rects(panel, channel, column, row) : whole_pixel(), *place));
                else
                    of_.push_back(by_channel ? centroid(panel, channel, column, row) : Point{});
            }
    }
    /// Returns the point of a pixel.
    std::optional<Point> of(std::int64_t column, std::int64_t row) const {
        return of_[std::size_t(row % cell_[1] * cell_[0] + column % cell_[0])];
    }
    /// Returns the point that all pixels which have one have in common; nothing if they differ.
    std::optional<Point> common() const {
        std::optional<Point> first;
        for (const std::optional<Point>& each : of_) {
            if (each && first && *each != *first) return {};
            if (each) first = each;
        }
        return first;
    }
    /// Returns whether all pixels have a point.
    bool everywhere() const {
        return std::all_of(of_.begin(), of_.end(), [](const std::optional<Point>& each) { return each.has_value(); });
    }

  private:
    static std::vector<SubpixelRect> whole_pixel() { return {{{-0.5, -0.5}, {0.5, 0.5}}}; }
    static std::optional<Point> point_at(const std::vector<SubpixelRect>& rects, const Point& place) {
        double area = 0;
        for (const SubpixelRect& r : rects) area += r.area();
        double left = place[0] * area;
        for (const SubpixelRect& r : rects) {
            if (left < r.area())
                return Point{r.from[0] + left / r.area() * (r.to[0] - r.from[0]), r.from[1] + place[1] * (r.to[1] - r.from[1])};
            left -= r.area();
        }
        return {};
    }

    std::array<std::int64_t, 2> cell_{1, 1};
    std::vector<std::optional<Point>> of_;
};

/// Returns the points of red, green and blue, or one entry if all three are computed for the same points.
inline std::vector<ShownPoints> shown_points(const Display& d) {
    std::vector<ShownPoints> all;
    for (int channel = 0; channel < (made_by_channel(d) ? 3 : 1); ++channel) all.emplace_back(d.panel, made_by_channel(d), channel);
    return all;
}

}  // namespace lfdsim
