// Verdicts on the panel's pixels: those on borders of elemental images, and colours that stay apart.

#include "analysis/crosstalk/intended_panel.h"
#include "analysis/verdicts/quick_look.h"
#include "analysis/verdicts/verdict_parts.h"
#include "content/pickup/shown_points.h"
#include "geometry/dark_bands.h"
#include "geometry/lens_misalignment.h"
#include "geometry/resolve.h"
#include "geometry/seen_width.h"

#include <algorithm>

namespace lfdsim {
namespace {

// Share of the panel's light whose pixels have their centres on borders of elemental images
constexpr double most_on_borders = 0.1;
constexpr double most_visible_contrast = 0.05;  // of colours, after the eye's filter

double share_on_borders(const Display& d, const Geometry& g) { return MeantPanel(d, g, d.content.sampling).share_on_borders(); }

bool is_stripes(SubpixelLayout layout) { return layout == SubpixelLayout::rgb_stripe || layout == SubpixelLayout::bgr_stripe; }

/// Returns the remedy that mixes the colours, found by trial: colours along the strips, slanted strips, a diffuser.
std::string mixing_remedy(const Display& d, const Geometry& g, const Theory& t, const ColourWave& wave) {
    const auto helps = [](const Display& changed) {
        if (!is_valid(changed)) return false;
        const std::optional<ColourWave> left = colour_wave(changed, resolve(changed));
        return !left || left->visible < most_visible_contrast;
    };
    if (is_strips(d.array) && is_stripes(d.panel.subpixels)) {
        Display turned = d;
        turned.panel.subpixels = SubpixelLayout::rgb_rows;
        if (helps(turned))
            return "A panel whose colours follow each other along the strips shows none (--set 'panel.subpixels=\"rgb_rows\"')";
    }
    if (is_strips(d.array) && t.along[0].views > 2.5)  // the two views of upright strips would mix under slanted ones
        for (const double share : {1 / 6., 1 / 3.}) {
            Display leaning = d;
            leaning.array.slant_deg = std::atan(share) / degree;
            if (helps(leaning)) return fmt::format("Slant the strips (--set array.slant_deg={:.4g})", *leaning.array.slant_deg);
        }
    // A diffuser must take no more than a quarter of the field of view along either axis (of strips along both of that across
    // them), or it mixes views as well, and must make no dark bands in place of coloured ones. It is tried at its present distance
    // and near the lenses, with angles that move the wave by 1, 1.5 and 2 periods.
    const double near = 0.5 * std::min(lens_pitch_mm(g, 0), lens_pitch_mm(g, 1));
    const auto most = [&](std::size_t k) { return 0.25 * t.along[array_axis(g, k)].fov_deg; };
    const auto bands = [](const Display& of) {
        const auto [across, up] = band_contrast(of, resolve(of));
        return std::isnan(up) ? across : std::max(across, up);
    };
    const double most_bands = std::max(visible_band_contrast, bands(d));
    for (const double distance : {d.diffuser ? d.diffuser->distance_mm : near, near})
        for (const double periods : {1., 1.5, 2.}) {
            Display diffused = d;
            diffused.diffuser = d.diffuser.value_or(Diffuser{});
            diffused.diffuser->distance_mm = distance;
            std::array<double, 2>& angle = diffused.diffuser->angle_deg;
            for (const std::size_t k : {0u, 1u})
                if (const double per_degree = std::abs(wave.turned_per_degree[k]); per_degree > 1e-3)
                    angle[k] = std::max(angle[k], std::min(periods / per_degree, most(k)));
            if (helps(diffused) && !(bands(diffused) > most_bands))
                return fmt::format(
                    "A diffuser of {0:.3g} x {1:.3g} degrees {2:.3g} mm in front of the lenses mixes them (--set "
                    "diffuser.distance_mm={2:.3g} 'diffuser.angle_deg=[{0:.3g}, {1:.3g}]')",
                    angle[0], angle[1], distance);
        }
    return "Use smaller pixels, or lenses and a gap through which an eye sees more of the panel at once";
}

/// Returns the remedy that keeps pixels' centres clear of borders, found by trial: the array moved by a part of a pixel, or a
/// panel with a column or row more.
std::string border_remedy(const Display& d) {
    const auto helps = [](const Display& changed) {
        return is_valid(changed) && share_on_borders(changed, resolve(changed)) < most_on_borders;
    };
    std::string remedy;
    const double half = 0.5 * d.panel.pixel_pitch_mm;
    for (const auto [x, y] : {std::array{half, 0.}, {0., half}, {half, half}, {0.5 * half, 0.}, {0.5 * half, 0.5 * half}}) {
        Display moved = d;
        moved.array.offset_mm[0] += x;
        moved.array.offset_mm[1] += y;
        if (!helps(moved)) continue;
        remedy = fmt::format("Move the array by a part of a pixel (--set 'array.offset_mm=[{:.6g}, {:.6g}]')",
                             moved.array.offset_mm[0], moved.array.offset_mm[1]);
        break;
    }
    for (const auto [columns, rows] : {std::array{1, 0}, {0, 1}, {1, 1}}) {
        Display larger = d;
        larger.panel.pixels[0] += columns;
        larger.panel.pixels[1] += rows;
        if (!helps(larger)) continue;
        remedy += fmt::format("{} a panel of {} x {} pixels (--set 'panel.pixels=[{}, {}]')", remedy.empty() ? "Use" : ", or use",
                              larger.panel.pixels[0], larger.panel.pixels[1], larger.panel.pixels[0], larger.panel.pixels[1]);
        break;
    }
    return remedy.empty() ? "Move the array (array.offset_mm), or use another pitch (array.pitch_mm)" : remedy;
}

}  // namespace

std::optional<std::string> on_borders(const Display& d, const Geometry& g) {
    const double share = share_on_borders(d, g);
    if (!(share >= most_on_borders)) return {};
    return fmt::format(
        "the centres of {:.0f} % of the {} lie on the border of two lenses' elemental images: both lenses show half of each, and "
        "rounding decides to which lens, and so to which eye, its content is assigned. {}",
        100 * share, made_by_channel(d) ? "subpixels" : "pixels", border_remedy(d));
}

std::optional<std::string> on_colours(const Display& d, const Geometry& g, const Theory& t) {
    const std::optional<ColourWave> wave = colour_wave(d, g);
    if (!wave || !(wave->visible > most_visible_contrast)) return {};
    const std::string seen = std::isinf(wave->period_mm) ? "has one tint, which changes as the eye moves"
                                                         : fmt::format("has coloured bands {} mm wide, {:.2g} per degree",
                                                                       digits(wave->period_mm), wave->cycles_per_degree);
    return fmt::format(
        "the lenses show the panel's red, green and blue apart: a white screen {} (red or blue against luminance: contrast "
        "{:.2f}). {}",
        seen, wave->contrast, mixing_remedy(d, g, t, *wave));
}

}  // namespace lfdsim
