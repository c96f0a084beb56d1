#include "analysis/edge_plane.h"

#include "analysis/mtf_theory.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

// An edge seen through a lens array is a mosaic; its mean profile means something only if each distance from the edge is seen
// through all parts of lenses and of panel pixels alike. So the edges of all pictures together lean over each other without gaps:
// bars are so long that an edge leans by a whole number of the steps between edges, which are the bars' width over the number of
// pictures.
namespace lfdsim {
namespace {

constexpr double radian = std::numbers::pi / 180;
constexpr int least_lenses = 400;  // that edges cross: so many phases of the lenses enter the mean
constexpr double golden = 0.6180339887498949;
constexpr int most_pictures = 32;                         // of one view, to reach as many
constexpr double systematic = 0.01;                       // of the modulation
constexpr double pixels_wanted = 8e5, most_pixels = 4e6;  // of all pictures of a view

}  // namespace

Estimate MtfCurves::below(std::size_t channel, double level) const {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    if (mtf[channel].empty() || too_much_lost()) return {nan, nan};
    Estimate found = jackknife(
        [&](int k) { return falls_below(frequencies_per_mm, k < 0 ? mtf[channel] : without[std::size_t(k)][channel], level); });
    if (!std::isfinite(found.value)) return found;
    // Light lost beyond the window may belong to the curve, and phases of lenses and pixels, bins and the window leave some of it.
    const double aside = std::hypot(systematic, uneven);
    const double lower = falls_below(frequencies_per_mm, mtf[channel], level + aside),
                 higher = falls_below(frequencies_per_mm, mtf[channel], level - aside - lost);
    found.error = std::hypot(found.error, std::max(found.value - lower, higher - found.value));
    return found;
}

double MtfCurves::theory_below(double level) const {
    return has_theory() ? falls_below(frequencies_per_mm, theory, level) : std::numeric_limits<double>::quiet_NaN();
}

EdgePlane::EdgePlane(const Subject& s, double depth_mm, bool horizontal, const Pyramid& white, const Job& job)
    : s_(s), white_(white), job_(job), depth_mm_(depth_mm), bars_{horizontal, s.geometry().vertex_plane_mm + depth_mm, 0, 0, 0} {}

Eye EdgePlane::eye(double angle_deg) const { return {angle_deg, s_.viewing_distance_mm()}; }

/// The lenses' pitch as seen in the edges' plane.
double EdgePlane::pitch_mm() const { return s_.display().array.pitch_mm * scale_to_bars(s_.geometry(), bars_, eye(0)); }

/// Makes bars wide enough to hold twice the blur, such that neighbouring edges meet the lenses in ever other phases. False: they do
/// not fit on the screen, and are as wide as does.
bool EdgePlane::set_bars(double blur_mm, double angle_deg) {
    const double pitch = pitch_mm(), tangent = std::tan(slant_deg * radian);
    const auto [across, along] = seen_half_mm(s_.display(), s_.geometry(), bars_, eye(angle_deg));
    const double most = 1.2 * (across - along * tangent);
    bars_.width_mm = (std::max(1., std::ceil(2 * blur_mm / pitch - golden)) + golden) * pitch;
    const bool fit = bars_.width_mm <= most;
    if (!fit) bars_.width_mm = most;
    const double step = bars_.width_mm / std::cos(slant_deg * radian), lean = 2 * along * tangent;
    pictures_ = std::clamp(int(std::ceil(step / lean)), 4, most_pictures);
    const double least = std::min(lean, step / pictures_);
    bars_.length_mm = std::floor(lean / least) * least / tangent;
    return fit;
}

/// Takes more pictures where too few edges fit into one.
void EdgePlane::set_pictures(const std::vector<double>& angles) {
    double fewest = least_lenses;
    constexpr int places = 8;
    for (const double angle : angles) {
        double lenses = 0;
        for (int k = 0; k < places; ++k) {
            bars_.offset_mm = bars_.width_mm * k / places;
            lenses += edge_view(s_.display(), s_.geometry(), bars_, eye(angle), bars_.width_mm / 8).lenses;
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

/// Of the pictures, in the edges' plane: a quarter of the finest period at most.
double EdgePlane::pixel_mm(double most_per_mm) const {
    const double across = seen_half_mm(s_.display(), s_.geometry(), bars_, eye(0))[0];
    const double area = pictures_ * bars_.length_mm * 2 * across;
    const double fine =
        std::max(std::min({std::sqrt(area / pixels_wanted), 0.25 / most_per_mm, 0.1 * pitch_mm()}), std::sqrt(area / most_pixels));
    return pitch_mm() / (std::ceil(pitch_mm() / fine) + golden);
}

/// Adds the picture that an eye sees. False: there is no edge in it.
bool EdgePlane::look(EdgeSpread& spread, Eye from, double pixel, MtfCurves& curves) const {
    const EdgeView view = edge_view(s_.display(), s_.geometry(), bars_, from, pixel);
    if (view.edges.lines.empty()) return false;
    const Image picture = picture_of(view, bars_.upright, panel_->pyramid(), s_.threads(), job_),
                white = picture_of(view, bars_.upright, white_, s_.threads(), job_);
    spread.add(view.edges, picture, white);
    curves.lenses += view.lenses;
    return true;
}

/// Whether more than a twentieth of the light goes farther astray than an edge reaches.
bool EdgePlane::strays(double angle_deg) {
    show(0);
    const double pixel = std::max(pixel_mm(0), bars_.width_mm / 64);
    EdgeSpread spread(0.5 * bars_.width_mm / pixel);
    MtfCurves none{};
    return !look(spread, eye(angle_deg), pixel, none) || !(spread.mtf(std::array{0.})[1][0] > 0.95);
}

/// What is known before measuring. Frequencies go to the first zero of a pixel's image or, where the blur is far wider, to where
/// next to nothing is left.
MtfCurves EdgePlane::blank(double angle_deg, double blur_mm) const {
    const Eye at = eye(angle_deg);
    const double cosine = std::cos(angle_deg * radian);  // by so much the plane is foreshortened to the side
    const double mm_per_deg = (at.z_mm() - bars_.z_mm) / cosine * radian / (bars_.upright ? cosine : 1);
    MtfCurves m{depth_mm_, angle_deg, bars_.upright, mm_per_deg, {}, {}, light_astray(s_, angle_deg, at.distance_mm), 0, {}, {}};
    const Blur by_theory = blur(s_.display(), s_.geometry(), s_.theory(), bars_.z_mm, angle_deg);
    const double most = 1 / std::max(by_theory.pixel_mm, 0.25 * blur_mm);
    constexpr int steps = 160;
    for (int k = 0; k <= steps; ++k) {
        m.frequencies_per_mm.push_back(most * k / steps);
        m.theory.push_back(by_theory.mtf(m.frequencies_per_mm.back(), bars_.upright));
    }
    if (const double half = m.theory_below(0.5); std::isfinite(half))
        m.uneven = std::abs(mtf_of_lines(s_, bars_, at, half) - by_theory.mtf(half, bars_.upright));
    return m;
}

std::vector<MtfCurves> EdgePlane::measure(const std::vector<double>& angles) {
    const double farthest = angles.back();
    double blur_mm = blur(s_.display(), s_.geometry(), s_.theory(), bars_.z_mm, farthest).width_mm(bars_.upright);
    const auto [across, along] = seen_half_mm(s_.display(), s_.geometry(), bars_, eye(farthest));
    const bool seen = across > 0 && along > 0 && !at_the_lenses(s_.display(), s_.geometry(), bars_.z_mm);
    while (seen && set_bars(blur_mm, farthest) && strays(angles.front())) blur_mm *= 3;

    std::vector<MtfCurves> all;
    for (const double angle : angles) all.push_back(blank(angle, blur_mm));
    if (!seen) return all;
    set_pictures(angles);
    const double pixel = pixel_mm(all.front().frequencies_per_mm.back());
    std::vector<EdgeSpread> spreads(all.size(), EdgeSpread(0.5 * bars_.width_mm / pixel));
    bool any = true;
    for (int k = 0; k < pictures_ && any; ++k) {
        show(k);
        any = k < pictures_ / 4;  // small screens may hold an edge at some places only
        for (std::size_t n = 0; n < all.size(); ++n) {
            Eye from = eye(angles[n]);
            from.aside_mm = pixel * std::fmod(k * golden, 1);
            any = look(spreads[n], from, pixel, all[n]) || any;
        }
    }
    for (std::size_t n = 0; n < all.size(); ++n) {
        MtfCurves& m = all[n];
        if (m.lenses == 0) continue;
        std::vector<double> per_pixel = m.frequencies_per_mm;
        for (double& f : per_pixel) f *= pixel;
        m.mtf = spreads[n].mtf(per_pixel);
        for (int k = 0; k < independent_sets; ++k) m.without[std::size_t(k)] = spreads[n].mtf(per_pixel, k);
        m.lost = std::max(1 - m.mtf[1][0], 0.);
        for (std::vector<double>& curve : m.mtf) curve[0] = 1;  // of edges without end
        for (auto& curves : m.without)
            for (std::vector<double>& curve : curves) curve[0] = 1;
    }
    return all;
}

}  // namespace lfdsim
