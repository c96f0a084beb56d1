#include "analysis/moire/moire_theory.h"

#include "analysis/moire/eye_filter.h"
#include "analysis/spots/aperture_wave.h"
#include "base/constants.h"
#include "geometry/diffuser_profile.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace lfdsim {
namespace {

constexpr double least_contrast = 1e-6;  // below it a harmonic is rounding
constexpr double least_seen = 1e-5;      // after the eye's filter: less is nothing
constexpr double tied = 0.99;            // of the strongest wave's contrast: no measurement tells such twins apart

}  // namespace

double period_mm(const Frequency& f) { return 1 / std::hypot(f[0], f[1]); }

double direction_deg(const Frequency& f) {
    const double turn = std::atan2(f[1], f[0]) / degree;
    const double half = turn < 0 ? turn + 180 : turn;
    return half < 180 ? half + 0. : 0;  // not -0
}

MoireTheory::MoireTheory(const Display& d, const Geometry& g, double eye_mm, const ChannelWeights& weights)
    : display_(d), geometry_(g), panel_(d.panel, weights), eye_mm_(eye_mm) {
    const double e = 1 + g.gap_mm / (eye_mm - g.rear_principal_mm),
                 power = std::isfinite(g.focal_length_mm) ? g.gap_mm / g.focal_length_mm : 0;
    // Along strips light passes plane plates.
    scale_ = {e, g.lattice.strips ? 1 + g.reduced_vertex_plane_mm / (eye_mm - g.vertex_plane_mm) : e};
    glass_ = {power, g.lattice.strips ? 0 : power};
}

MoireTheory::WaveVector MoireTheory::to_array(WaveVector v) const {
    const double c = geometry_.lattice.cos_turn, s = geometry_.lattice.sin_turn;
    return {c * v.x + s * v.y, c * v.y - s * v.x};
}

Frequency MoireTheory::to_display(WaveVector v) const {
    const double c = geometry_.lattice.cos_turn, s = geometry_.lattice.sin_turn;
    return {c * v.x - s * v.y, s * v.x + c * v.y};
}

/// A harmonic of the panel as it lies in the vertex plane before the lenses sample it, in the array's frame.
MoireTheory::WaveVector MoireTheory::seen_harmonic(int k, int l) const {
    // Rows count downwards.
    const double pixel = display_.panel.pixel_pitch_mm;
    const WaveVector panel = to_array({k / (panel_.cell()[0] * pixel), -l / (panel_.cell()[1] * pixel)});
    return {scale_.x * panel.x, scale_.y * panel.y};
}

/// The lattice's harmonics along an axis within reach of a panel harmonic.
MoireTheory::OrderRange MoireTheory::lens_orders(int axis, double panel, double reach) const {
    if (axis == 1 && geometry_.lattice.strips) return {0, 0};
    const double step = lens_harmonic(axis == 0, axis == 1).x + lens_harmonic(axis == 0, axis == 1).y;
    return {int(std::ceil((panel - reach) / step)), int(std::floor((panel + reach) / step))};
}

/// (m/px, n/py); where rows are staggered, (m/px, n/2py), of which those with odd m + n vanish.
MoireTheory::WaveVector MoireTheory::lens_harmonic(int m, int n) const {
    const Lattice<double>& lattice = geometry_.lattice;
    if (lattice.strips) return {m / lattice.pitch[0], 0};
    return {m / lattice.pitch[0], n / lattice.pitch[1] * (lattice.staggered ? 0.5 : 1)};
}

Frequency MoireTheory::beat(int k, int l) const {
    const WaveVector panel = seen_harmonic(k, l);
    const Lattice<double>& lattice = geometry_.lattice;
    const double reach_x = 1 / lattice.pitch[0], reach_y = 1 / lattice.pitch[1];
    const OrderRange across = lens_orders(0, panel.x, reach_x), up = lens_orders(1, panel.y, reach_y);
    WaveVector best{infinity, 0};
    for (int m = across.from; m <= across.to; ++m)
        for (int n = up.from; n <= up.to; ++n) {
            if (lattice.staggered && (m + n) % 2 != 0) continue;
            const WaveVector lens = lens_harmonic(m, n), f{panel.x - lens.x, panel.y - lens.y};
            if (std::hypot(f.x, f.y) < std::hypot(best.x, best.y)) best = f;
        }
    return to_display(best);
}

/// The mean of exp(-2 pi i nu angle) over the diffuser's angles; its axes are the display's.
double MoireTheory::diffuser(WaveVector nu) const {
    if (!display_.diffuser) return 1;
    const Frequency along = to_display(nu);
    double mean = 1;
    for (std::size_t k = 0; k < 2; ++k) {
        const double angle = display_.diffuser->angle_deg[k] * degree;
        mean *= figures_of(display_.diffuser->profile).transfer(angle * along[k]);
    }
    return mean;
}

