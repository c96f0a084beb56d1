#include "content/pickup/lens_mapping.h"

#include "base/on_threads.h"
#include "display/colour.h"
#include "engine/views/lens_trace.h"
#include "optics/lattice.h"

#include <oneapi/tbb/parallel_for.h>
#include <algorithm>
#include <cmath>
#include <optional>

namespace lfdsim {
namespace {

constexpr int nodes_per_pitch = 32, most_steps = 256;
constexpr int aperture_rays = 4096;  // of each panel point
// Radius of the last window: the larger of that many pixels and that part of the rays' root mean square
constexpr double window_pixels = 2.5, window_of_spread = 0.5;
constexpr double rounding = 1e-9;  // mm and slopes: less counts as 0, so that ideal lenses keep their nodal lines exactly

/// Returns how far from a lens's axis, mm along the array's axes, panel points lie that belong to it: |P - C| <= e (half a cell)
/// + (e - 1) |C|, with e - 1 = g/(D' - z_H'). Lenses whose image lies beside the panel do not count.
std::array<double, 2> farthest_points(const Display& d, const Geometry& g) {
    const double away = d.content.viewing_distance_mm - g.rear_principal_mm, more = std::isinf(away) ? 0 : g.gap_mm / away;
    const auto& l = g.lattice;
    const double c = std::abs(l.cos_turn), s = std::abs(l.sin_turn);
    const std::array<double, 2> offset{l.cos_turn * l.offset[0] + l.sin_turn * l.offset[1],
                                       l.cos_turn * l.offset[1] - l.sin_turn * l.offset[0]},
        panel{(c * g.panel_width_mm + s * g.panel_height_mm) / 2, (s * g.panel_width_mm + c * g.panel_height_mm) / 2},
        array{g.array_width_mm / 2, g.array_height_mm / 2}, cell{l.half_pitch[0], optics::reach_of_cell(l)};
    std::array<double, 2> reach{};
    for (std::size_t k = 0; k < 2; ++k)
        reach[k] = (1 + more) * cell[k] + more * std::min(std::abs(offset[k]) + array[k], panel[k] / (1 + more) + cell[k]);
    return reach;
}

/// Returns the k-th of evenly spread points in [0, 1)^N: an additive recurrence with the powers of the inverse root of x^(N + 1)
/// = x + 1 (M. Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018).
template <std::size_t N>
std::array<double, N> spread(int k) {
    constexpr double root = N == 4 ? 1.1673039782614187 : 1.324717957244746;
    static_assert(N == 4 || N == 2);
    std::array<double, N> place{};
    double step = 1;
    for (double& x : place) {
        step /= root;
        x = 0.5 + (k + 1) * step;
        x -= std::floor(x);
    }
    return place;
}

/// Returns the weights of four neighbouring nodes for the position t from the second to the third (Catmull and Rom 1974).
std::array<float, 4> cubic(float t) {
    const float t2 = t * t, t3 = t2 * t;
    return {0.5f * (2 * t2 - t - t3), 0.5f * (2 - 5 * t2 + 3 * t3), 0.5f * (t + 4 * t2 - 3 * t3), 0.5f * (t3 - t2)};
}

}  // namespace

/// Traces the rays of one panel point after another. Points `at` lie in the lens's principal planes, mm.
class LensMapping::Tracing {
  public:
    Tracing(const Display& display, const Geometry& green, double wavelength_nm, const std::array<double, 2>& reach)
        : geometry_(resolve(display, wavelength_nm)),
          lens_(display, geometry_),
          strips_(is_strips(display.array)),
          inverse_gap_(1 / green.gap_mm),
          green_plane_(green.rear_principal_mm - geometry_.rear_principal_mm),
          vergence_(1 / green.focal_length_mm - inverse_gap_),
          window_(window_pixels * display.panel.pixel_pitch_mm * inverse_gap_) {
        for (const double x : {0., 0.5, 1.})
            for (const double y : {0., 0.5, 1.})
                if (!strips_ || y == 0) see(Point{x * reach[0], y * reach[1]});
    }

