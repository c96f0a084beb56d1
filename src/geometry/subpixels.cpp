#include "geometry/subpixels.h"
#include "base/sinc.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lfdsim {
namespace {

constexpr double same = 1e-9;  // pixels: places closer than this are one
constexpr double third = 1.0 / 3;

// Rectangles are measured from the cell's top left corner here, until lit_rects() moves them.

SubpixelRect rect_of(const Subpixel& s) { return {{s.rect[0], s.rect[1]}, {s.rect[2], s.rect[3]}}; }

/// Returns a rectangle shrunk about its centre by sqrt(q) in width and height, q the aperture ratio.
SubpixelRect shrunk(const SubpixelRect& r, double aperture_ratio) {
    const double half = 0.5 * std::sqrt(aperture_ratio);
    SubpixelRect out{};
    for (std::size_t k = 0; k < 2; ++k) {
        const double middle = 0.5 * (r.from[k] + r.to[k]), reach = half * (r.to[k] - r.from[k]);
        out.from[k] = middle - reach;
        out.to[k] = middle + reach;
    }
    return out;
}

/// Returns the shrunk rectangle with its borders on a grid of `lines` a pixel. Its shorter side is rounded, then its longer one so
/// that the area is nearest. It stays within the rounded borders of `r`, and a shrunk one is smaller than these, so that rectangles
/// do not touch.
SubpixelRect shrunk_on_grid(const SubpixelRect& r, double aperture_ratio, int lines) {
    const auto nearest = [](double x) { return std::floor(x + 0.5 + 1e-6); };
    const SubpixelRect lit = shrunk(r, aperture_ratio);
    SubpixelRect out{};
    double area = lit.area() * lines * lines;
    const std::size_t shorter = lit.to[1] - lit.from[1] < lit.to[0] - lit.from[0] ? 1 : 0;
    for (const std::size_t k : {shorter, 1 - shorter}) {
        const double from = nearest(r.from[k] * lines), room = nearest(r.to[k] * lines) - from;
        const double wanted = k == shorter ? (lit.to[k] - lit.from[k]) * lines : area;
        const double length = std::max(std::min(nearest(wanted), aperture_ratio < 1 ? room - 1 : room), 1.);
        area /= length;
        out.from[k] = (from + std::floor(0.5 * (room - length))) / lines;
        out.to[k] = out.from[k] + length / lines;
    }
    return out;
}

/// Returns a modulo n, 0 .. n - 1 also for negative a.
std::int64_t floor_mod(std::int64_t a, std::int64_t n) { return (a % n + n) % n; }

/// Returns the subpixel moved by whole cells, so that its pixel is in the first cell.
Subpixel in_first_cell(Subpixel s, const std::array<std::int64_t, 2>& cell) {
    for (std::size_t k = 0; k < 2; ++k) {
        const std::int64_t home = floor_mod(s.pixel[k], cell[k]), move = home - s.pixel[k];
        s.pixel[k] = home;
        s.rect[k] += double(move);
        s.rect[k + 2] += double(move);
    }
    return s;
}

bool alike(const Subpixel& a, const Subpixel& b) {
    if (a.channel != b.channel || a.pixel != b.pixel) return false;
    for (std::size_t k = 0; k < 4; ++k)
        if (std::abs(a.rect[k] - b.rect[k]) > same) return false;
    return true;
}

/// Returns whether subpixels that repeat after `cell` repeat after the smaller `period` already: moved by it along each axis, each
/// of them is again one of them.
bool repeat_after(const std::vector<Subpixel>& all, const std::array<std::int64_t, 2>& cell,
                  const std::array<std::int64_t, 2>& period) {
    for (std::size_t k = 0; k < 2; ++k)
        for (Subpixel s : all) {
            s.pixel[k] += period[k];
            s.rect[k] += double(period[k]);
            s.rect[k + 2] += double(period[k]);
            s = in_first_cell(s, cell);
            if (std::none_of(all.begin(), all.end(), [&](const Subpixel& other) { return alike(s, other); })) return false;
        }
    return true;
}

/// Returns the smallest divisor of `cell`, by area, after which subpixels repeat.
std::array<std::int64_t, 2> least_cell(const std::vector<Subpixel>& all, const std::array<std::int64_t, 2>& cell) {
    std::array<std::int64_t, 2> least = cell;
    for (std::int64_t x = 1; x <= cell[0]; ++x)
        for (std::int64_t y = 1; y <= cell[1]; ++y)
            if (cell[0] % x == 0 && cell[1] % y == 0 && x * y < least[0] * least[1] && repeat_after(all, cell, {x, y}))
                least = {x, y};
    return least;
}

/// Appends the parts of a subpixel, one for each cell that it reaches into; as cells repeat, all are parts of the same cell. `lit`:
/// its shrunk rectangle; `share`: its share of the channel's light.
void add_parts(const Subpixel& s, const SubpixelRect& lit, const std::array<std::int64_t, 2>& cell, double share,
               std::vector<LitPart>& to) {
    const double width = double(cell[0]), height = double(cell[1]);
    for (double y = std::floor(lit.from[1] / height); y * height < lit.to[1] - same; ++y)
        for (double x = std::floor(lit.from[0] / width); x * width < lit.to[0] - same; ++x) {
            const std::array<double, 2> corner{x * width, y * height};
            LitPart part{int(s.channel), {{int(cell[0]), int(cell[1])}, {}}, {}, {}, 0};
            for (std::size_t k = 0; k < 2; ++k) {
                part.plane.pixel[k] = int(s.pixel[k]) - int(corner[k]);
                part.from[k] = std::max(lit.from[k] - corner[k], 0.);
                part.to[k] = std::min(lit.to[k] - corner[k], double(cell[k]));
            }
            const SubpixelRect here{part.from, part.to};
            if (here.to[0] - here.from[0] <= same || here.to[1] - here.from[1] <= same) continue;
            part.share = share * here.area() / lit.area();
            to.push_back(part);
        }
}

/// Returns the parts of all subpixels; `shrink` returns what is lit of a rectangle.
template <class Shrink>
std::vector<LitPart> parts_of(const Panel& panel, const Shrink& shrink) {
    std::vector<LitPart> parts;
    if (panel.subpixels == SubpixelLayout::none) {
        const SubpixelRect lit = shrink({{0, 0}, {1, 1}});
        return {{3, {}, lit.from, lit.to, 1}};
    }
    const SubpixelCell cell = subpixel_cell(panel);
    for (const Channel channel : {Channel::r, Channel::g, Channel::b}) {
        std::vector<Subpixel> all;
        for (const Subpixel& s : cell.subpixels)
            if (s.channel == channel) all.push_back(in_first_cell(s, cell.size));
        // One subpixel of each group that repeats, with the share of its area in the channel's
        const std::array<std::int64_t, 2> least = least_cell(all, cell.size);
        std::erase_if(all, [&](const Subpixel& s) { return s.pixel[0] >= least[0] || s.pixel[1] >= least[1]; });
        double area = 0;
        for (const Subpixel& s : all) area += rect_of(s).area();
        for (const Subpixel& s : all) add_parts(s, shrink(rect_of(s)), least, rect_of(s).area() / area, parts);
    }
    return parts;
}

}  // namespace

