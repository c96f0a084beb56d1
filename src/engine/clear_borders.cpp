#include "engine/clear_borders.h"

#include "engine/scene.h"
#include "model/lens_errors.h"
#include "optics/camera.h"
#include "optics/filtered_limits.h"
#include "optics/trace.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace lfdsim {
namespace {

constexpr double most_slope = 1.5;  // the steepest slope of the table; steeper ones are taken as it
constexpr int halvings = 12;        // of the search for where light ends: to 2^-12 of at most 1.3 half widths
constexpr double straight = 1e-3;   // half widths of a cell: a border is straight whose middle is off its mean by no more

/// A border of a lens's cell, seen by parallel rays.
class Border {
  public:
    Border(const optics::Scene<double>& of, int border_pair)
        : scene_(of), border_(optics::borders(of.lattice, border_pair)), below_(of.holes_below[border_pair]) {
        const Lattice<double>& lattice = of.lattice;
        half_length_ = lattice.strips ? 0 : lattice.hexagonal ? border_.half / std::sqrt(3.0) : lattice.half_pitch[1 - border_pair];
    }

    /// How far beyond the border light enters the lens, at these slopes towards it and along it; mm. The mean over the border, by
    /// two points of Gauss's rule. None where not even the lens's middle is lit, or where light ends along a line that is bent by
    /// more than `most_bent`, mm.
    std::optional<double> beyond(double towards, double along, double most_bent) const {
        if (!enters(0, towards, along, 0)) return {};
        const double at = half_length_ / std::sqrt(3.0);
        const double mean = 0.5 * (beyond_at(towards, along, -at) + beyond_at(towards, along, at));
        if (std::abs(beyond_at(towards, along, 0) - mean) > std::max(most_bent, straight * border_.half)) return {};
        return mean;
    }

  private:
    double beyond_at(double towards, double along, double at) const {
        const double near = 0.3 * border_.half;
        double in = enters(border_.half - near, towards, along, at) ? border_.half - near : 0, out = border_.half + near;
        if (enters(out, towards, along, at)) return near;
        for (int k = 0; k < halvings; ++k) {
            const double middle = 0.5 * (in + out);
            (enters(middle, towards, along, at) ? in : out) = middle;
        }
        return 0.5 * (in + out) - border_.half;
    }

    /// Does a ray through that point of the plane of the holes, so far from the axis towards the border and along it, pass the
    /// lens?
    bool enters(double from_axis, double towards, double along, double at) const {
        const double first_towards = from_axis - towards * below_, first_along = at - along * below_,
                     down = 1 / std::sqrt(1 + towards * towards + along * along);
        const auto in_array = [&](double t, double a) {
            return std::array{border_.x * t - border_.y * a, border_.y * t + border_.x * a};
        };
        const auto [x, y] = in_array(first_towards, first_along);
        const auto [to_x, to_y] = in_array(towards * down, along * down);
        const optics::Extent<double> extent{-9, 9, scene_.lattice.strips ? 0.0 : -9.0, scene_.lattice.strips ? 0.0 : 9.0};
        const auto end = optics::trace_any<double>(scene_, extent, {0, 0, 0, 0, 0}, {{x, y, 0}, {to_x, to_y, -down}}, true);
        return end.alive && end.weight > 0 && end.cell.i == 0 && end.cell.j == 0;
    }

    const optics::Scene<double>& scene_;
    const optics::Borders<double> border_;
    const double below_;
    double half_length_;
};

/// The largest slope of a ray of the picture, with the diffuser's turn to spare.
double largest_slope(const optics::Scene<float>& scene, const optics::View& view) {
    double most = 0;
    for (int corner = 0; corner < 4; ++corner) {
        double d[3], x, y;
        optics::follow_to_first_plane(view, corner % 2 ? view.width : 0, corner / 2 ? view.height : 0, d, x, y);
        most = std::max(most, d[2] < 0 ? std::sqrt(d[0] * d[0] + d[1] * d[1]) / -d[2] : most_slope);
    }
    return std::min(most + double(std::max(scene.half_angle[0], scene.half_angle[1])), most_slope);
}

}  // namespace

void add_clear_borders(optics::Scene<float>& scene, const Display& display, const Geometry& geometry, const optics::View& view,
                       double part_mm) {
    optics::ClearBorders<float>& clear = scene.clear_borders;
    clear.most = 0;
    if (scene.thin || scene.has_stop || scene.aperture != Aperture::cell || scene.surround != Surround::opaque) return;
    DisplayScene<double> alone = make_scene<double>(without_errors(display), geometry);
    alone.rotated = false;
    const double most = std::max(largest_slope(scene, view), 1e-3);
    const int kinds = scene.lattice.hexagonal || scene.lattice.strips ? 1 : 2;
    for (int kind = 0; kind < kinds; ++kind) {
        const Border border(alone, kind);
        for (int i = 0; i < clear.towards; ++i) {
            for (int j = 0; j < clear.along; ++j) {
                const double towards = most * (2.0 * i / (clear.towards - 1) - 1), along = most * j / (clear.along - 1);
                clear.beyond[kind][i][j] =
                    float(border.beyond(towards, along, FilteredLimits::bent * part_mm).value_or(double(clear.unknown)));
            }
        }
    }
    clear.most = float(most);
}

}  // namespace lfdsim