    /// The bounding box of the points through which rays of a panel point pass.
    struct SearchBox {
        Point from, to;
    };
    /// The line on which most light of a panel point travels, and the rays that were transmitted.
    struct TracedAim {
        LineShift line{};
        int rays = 0;     // of aperture_rays
        SearchBox box{};  // of the rays
    };
    /// Traces rays through evenly spread points of the aperture, the same for all panel points. The points are mirror images of
    /// one another, so that a thin lens's lines are nodal, and are not in rows, of which a whole one would cross the rim at once.
    TracedAim from(Point u) const {
        TracedAim found;
        std::vector<Line> lines;
        lines.reserve(aperture_rays);
        const auto add = [&](Point at) {
            const auto line = shift(u, at);
            if (!line) return;
            for (std::size_t k = 0; k < 2; ++k) {
                found.box.from[k] = lines.empty() ? at[k] : std::min(found.box.from[k], at[k]);
                found.box.to[k] = lines.empty() ? at[k] : std::max(found.box.to[k], at[k]);
            }
            lines.push_back(*line);
        };
        if (strips_) {
            for (int i = 0; i < aperture_rays; ++i) add({((2 * i + 1.) / aperture_rays - 1) * widest_[0], 0});
        } else {
            for (int i = 0; i < aperture_rays / 4; ++i) {
                const auto [x, y] = spread<2>(i);
                const Point at{x * widest_[0], y * widest_[1]};
                for (const double sx : {-1., 1.})
                    for (const double sy : {-1., 1.}) add({sx * at[0], sy * at[1]});
            }
        }
        found.rays = int(lines.size());
        if (lines.empty()) return found;
        const Line line = where_most_travel(lines);
        const auto rounded = [&](double value) { return std::abs(value) < rounding ? 0.f : float(value); };
        found.line = {rounded(line[0]), rounded(line[1]), rounded(line[2]), rounded(line[3])};
        return found;
    }
    /// Returns the line of the ray through one point of the aperture; nothing if it is blocked.
    std::optional<LineShift> one(Point u, const SearchBox& box, const RayPlace& place) const {
        const Point at{box.from[0] + place[2] * (box.to[0] - box.from[0]),
                       strips_ ? 0 : box.from[1] + place[3] * (box.to[1] - box.from[1])};
        const auto line = shift(u, at);
        if (!line) return {};
        return LineShift{float((*line)[0]), float((*line)[1]), float((*line)[2]), float((*line)[3])};
    }

  private:
    using Line = std::array<double, 4>;  // x, y, mx, my

    /// Returns the mean line of the rays about the position t = m + x/L in the central depth plane at which they are densest.
    /// Aberrations throw a pixel's outer rays far to one side, so that the mean of all rays is where little of its light goes.
    /// What counts for a picture is how much arrives within a few pixels of where it is intended, or, if the rays are spread
    /// farther than that, within half of their root mean square. Found by mean shifts (K. Fukunaga and L. Hostetler 1975) with
    /// weights (1 - (d/radius)^2)^2 through ever narrower windows.
    Line where_most_travel(const std::vector<Line>& lines) const {
        const auto place = [&](const Line& l) { return Point{l[2] + l[0] * vergence_, l[3] + l[1] * vergence_}; };
        Line mean{};
        for (const Line& l : lines)
            for (std::size_t k = 0; k < 4; ++k) mean[k] += l[k] / double(lines.size());
        const auto distance2 = [&](const Line& l, Point at) {
            const Point p = place(l);
            return (p[0] - at[0]) * (p[0] - at[0]) + (p[1] - at[1]) * (p[1] - at[1]);
        };
        double widest2 = 0, square = 0;
        for (const Line& l : lines) {
            const double d2 = distance2(l, place(mean));
            widest2 = std::max(widest2, d2);
            square += d2 / double(lines.size());
        }
        const double least = std::max(window_, window_of_spread * std::sqrt(square));
        for (double radius = 2 * std::sqrt(widest2); radius > least;) {
            radius = std::max(radius / 1.5, least);
            for (int step = 0; step < 40; ++step) {
                const Point at = place(mean);
                Line sum{};
                double weights = 0;
                for (const Line& l : lines) {
                    const double off = 1 - distance2(l, at) / (radius * radius), weight = off > 0 ? off * off : 0;
                    weights += weight;
                    for (std::size_t k = 0; k < 4; ++k) sum[k] += weight * l[k];
                }
                if (!(weights > 0)) return mean;  // no ray is in the window, as in the middle of a ring
                for (std::size_t k = 0; k < 4; ++k) mean[k] = sum[k] / weights;
                if (distance2(mean, at) < 1e-6 * radius * radius) break;
            }
        }
        return mean;
    }