SubpixelCell subpixel_cell(const Panel& panel) {
    SubpixelCell out{{1, 1}, {}};
    const auto add = [&](Channel channel, std::int64_t column, std::int64_t row, double left, double top, double right,
                         double bottom) {
        out.subpixels.push_back({channel, {column, row}, {left, top, right, bottom}});
    };
    constexpr Channel rgb[] = {Channel::r, Channel::g, Channel::b};
    switch (panel.subpixels) {
        case SubpixelLayout::none:
            break;
        case SubpixelLayout::rgb_stripe:
            for (int k = 0; k < 3; ++k) add(rgb[k], 0, 0, k * third, 0, (k + 1) * third, 1);
            break;
        case SubpixelLayout::bgr_stripe:
            for (int k = 0; k < 3; ++k) add(rgb[2 - k], 0, 0, k * third, 0, (k + 1) * third, 1);
            break;
        case SubpixelLayout::rgb_rows:
            for (int k = 0; k < 3; ++k) add(rgb[k], 0, 0, 0, k * third, 1, (k + 1) * third);
            break;
        case SubpixelLayout::pentile_rgbg:
            out.size = {2, 2};
            for (int row = 0; row < 2; ++row)
                for (int column = 0; column < 2; ++column) {
                    add(row == column ? Channel::r : Channel::b, column, row, column, row, column + 0.5, row + 1);
                    add(Channel::g, column, row, column + 0.5, row, column + 1, row + 1);
                }
            break;
        case SubpixelLayout::delta:
            out.size = {1, 2};
            for (int row = 0; row < 2; ++row)
                for (int k = 0; k < 3; ++k) add(rgb[k], 0, row, k * third + 0.5 * row, row, (k + 1) * third + 0.5 * row, row + 1);
            break;
        case SubpixelLayout::custom:
            out = {panel.subpixel_cell.value_or(std::array<std::int64_t, 2>{1, 1}), panel.custom};
            break;
    }
    return out;
}

