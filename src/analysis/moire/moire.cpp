// The measure of moire: its figures, texts and map. docs/measures.md, "Moire".

#include "analysis/moire/moire.h"

#include "analysis/core/channel_pixels.h"
#include "analysis/core/figure_json.h"
#include "analysis/moire/eye_filter.h"
#include "base/constants.h"
#include "geometry/subpixels.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

constexpr int map_side = 64, map_lines = 256;  // squares along each axis, and lines in each

/// Returns a map of the luminance (mixture 0) of the screen's middle, `side` mm wide and high, as the eye sees it. Takes map_side
/// parts.
ColourMap moire_map(const WhiteSeen& screen, const Vec3d& eye, double side, Parts& parts) {
    const std::vector<Choice> choices = even_choices(map_lines);
    std::vector<double> values(std::size_t(map_side) * map_side);
    const double square = side / map_side;
    parts.run(map_side, [&](int row) {
        std::vector<WhiteLight> light;
        for (int column = 0; column < map_side; ++column) {
            double sum = 0;
            for (const Choice& c : choices) {
                screen.look(eye, (column + 0.5 + 0.5 * c[0]) * square - side / 2, side / 2 - (row + 0.5 + 0.5 * c[1]) * square,
                            c[2], c[3], light);
                sum += light[0].seen;
            }
            values[std::size_t(row) * map_side + std::size_t(column)] = sum / map_lines;
        }
    });
    const double greatest = std::ranges::max(values);
    return {"moire",
            fmt::format("A white screen, seen on axis, averaged over squares of {:.3g} mm", square),
            "x, mm",
            "y, mm",
            "of the panel's",
            -side / 2,
            side / 2,
            -side / 2,
            side / 2,
            map_side,
            map_side,
            std::move(values),
            0,
            greatest > 0 ? greatest : 1};
}

/// A moire wave as measured or by theory.
struct WaveEstimates {
    Estimate period_mm, direction_deg, seen, contrast;
};

/// A figure of a wave, and its line in the report.
struct WaveFigure {
    const char* name;  // for scripts, after the path
    Estimate WaveEstimates::*of;
    const char *label, *unit, *remark;
};
constexpr WaveFigure wave_figures[] = {
    {"period_mm", &WaveEstimates::period_mm, "period", "mm",
     "in the vertex plane, of the strongest component after the eye's filter"},
    {"direction_deg", &WaveEstimates::direction_deg, "direction", "deg",
     "direction of the wave vector, counter-clockwise from the right, modulo 180"},
    {"contrast", &WaveEstimates::seen, "contrast to the eye", "",
     "Michelson contrast times the contrast sensitivity relative to its maximum (Mannos and Sakrison 1974)"},
    {"contrast_unfiltered", &WaveEstimates::contrast, "contrast before the eye", "",
     "theory: for lenses without aberrations, with which a wave can be weaker or stronger"}};

/// Adds a wave's figures for scripts, under a path that ends with a dot.
void add_wave(Result& result, const std::string& path, const WaveEstimates& wave, bool with_errors, const std::string& missing) {
    for (const WaveFigure& f : wave_figures) {
        FigureValue value(wave.*f.of, missing);
        if (!with_errors) value.errors.clear();
        result.add(path + f.name, value);
    }
}

/// Adds a wave's lines of the report's table.
void add_lines(Result& result, const WaveEstimates& found, const WaveEstimates& theory, const std::string& missing) {
    for (const WaveFigure& f : wave_figures)
        result.add_line({found.*f.of, missing}, {.label = fmt::format("Moire of a white screen: {}", f.label),
                                                 .unit = f.unit,
                                                 .theory = (theory.*f.of).value,
                                                 .remark = f.remark});
}

/// Returns a wave of theory, with contrast 0 if there is none.
WaveEstimates theory_wave(const std::optional<Beat>& beat) {
    if (!beat) return {{nan, 0}, {nan, 0}, {0, 0}, {0, 0}};
    return {{period_mm(beat->frequency), 0}, {direction_deg(beat->frequency), 0}, {beat->seen, 0}, {beat->contrast, 0}};
}

/// The pattern in the luminance or in one channel, as measured.
struct Pattern {
    WaveEstimates found{{nan, nan}, {nan, nan}, {0, 0}, {0, 0}};
    MoireSearch search;
    std::string missing;  // why there is no period
};

/// Finds the pattern; if no wave is detected, its contrast is 0 with the least detectable one as its error.
Pattern pattern_of(const WhiteLines& lines, const HarmonicLines& harmonics, const std::optional<Beat>& theory,
                   double mm_per_degree) {
    Pattern pattern;
    pattern.search = find_moire(lines, harmonics, theory, mm_per_degree);
    if (const std::optional<MeasuredBeat>& m = pattern.search.strongest) {
        pattern.found = {m->period_mm, m->direction_deg, m->seen, m->contrast};
        return pattern;
    }
    pattern.found.seen.error = pattern.found.contrast.error = pattern.search.least;
    pattern.missing = fmt::format(
        "no wave with 3 periods or more in the middle of the screen, {:.3g} x {:.3g} mm, has more than the contrast {:.2g}, the "
        "least that the noise of the sampled lines of sight allows to detect",
        lines.window().width_mm(), lines.window().height_mm(), pattern.search.least);
    return pattern;
}