    /// Widens the aperture to where the point's rays pass the principal planes.
    void see(Point u) {
        constexpr int across = 48;
        constexpr double margin = 1.1;  // the outermost rays are up to 1/48 of the box farther out, more at grazing incidence
        const auto box = lens_.directions(u);
        if (!box) return;
        for (int j = 0; j < (strips_ ? 1 : across); ++j)
            for (int i = 0; i < across; ++i) {
                const Point cosines{box->x0 + (i + 0.5) / across * (box->x1 - box->x0),
                                    strips_ ? 0 : box->y0 + (j + 0.5) / across * (box->y1 - box->y0)};
                if (!lens_.ray(u, cosines)) continue;
                const Point at = lens_.aim(u, cosines);
                for (std::size_t k = 0; k < 2; ++k) widest_[k] = std::max(widest_[k], margin * std::abs(at[k]));
            }
    }

    /// Returns the line of the ray aimed at a point, less the nodal line of slope -u/g, in the plane of green light's H'.
    std::optional<std::array<double, 4>> shift(Point u, Point at) const {
        const auto ray = lens_.ray(u, lens_.towards(u, at));
        if (!ray) return {};
        return std::array{ray->x + ray->mx * green_plane_, ray->y + ray->my * green_plane_, ray->mx + u[0] * inverse_gap_,
                          ray->my + u[1] * inverse_gap_};
    }

