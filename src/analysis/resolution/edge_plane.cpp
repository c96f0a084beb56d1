// The MTF of one plane from pictures of slanted edges. docs/measures.md, "Resolution".
//
// An edge seen through a lens array is a mosaic. Its mean profile is that of the display only if each distance from the edge is
// seen through all parts of a lens and of a panel pixel equally often. So the bars are slanted, and from picture to picture they
// move on by a share of their width: together the edges cover the plane without gaps, since over the length of a bar an edge
// leans by a whole number of these steps.
//
// Lengths are in mm in the plane of the bars, which is parallel to the panel; `across` is the direction in which resolution is
// measured (the panel's x for upright bars), `along` the other.

#include "analysis/resolution/edge_plane.h"

#include "analysis/core/elemental_panel.h"
#include "base/constants.h"
#include "geometry/resolve.h"

#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

constexpr int least_lenses = 400;              // crossed by edges, so that as many phases of the lenses contribute to the mean
constexpr double golden = 0.6180339887498949;  // least commensurable part of a pitch or a pixel
constexpr int most_pictures = 32;              // of one view, to cross as many lenses
constexpr double most_lost = 0.2;              // share of the light beyond an edge's reach with which there is no figure
constexpr double pixels_wanted = 8e5, most_pixels = 4e6;  // of all pictures of a view together

}  // namespace

EdgePlane::EdgePlane(const Subject& s, double depth_mm, const Direction& direction, const SummedPanel& white, const Job& job)
    : s_(s),
      white_(white),
      job_(job),
      pitch_mm_(lens_pitch_mm(s.geometry(), std::size_t(direction.axis))),
      bars_(bars_across(direction, s.geometry().vertex_plane_mm + depth_mm)) {}

EdgeEye EdgePlane::eye(double angle_deg) const { return {angle_deg, s_.viewing_distance_mm()}; }

/// Returns the lens pitch across the edges, projected into their plane.
double EdgePlane::pitch_mm() const { return pitch_mm_ * scale_to_plane(s_.geometry(), bars_.z_mm, eye(0)); }

/// Makes bars wide enough for twice the blur, a whole number of pitches and golden wide so that neighbouring edges meet the
/// lenses in different phases, or as wide as the screen allows. Chooses the number of pictures and the bars' length so that over
/// it an edge leans by a whole number of steps.
void EdgePlane::set_bars(double blur_mm, double angle_deg) {
    const double pitch = pitch_mm(), lean_rad = std::abs(bars_.lean_deg) * degree, tangent = std::tan(lean_rad);
    const auto [across, along] = seen_half_mm(s_.geometry(), bars_, eye(angle_deg));
    const double most = 1.2 * (across - along * tangent);
    bars_.width_mm = (std::max(1., std::ceil(2 * blur_mm / pitch - golden)) + golden) * pitch;
    bars_.width_mm = std::min(bars_.width_mm, most);
    const double step = bars_.width_mm / std::cos(lean_rad), lean = 2 * along * tangent;
    pictures_ = std::clamp(int(std::ceil(step / lean)), 4, most_pictures);
    const double least = std::min(lean, step / pictures_);
    bars_.length_mm = std::floor(lean / least) * least / tangent;
}

/// Multiplies the number of pictures if edges of all of them would cross fewer than least_lenses lenses.
void EdgePlane::set_pictures(std::span<MtfCurves* const> curves) {
    double fewest = least_lenses;
    constexpr int places = 8;
    for (const MtfCurves* m : curves) {
        double lenses = 0;
        for (int k = 0; k < places; ++k) {
            bars_.offset_mm = bars_.width_mm * k / places;
            lenses += edge_view(s_.display(), s_.geometry(), bars_, eye(m->angle_deg), bars_.width_mm / 8).lenses;
        }
        fewest = std::min(fewest, lenses / places);
    }
    if (fewest <= 0) return;
    const double turns = std::ceil(least_lenses / (fewest * pictures_));
    pictures_ *= int(std::min(turns, double(std::max(1, most_pictures / pictures_))));
}