std::optional<Beat> MoireTheory::strongest(const EyeFilter& eye) const {
    if (lights_whole_pixels(display_.panel)) return {};
    const Lattice<double>& lattice = geometry_.lattice;
    const ApertureShape aperture = aperture_shape(display_, geometry_);
    const double per_degree = mm_per_degree(eye_mm_ - geometry_.vertex_plane_mm),
                 finest = eye.finest_cycles_per_degree / per_degree;
    const double above = geometry_.diffuser_z_mm.value_or(geometry_.rear_principal_mm) - geometry_.rear_principal_mm;
    struct PanelHarmonic {
        int k, l;
        double most;
    };
    std::vector<PanelHarmonic> harmonics;
    const auto [highest_k, highest_l] = panel_.highest_order();
    for (int k = 0; k <= highest_k; ++k)
        for (int l = k == 0 ? 1 : -highest_l; l <= highest_l; ++l)
            if (const double most = 2 * std::abs(panel_.harmonic(k, l)); most >= least_contrast) harmonics.push_back({k, l, most});
    std::ranges::stable_sort(harmonics, std::greater(), &PanelHarmonic::most);
    std::vector<Beat> strong;  // within `tied` of the strongest so far
    double greatest = least_seen;
    // Most harmonics of the lens lattice, for near eyes a million for each of the panel's, are known to be weak by bounds alone:
    // those near the greatest mean over the aperture come first.
    for (const double nearest : {2., infinity})
        for (const auto& [k, l, most] : harmonics) {
            if (most < tied * greatest) break;
            const WaveVector seen = seen_harmonic(k, l), panel{seen.x / scale_.x, seen.y / scale_.y};
            const WaveVector on_lens{glass_.x * panel.x, glass_.y * panel.y};
            const auto orders = [&](int axis, double of_panel, double of_aperture) {
                const OrderRange fine = lens_orders(axis, of_panel, finest);
                if (!std::isfinite(nearest)) return fine;
                const OrderRange near = lens_orders(axis, of_aperture, nearest / lattice.pitch[std::size_t(axis)]);
                return OrderRange{std::max(fine.from, near.from), std::min(fine.to, near.to)};
            };
            const OrderRange across = orders(0, seen.x, on_lens.x), up = orders(1, seen.y, on_lens.y);
            for (int m = across.from; m <= across.to; ++m) {
                if (most * aperture.most(std::abs(on_lens.x - lens_harmonic(m, 0).x)) < tied * greatest) continue;
                for (int n = up.from; n <= up.to; ++n) {
                    if (lattice.staggered && (m + n) % 2 != 0) continue;
                    const WaveVector of_lens = lens_harmonic(m, n), f{seen.x - of_lens.x, seen.y - of_lens.y},
                                     nu{on_lens.x - of_lens.x, on_lens.y - of_lens.y};
                    const double fine = std::hypot(f.x, f.y),
                                 at_most = most * aperture.most(lattice.strips ? std::abs(nu.x) : std::hypot(nu.x, nu.y));
                    if (fine > finest || at_most < tied * greatest) continue;
                    // A diffuser's angle t moves a line by `above` t in the lens and by g t more on the panel.
                    const WaveVector spread{above * (panel.x - of_lens.x) + geometry_.gap_mm * panel.x,
                                            above * (panel.y - of_lens.y) +
                                                (lattice.strips ? geometry_.reduced_vertex_plane_mm : geometry_.gap_mm) * panel.y};
                    const double diffused = std::abs(diffuser(spread)), filter = eye.filter(fine * per_degree);
                    if (at_most * diffused * filter < tied * greatest) continue;
                    Beat beat{to_display(f), most * diffused * std::abs(aperture.mean(nu.x, nu.y)), 0, to_display(spread)};
                    beat.seen = beat.contrast * filter;
                    if (beat.seen < tied * greatest) continue;
                    greatest = std::max(greatest, beat.seen);
                    strong.push_back(beat);
                }
            }
        }
    const auto first = std::ranges::max_element(strong, {}, &Beat::seen);
    if (first == strong.end()) return {};
    const auto rank = [](const Beat& b) { return rank_deg(direction_deg(b.frequency)); };
    Beat best = *first;
    for (const Beat& b : strong) {
        const bool equal = b.seen >= (1 - 1e-6) * first->seen;
        const bool twin = b.seen >= tied * first->seen && std::abs(period_mm(b.frequency) / period_mm(first->frequency) - 1) < 1e-3;
        if ((equal || twin) && rank(b) < rank(best)) best = b;
    }
    return best;
}

}  // namespace lfdsim