std::vector<LitPart> lit_parts(const Panel& panel) {
    return parts_of(panel, [&](const SubpixelRect& r) { return shrunk(r, panel.aperture_ratio); });
}

std::vector<LitPart> lit_parts_on_grid(const Panel& panel, int lines) {
    return parts_of(panel, [&](const SubpixelRect& r) { return shrunk_on_grid(r, panel.aperture_ratio, lines); });
}

std::vector<LitPart> bounded_parts(const Panel& panel) {
    // Along x, then along y: parts that the border cuts are divided in proportion to their lengths, if their pixel is on the panel.
    std::vector<LitPart> parts = lit_parts(panel);
    for (std::size_t k = 0; k < 2; ++k) {
        std::vector<LitPart> cut;
        for (const LitPart& part : parts) {
            const double border = double(panel.pixels[k] % part.plane.cell[k]);  // in the cell that it cuts
            if (border == 0 || part.to[k] <= border + same || part.plane.pixel[k] >= border) {
                cut.push_back(part);
                continue;
            }
            LitPart beyond = part;
            beyond.plane.whole[k] = true;
            beyond.from[k] = std::max(part.from[k], border);
            beyond.share = part.share * (part.to[k] - beyond.from[k]) / (part.to[k] - part.from[k]);
            cut.push_back(beyond);
            if (part.from[k] >= border - same) continue;
            cut.push_back(part);
            cut.back().to[k] = border;
            cut.back().share = part.share - beyond.share;
        }
        parts = std::move(cut);
    }
    return parts;
}

std::optional<std::pair<std::size_t, std::size_t>> overlapping(const Panel& panel) {
    struct PartOf {
        std::size_t subpixel;  // its number
        SubpixelRect rect;
    };
    std::vector<PartOf> parts;
    for (std::size_t k = 0; k < panel.custom.size(); ++k) {
        std::vector<LitPart> of_one;
        add_parts(panel.custom[k], rect_of(panel.custom[k]), subpixel_cell(panel).size, 1, of_one);
        for (const LitPart& p : of_one) {
            for (const PartOf& other : parts)
                if (std::min(p.to[0], other.rect.to[0]) - std::max(p.from[0], other.rect.from[0]) > same &&
                    std::min(p.to[1], other.rect.to[1]) - std::max(p.from[1], other.rect.from[1]) > same)
                    return std::pair(other.subpixel, k);
            parts.push_back({k, {p.from, p.to}});
        }
    }
    return {};
}

WhitePanel::WhitePanel(const Panel& panel, const ChannelWeights& weights) : parts_(lit_parts(panel)), weights_(weights) {
    constexpr double fine = 8;  // periods in a part; harmonics beyond are weaker than 1/(8 pi) of the first along each axis
    for (std::size_t k = 0; k < 2; ++k) {
        cell_[k] = int(subpixel_cell(panel).size[k]);
        for (const LitPart& part : parts_)
            if (weight(part) > 0)
                highest_[k] = std::max(highest_[k], int(std::ceil(fine * cell_[k] / std::max(part.to[k] - part.from[k], 0.1))));
    }
}

double WhitePanel::weight(const LitPart& part) const {
    return part.channel == 3 ? weights_[0] + weights_[1] + weights_[2] : weights_[std::size_t(part.channel)];
}

double WhitePanel::at(double column, double row) const {
    const std::array<double, 2> place{column, row};
    double sum = 0;
    for (const LitPart& part : parts_) {
        bool inside = true;
        for (std::size_t k = 0; k < 2; ++k) {
            const double cell = part.plane.cell[k], in_cell = place[k] - std::floor(place[k] / cell) * cell;
            inside = inside && in_cell >= part.from[k] && in_cell < part.to[k];
        }
        if (inside) sum += weight(part) * part.brightness();
    }
    return sum;
}