    Geometry geometry_;
    LensTrace lens_;
    bool strips_;
    double inverse_gap_, green_plane_;  // of green light: 1/g, and the height of its H' over this light's
    double vergence_;                   // 1/L, 1/mm
    double window_;                     // 2.5 a/g, as a slope
    Point widest_{1e-9, 1e-9};          // half the extents of the aperture in the principal planes, mm
};

LensMapping::LensMapping(const Display& display, const Geometry& green, double wavelength_nm, int rays, int threads)
    : reach_(farthest_points(display, green)) {
    const bool strips = is_strips(display.array);
    if (strips) reach_[1] = 0;
    const Tracing tracing(display, green, wavelength_nm, reach_);
    std::array<int, 2> steps{};  // from the axis to the end of the table; the other parts are mirror images
    for (std::size_t k = 0; k < 2; ++k) {
        steps[k] = k == 1 && strips
                       ? 0
                       : int(std::min(std::ceil(reach_[k] * nodes_per_pitch / green.lattice.pitch[k]), double(most_steps)));
        nodes_[k] = 2 * steps[k] + 1;
        per_mm_[k] = steps[k] > 0 ? steps[k] / reach_[k] : 0;
    }
    // Single rays are those of the recurrence that pass the lens for the point on the axis.
    const Tracing::TracedAim axis = tracing.from({0, 0});
    for (int k = 0; axis.rays > 0 && int(places_.size()) < rays && k < 64 * rays; ++k)
        if (const RayPlace place = spread<4>(k); tracing.one({0, 0}, axis.box, place)) places_.push_back(place);

    width_ = nodes_[0] + 2;
    // Interpolation reads four rows: of strips, which have one row of nodes, one more than the border adds.
    const std::size_t size = std::size_t(width_) * std::size_t(nodes_[1] + 3);
    const MappingTable empty{std::vector<LineShift>(size), std::vector<float>(size), true};
    lines_ = empty;
    rays_.assign(places_.size(), empty);
    // Writes a node and its mirror images.
    const auto set = [&](MappingTable& table, int i, int j, const LineShift& line, float light) {
        for (const int x : {-1, 1})
            for (const int y : {-1, 1}) {
                const std::size_t n = at(steps[0] + x * i, steps[1] + y * j);
                table.shift[n] = {float(x) * line.x, float(y) * line.y, float(x) * line.mx, float(y) * line.my};
                table.light[n] = light;
            }
    };
    on_threads(threads, [&] {
        tbb::parallel_for(0, steps[1] + 1, [&](int j) {
            for (int i = 0; i <= steps[0]; ++i) {
                const Point u{steps[0] > 0 ? i * reach_[0] / steps[0] : 0, steps[1] > 0 ? j * reach_[1] / steps[1] : 0};
                const Tracing::TracedAim found = tracing.from(u);
                set(lines_, i, j, found.line, float(found.rays) / float(std::max(axis.rays, 1)));
                for (std::size_t k = 0; k < rays_.size(); ++k) {
                    const auto line = found.rays > 0 ? tracing.one(u, found.box, places_[k]) : std::optional<LineShift>();
                    set(rays_[k], i, j, line.value_or(LineShift{}), line ? 1 : 0);
                }
            }
        });
    });
    complete(lines_);
    for (MappingTable& table : rays_) complete(table);
}

/// Extrapolates the lines around the table and into nodes without light, linearly and node by node from those with light, so that
/// they stay smooth up to its border.
void LensMapping::complete(MappingTable& table) const {
    const int height = nodes_[1] + 2;
    std::vector<char> known(table.light.size());
    for (std::size_t n = 0; n < known.size(); ++n) known[n] = table.light[n] > 0;
    table.all_lit = true;
    for (int j = 0; j < nodes_[1]; ++j)
        for (int i = 0; i < nodes_[0]; ++i) table.all_lit = table.all_lit && known[at(i, j)];
    const auto is_known = [&](int i, int j) {
        return i >= 0 && j >= 0 && i < width_ && j < height && known[std::size_t(j * width_ + i)];
    };
    constexpr int reach = 3;  // interpolation reads no farther
    for (int round = 0; round < reach; ++round) {
        std::vector<char> found = known;
        for (int j = 0; j < height; ++j)
            for (int i = 0; i < width_; ++i) {
                const std::size_t n = std::size_t(j * width_ + i);
                if (known[n]) continue;
                LineShift sum{};
                float count = 0;
                for (const auto& [x, y] : {std::array{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
                    if (!is_known(i + x, j + y)) continue;
                    const LineShift& a = table.shift[std::size_t((j + y) * width_ + i + x)];
                    const bool two = is_known(i + 2 * x, j + 2 * y);
                    const LineShift& b = two ? table.shift[std::size_t((j + 2 * y) * width_ + i + 2 * x)] : a;
                    sum = {sum.x + 2 * a.x - b.x, sum.y + 2 * a.y - b.y, sum.mx + 2 * a.mx - b.mx, sum.my + 2 * a.my - b.my};
                    ++count;
                }
                if (count == 0) continue;
                table.shift[n] = {sum.x / count, sum.y / count, sum.mx / count, sum.my / count};
                found[n] = 1;
            }
        known = found;
    }
}

LensMapping::Between LensMapping::between(std::size_t axis, double u) const {
    const double last = double(nodes_[axis] - 1), place = std::clamp((u + reach_[axis]) * per_mm_[axis], 0., last);
    const int whole = std::max(std::min(int(place), nodes_[axis] - 2), 0);
    return {whole, cubic(float(place - whole))};
}

bool LensMapping::MappingTable::at(int width, const Between& ux, const Between& uy, LineShift& out) const {
    // Node n of the mapping is entry n + 1 of the table, so that the first of the four nodes is entry `first`.
    const std::size_t corner = std::size_t(uy.first * width + ux.first), step = std::size_t(width);
    const auto lit = [&](std::size_t n) { return light[n] > 0; };
    if (!all_lit && !lit(corner + step + 1) && !lit(corner + step + 2) && !lit(corner + 2 * step + 1) &&
        !lit(corner + 2 * step + 2))
        return false;
    typedef float Four __attribute__((vector_size(16)));  // x, y, mx, my
    static_assert(sizeof(LineShift) == sizeof(Four));
    const Four* row = reinterpret_cast<const Four*>(&shift[corner]);
    Four sum{};
    for (std::size_t j = 0; j < 4; ++j, row += step)
        sum += uy.weight[j] * (ux.weight[0] * row[0] + ux.weight[1] * row[1] + ux.weight[2] * row[2] + ux.weight[3] * row[3]);
    out = {sum[0], sum[1], sum[2], sum[3]};
    return true;
}

std::vector<LensMapping> lens_mappings(const Display& display, const Geometry& geometry, int threads) {
    const int rays = display.content.pickup == PickupKind::integrated ? int(display.content.pickup_rays) : 0;
    if (!disperses(display)) return {LensMapping(display, geometry, display.panel.wavelengths_nm[1], rays, threads)};
    std::vector<LensMapping> all;
    for (const double wavelength_nm : display.panel.wavelengths_nm)
        all.emplace_back(display, geometry, wavelength_nm, rays, threads);
    return all;
}

}  // namespace lfdsim