void EdgePlane::show(int picture) {
    if (job_.cancelled()) throw Stopped{};
    bars_.offset_mm = bars_.width_mm * picture / pictures_;
    panel_ = bars_panel(s_.display(), s_.geometry(), bars_, s_.threads());
}

/// Returns the size of the pictures' pixels in the edges' plane: at most a quarter of the finest period and a tenth of a pitch,
/// but not so small that all pictures together have more than most_pixels; incommensurable with the pitch.
double EdgePlane::pixel_mm(double most_per_mm) const {
    const double across = seen_half_mm(s_.geometry(), bars_, eye(0))[0];
    const double area = pictures_ * bars_.length_mm * 2 * across;
    const double fine =
        std::max(std::min({std::sqrt(area / pixels_wanted), 0.25 / most_per_mm, 0.1 * pitch_mm()}), std::sqrt(area / most_pixels));
    return pitch_mm() / (std::ceil(pitch_mm() / fine) + golden);
}

/// Adds the picture that an eye sees. Returns whether there is an edge in it.
bool EdgePlane::look(EdgeSpread& spread, EdgeEye from, double pixel, MtfCurves& curves) const {
    const EdgeView view = edge_view(s_.display(), s_.geometry(), bars_, from, pixel);
    if (view.edges.lines.empty()) return false;
    const Image picture = picture_of(view, bars_.upright, panel_->summed(), s_.rendering(), job_),
                white = picture_of(view, bars_.upright, white_, s_.rendering(), job_);
    spread.add(view.edges, picture, white);
    curves.lenses += view.lenses;
    return true;
}

void EdgePlane::measure(std::span<MtfCurves> all_curves) {
    std::vector<MtfCurves*> curves;  // of the angles at which lines of sight gave a modulation
    double blur_mm = 0;
    for (MtfCurves& m : all_curves) {
        if (!m.missing.empty()) continue;
        curves.push_back(&m);
        blur_mm = std::max(blur_mm, m.spread_mm);
    }
    if (curves.empty()) return;
    const double farthest = curves.back()->angle_deg;
    const auto [across, along] = seen_half_mm(s_.geometry(), bars_, eye(farthest));
    if (!(across > 0 && along > 0)) return;
    // Bars must fit also at the farthest angle.
    set_bars(blur_mm, farthest);
    set_pictures(curves);
    const double pixel = pixel_mm(curves.front()->frequencies_per_mm.back());
    std::vector<EdgeSpread> spreads(curves.size(), EdgeSpread(0.5 * bars_.width_mm / pixel));
    bool any = true;
    for (int k = 0; k < pictures_ && any; ++k) {
        show(k);
        any = k < pictures_ / 4;  // small screens may show an edge at some offsets only
        for (std::size_t n = 0; n < curves.size(); ++n) {
            EdgeEye from = eye(curves[n]->angle_deg);
            from.aside_mm = pixel * std::fmod(k * golden, 1);
            any = look(spreads[n], from, pixel, *curves[n]) || any;
        }
    }
    for (std::size_t n = 0; n < curves.size(); ++n) {
        MtfCurves& m = *curves[n];
        if (m.lenses == 0) continue;
        // The MTF, with all sets and without each; where too much light is missing at frequency 0, none is given.
        std::vector<double> per_pixel = m.frequencies_per_mm;
        for (double& f : per_pixel) f *= pixel;
        const auto all = spreads[n].mtf(per_pixel);
        if (!(all[1][0] > 1 - most_lost)) continue;
        for (std::size_t c = 0; c < 3; ++c) m.edges[c].all = all[c];
        for (int k = 0; k < independent_sets; ++k) {
            const auto without = spreads[n].mtf(per_pixel, k);
            for (std::size_t c = 0; c < 3; ++c) m.edges[c].without[std::size_t(k)] = without[c];
        }
    }
}

}  // namespace lfdsim