std::complex<double> WhitePanel::harmonic(int k, int l) const {
    const std::array<int, 2> orders{k, l};
    std::complex<double> sum = 0;
    for (const LitPart& part : parts_) {
        double size = weight(part) * part.share, turns = 0;
        for (std::size_t axis = 0; axis < 2; ++axis) {
            const int repeats = cell_[axis] / part.plane.cell[axis];
            if (orders[axis] % repeats != 0) size = 0;
            const double per_pixel = double(orders[axis]) / cell_[axis];
            size *= sinc(per_pixel * (part.to[axis] - part.from[axis]));
            turns += per_pixel * 0.5 * (part.from[axis] + part.to[axis]);
        }
        sum += std::polar(1., -2 * std::numbers::pi * turns) * size;
    }
    return sum;
}

std::vector<PanelPlane> planes(const Panel& panel) {
    std::vector<PanelPlane> all{PanelPlane()};
    for (const LitPart& part : bounded_parts(panel))
        if (std::find(all.begin(), all.end(), part.plane) == all.end()) all.push_back(part.plane);
    return all;
}

bool lights_whole_pixels(const Panel& panel) { return panel.subpixels == SubpixelLayout::none && panel.aperture_ratio == 1; }

double gain(const Panel& panel, int channel) {
    const SubpixelCell cell = subpixel_cell(panel);
    double area = cell.subpixels.empty() ? 1 : 0;
    for (const Subpixel& s : cell.subpixels)
        if (int(s.channel) == channel) area += rect_of(s).area();
    return double(cell.size[0]) * double(cell.size[1]) / (area * panel.aperture_ratio);
}

double peak(const Panel& panel) { return std::max({gain(panel, 0), gain(panel, 1), gain(panel, 2)}); }

std::vector<SubpixelRect> lit_rects(const Panel& panel, int channel, std::int64_t column, std::int64_t row) {
    const SubpixelCell cell = subpixel_cell(panel);
    const std::array<std::int64_t, 2> pixel{floor_mod(column, cell.size[0]), floor_mod(row, cell.size[1])};
    std::vector<SubpixelRect> rects;
    const auto add = [&](const SubpixelRect& r) {
        const SubpixelRect lit = shrunk(r, panel.aperture_ratio);
        const std::array<double, 2> centre{double(pixel[0]) + 0.5, double(pixel[1]) + 0.5};
        rects.push_back({{lit.from[0] - centre[0], lit.from[1] - centre[1]}, {lit.to[0] - centre[0], lit.to[1] - centre[1]}});
    };
    if (panel.subpixels == SubpixelLayout::none) add({{0, 0}, {1, 1}});
    for (const Subpixel& s : cell.subpixels)
        if (int(s.channel) == channel && s.pixel == pixel) add(rect_of(s));
    return rects;
}

std::optional<std::array<double, 2>> centroid(const Panel& panel, int channel, std::int64_t column, std::int64_t row) {
    double area = 0;
    std::array<double, 2> sum{};
    for (const SubpixelRect& r : lit_rects(panel, channel, column, row)) {
        area += r.area();
        for (std::size_t k = 0; k < 2; ++k) sum[k] += r.area() * 0.5 * (r.from[k] + r.to[k]);
    }
    if (area == 0) return {};
    return std::array<double, 2>{sum[0] / area, sum[1] / area};
}

std::vector<double> shown_places(const Display& d) {
    if (d.panel.subpixels == SubpixelLayout::none || d.content.sampling == ContentSampling::pixel) return {};
    const std::array<std::int64_t, 2> cell = subpixel_cell(d.panel).size;
    std::vector<double> all{double(cell[0]), double(cell[1])};
    for (std::int64_t row = 0; row < cell[1]; ++row)
        for (std::int64_t column = 0; column < cell[0]; ++column)
            for (int channel = 0; channel < 3; ++channel)
                for (const double place : centroid(d.panel, channel, column, row).value_or(std::array{99., 99.}))
                    all.push_back(place);
    return all;
}

}  // namespace lfdsim