/// Adds waves that may be as strong, and a remark if theory's wave is too long to be measured.
void remark_on(const Pattern& pattern, const std::optional<Beat>& theory, double side, Result& result) {
    Json& others = result.figures["as_strong"] = Json::array();
    for (const MeasuredBeat& m : pattern.search.as_strong) {
        Json& json = others.emplace_back(Json::object());
        write_value(json, "period_mm", m.period_mm);
        write_value(json, "direction_deg", m.direction_deg);
        write_value(json, "contrast", m.seen);
        result.remarks.push_back(fmt::format("Within the errors a wave of {:.4g} mm at {:.4g} degrees may be as strong: {:.3g}.",
                                             m.period_mm.value, m.direction_deg.value, m.seen.value));
    }
    if (theory && 3 * period_mm(theory->frequency) > side)
        result.remarks.push_back(
            "The wave predicted by theory is too long to be measured: less than three of its periods are in the evaluated part of "
            "the screen.");
}

/// Returns the mixtures that are measured: the luminance, and each channel if they differ.
std::vector<ChannelWeights> mixtures(const Display& d) {
    if (!has_colours(d)) return {luminance_weights};
    return {luminance_weights, only(0), only(1), only(2)};
}

}  // namespace

std::int64_t moire_steps(const Subject& s) { return pictures_worth(s, lights_whole_pixels(s.display().panel) ? 1 : 9'000'000); }

Result measure_moire(Subject& s, Job& job) {
    const double distance = checked_viewing_distance_mm(s);
    const Display& d = s.display();
    Result result;
    result.figures["viewing_distance_mm"] = distance;
    result.remarks.push_back(
        "A grey screen has the same pattern: all of its pixels emit alike, so period, direction and contrast are those of white.");
    if (lights_whole_pixels(d.panel)) {
        const std::string none = "the panel has no pixel structure: it has no subpixels, and panel.aperture_ratio is 1";
        const WaveEstimates found = Pattern().found, theory = theory_wave({});
        add_wave(result, "white.", found, true, none);
        add_wave(result, "theory.", theory, false, none);
        add_lines(result, found, theory, none);
        job.advance(moire_steps(s));
        return result;
    }
    // The same lines serve the luminance and the channels; mixture 0 is the luminance.
    const Vec3d eye{0, 0, distance};
    const Window window = middle_of_screen(d, s.geometry(), distance);
    result.figures["window_mm"] = {window.width_mm(), window.height_mm()};
    Parts parts(job, s.threads(), window.rows + LineEnds::rows + map_side, moire_steps(s));
    const std::vector<ChannelWeights> weights = mixtures(d);
    const WhiteSeen screen(d, s.geometry(), weights);
    const std::vector<WhiteLines> lines = WhiteLines::of(screen, d.render.seed, eye, window, parts);
    const LineEnds ends(screen, d.render.seed, eye, window, parts);
    for (std::size_t mixture = 0; mixture < weights.size(); ++mixture) {
        if (!(lines[mixture].mean() > 0)) throw InputError("camera", "sees no light of a white panel from straight in front of it");
        const bool all = mixture == 0;
        const std::size_t channel = mixture - 1;
        const std::string of = all ? "." : fmt::format(".{}.", "rgb"[channel]);
        const Geometry geometry = all ? s.geometry() : resolve(d, d.panel.wavelengths_nm[channel]);
        const std::optional<Beat> theory = MoireTheory(d, geometry, distance, weights[mixture]).strongest();
        const Pattern pattern = pattern_of(lines[mixture], HarmonicLines(ends, screen, mixture), theory,
                                           mm_per_degree(distance - s.geometry().vertex_plane_mm));
        add_wave(result, "white" + of, pattern.found, true, pattern.missing);
        add_wave(
            result, "theory" + of, theory_wave(theory), false,
            fmt::format("all beats are finer than {:g} cycles per degree, which eyes do not resolve, or of negligible contrast",
                        eye_limit_cycles_per_degree));
        if (!all) continue;
        double side = std::min(window.width_mm(), window.height_mm());
        remark_on(pattern, theory, side, result);
        add_lines(result, pattern.found, theory_wave(theory), pattern.missing);
        if (pattern.search.strongest) side = std::min(side, 6 * pattern.found.period_mm.value);
        result.maps.push_back(moire_map(screen, eye, side, parts));
    }
    return result;
}

}  // namespace lfdsim
