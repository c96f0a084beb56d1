// Uniformity of colour. docs/measures.md, "Uniformity and efficiency".

#include "analysis/uniformity/uniformity_colour.h"

#include "analysis/core/figure_json.h"
#include "base/constants.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace lfdsim {
namespace {

constexpr int most_colour_parts_along = 48;
constexpr std::int64_t colour_lines_of_screen = std::int64_t(1) << 23;
constexpr int colour_lines_of_angle = 1 << 13, most_colour_angles = 257;
// Figures over angle are checked by angles between those, shifted by these parts of a step, with a quarter of the lines each.
constexpr std::array shifts{0.19, 0.43, 0.71};
constexpr int fewer_lines = 4;

/// Returns the number of lines of sight of each set in each part, a power of two from 64 to 2048.
int colour_lines_a_set(const ScreenParts& screen) {
    const std::int64_t each = colour_lines_of_screen / (screen.count() * independent_sets);
    return int(std::bit_floor(std::uint64_t(std::clamp<std::int64_t>(each, 64, 2048))));
}

/// The light of a block of lenses by all sets, and the share of its lines that are on the screen.
struct BlockLight {
    ColourSums light{};
    double on_screen = 0;
};

/// Traces `lines` lines of each set; the sets are those from `first_set` on.
BlockLight light_of_block(const ColouredWhite& white, const Subject& s, const Vec3d& eye, const ScreenParts& screen,
                          const LensBlock& block, int lines, int first_set) {
    BlockLight block_light;
    for (int set = 0; set < independent_sets; ++set) {
        const ColouredWhite::BlockColour seen =
            white.look(eye, screen, block, even_choices(lines, set_number(s.display().render.seed, first_set + set)));
        for (std::size_t c = 0; c < 3; ++c) block_light.light[c][std::size_t(set)] = seen.light[c];
        block_light.on_screen += seen.on_screen / independent_sets;
    }
    return block_light;
}

/// Returns the spread of colour over the parts that are on the screen. The others have no colour, and do not count as dark.
ColourSpread spread_on_screen(const std::vector<BlockLight>& parts, const std::vector<double>& lenses) {
    std::vector<ColourSums> light;
    std::vector<double> weights;
    std::vector<std::size_t> number;
    for (std::size_t k = 0; k < parts.size(); ++k) {
        if (parts[k].on_screen < least_on_screen) continue;
        light.push_back(parts[k].light);
        weights.push_back(lenses[k] * parts[k].on_screen);
        number.push_back(k);
    }
    ColourSpread spread = colour_spread(light, weights);
    std::vector<Chromaticity> colours(parts.size(), Chromaticity{nan, nan});
    std::vector<double> distances(parts.size(), nan);
    for (std::size_t n = 0; n < number.size(); ++n) {
        colours[number[n]] = spread.parts[n];
        distances[number[n]] = spread.distance[n];
    }
    spread.parts = std::move(colours);
    spread.distance = std::move(distances);
    return spread;
}

/// Returns the eyes' angles within the field of view: eight for each view, from 33 to 257.
std::vector<double> eyes_deg(const Subject& s) {
    const AxisTheory& t = s.theory(0);
    const double half = std::min(80., 0.5 * (is_strips(s.display().array) ? s.theory().fov_of_eyes_deg : t.fov_deg));
    const int each_side = std::clamp(int(std::ceil(4 * t.views)), 16, most_colour_angles / 2);
    std::vector<double> angles;
    for (int k = -each_side; k <= each_side; ++k) angles.push_back(half * k / each_side);
    return angles;
}

/// Adds figures of a spread: `name` in their paths, `of` in their labels, `missing` as the note if there is no light.
void add_spread(Result& result, const std::string& name, const std::string& of, const ColourSpread& spread, const char* missing) {
    for (const auto& [kind, difference] : {std::pair{"largest", spread.largest}, {"mean", spread.mean}}) {
        const std::string path = fmt::format("colour.{}_delta_uv_{}", name, kind);
        result.add(path, difference,
                   {.label = fmt::format("Colour of white {}: {} difference", of, kind),
                    .remark = "distance in u', v' (CIE 1976) from the mean colour of this light; 0.004 is just noticeable"});
        if (std::isnan(spread.together[0])) result.note(path, missing);
    }
}

/// Adds the spread of colour over the screen, on axis: figures, map and table.
void add_colour_of_screen(const ColouredWhite& white, const Subject& s, double distance, Parts& parts, Result& result) {
    const Vec3d eye{0, 0, distance};
    const ScreenParts screen(s.display(), s.geometry(), most_colour_parts_along);
    const int lines = colour_lines_a_set(screen) * white.more_for(eye);
    std::vector<BlockLight> light(std::size_t(screen.count()));
    std::vector<double> lenses;
    for (int k = 0; k < screen.count(); ++k) lenses.push_back(screen.block(k).lenses());
    parts.run(screen.count(), [&](int part) {
        light[std::size_t(part)] = light_of_block(white, s, eye, screen, screen.block(part), lines, independent_sets * part);
    });
    const ColourSpread spread = spread_on_screen(light, lenses);
    const auto [width, height] = screen.size_mm();
    add_spread(result, "screen", "over the screen, on axis", spread, "no light of the screen is seen on axis");
    Json& json = result.figures["colour"];
    json["screen_uv"] = numbers_json({spread.together[0], spread.together[1]});
    json["part_mm"] = {width / screen.columns(), height / screen.rows()};
    json["dark_parts"] = spread.dark;
    result.maps.push_back({"uniformity_colour", "Difference of colour over a white screen, seen on axis", "x along the array, mm",
                           "y, mm", "distance in u', v'", -width / 2, width / 2, -height / 2, height / 2, screen.columns(),
                           screen.rows(), spread.distance, 0, std::max(0.004, spread.largest.value + spread.largest.error)});
    DataTable table = DataTable::of_rows("uniformity_colour", {"column", "row", "u_prime", "v_prime", "delta_uv"});
    for (int k = 0; k < screen.count(); ++k) {
        const auto [u, v] = spread.parts[std::size_t(k)];
        table.add_row({double(k % screen.columns()), double(k / screen.columns()), u, v, spread.distance[std::size_t(k)]});
    }
    result.tables.push_back(std::move(table));
}

/// Returns the angles that lie between others, by a share of their step.
std::vector<double> between(const std::vector<double>& angles, double shift) {
    std::vector<double> shifted;
    for (std::size_t k = 0; k + 1 < angles.size(); ++k) shifted.push_back(angles[k] + shift * (angles[k + 1] - angles[k]));
    return shifted;
}

/// Returns the error of a mean over a few angles against that over all angles: the distance steps anywhere between two of them,
/// which is a standard deviation of 1/sqrt(12) of the step's height; twice that. Dark angles, which have no distance, are
/// skipped.
double between_angles(std::vector<double> distance) {
    std::erase_if(distance, [](double d) { return !std::isfinite(d); });
    double squares = 0;
    for (std::size_t k = 0; k + 1 < distance.size(); ++k) squares += std::pow(distance[k + 1] - distance[k], 2) / 12;
    return distance.empty() ? 0 : 2 * std::sqrt(squares) / double(distance.size());
}

/// Widens the error of a figure so that it covers the figure of other angles, less its error: colours change in steps where light
/// passes from one subpixel to the next.
void widen(Estimate& figure, const Estimate& found) {
    if (std::isfinite(figure.value) && std::isfinite(found.value))
        figure.error = std::max(figure.error, std::abs(found.value - figure.value) - found.error);
}

/// Adds the spread of colour over viewing angle of a block in the array's middle.
void add_colour_over_angle(const ColouredWhite& white, const Subject& s, double distance, Parts& parts, Result& result) {
    const std::vector<double> angles = eyes_deg(s);
    const ScreenParts screen(s.display(), s.geometry(), most_colour_parts_along);
    const LensBlock middle = screen.middle();
    const int lines = colour_lines_of_angle / independent_sets * white.more_for({0, 0, distance});
    const double nearest = nearest_eye_mm(s.geometry());
    Curves curves("uniformity_colour_angle", "Difference of colour of the middle of a white screen", "viewing angle, degrees",
                  "distance in u', v'", {"angle_deg", angles});
    for (const int axis : {0, 1}) {
        const std::string name = axis == 0 ? "horizontal" : "vertical";
        const auto seen_from = [&](const std::vector<double>& from_deg, int lines_a_set) {
            std::vector<ColourSums> light(from_deg.size());
            parts.run(int(from_deg.size()), [&](int k) {
                const double angle = from_deg[std::size_t(k)] * degree, across = distance * std::sin(angle);
                const Vec3d eye{axis == 0 ? across : 0, axis == 0 ? 0 : across, distance * std::cos(angle)};
                if (eye[2] > nearest) light[std::size_t(k)] = light_of_block(white, s, eye, screen, middle, lines_a_set, 0).light;
            });
            return colour_spread(light, std::vector(from_deg.size(), 1.));
        };
        ColourSpread spread = seen_from(angles, lines);
        for (const double shift : shifts) {
            const ColourSpread other = seen_from(between(angles, shift), lines / fewer_lines);
            widen(spread.largest, other.largest);
            widen(spread.mean, other.mean);
        }
        spread.mean.error = std::hypot(spread.mean.error, between_angles(spread.distance));
        add_spread(result, name, fmt::format("over {} angles to {:.3g} degrees", name, angles.back()), spread,
                   "no light of the screen's middle is seen");
        curves.add(name, name + "_delta_uv", spread.distance);
        for (const std::size_t i : {std::size_t(0), std::size_t(1)}) {
            Column& column = curves.table.columns.emplace_back(Column{name + (i == 0 ? "_u_prime" : "_v_prime"), {}});
            for (const Chromaticity& uv : spread.parts) column.values.push_back(uv[i]);
        }
    }
    curves.plot.marks.push_back({"0.004, just seen", 0.004, false});
    result.figures["colour"]["angle_deg"] = {angles.front(), angles.back()};
    result.add(std::move(curves));
}

}  // namespace

ColouredWhite::ColouredWhite(const Subject& s)
    : panel_(s.display().panel),
      pixels_{ChannelPixels(s.display(), 0), ChannelPixels(s.display(), 1), ChannelPixels(s.display(), 2)} {
    const Display& d = s.display();
    if (!disperses(d)) {
        paths_.push_back({EyeRays(d, s.geometry()), {1, 1, 1}});
        return;
    }
    for (std::size_t c = 0; c < 3; ++c)
        for (const auto& [geometry, weight] : light_paths(d, s.geometry(), c)) {
            ColourPath& path = paths_.emplace_back(ColourPath{EyeRays(d, geometry), {}});
            path.weight[c] = weight;
        }
}

ColouredWhite::BlockColour ColouredWhite::look(const Vec3d& eye, const ScreenParts& screen, const LensBlock& block,
                                               std::span<const Choice> choices) const {
    std::array<double, 3> sum{};
    double lines = 0;
    for (const Choice& choice : choices) {
        const Choice within = screen.within(block, choice);
        bool on_screen = true;  // the same for all paths
        for (const auto& [rays, weight] : paths_) {
            const Sight sight = rays.look(eye, within);
            on_screen = sight.on_screen;
            if (!on_screen) break;
            if (!(sight.light > 0)) continue;
            const ChannelPixels::Place place = pixel_place(panel_, sight);
            for (std::size_t c = 0; c < 3; ++c) {
                if (weight[c] == 0) continue;
                if (const auto shining = pixels_[c].at(place)) sum[c] += weight[c] * sight.light * shining->brightness;
            }
        }
        lines += on_screen;
    }
    if (lines > 0)
        for (double& light : sum) light /= lines;
    return {sum, lines / double(choices.size())};
}

ColourWork colour_work(const Subject& s) {
    if (!has_colours(s.display())) return {0, 0};
    const ScreenParts screen(s.display(), s.geometry(), most_colour_parts_along);
    const int angles = 2 * int(eyes_deg(s).size()), others = 2 * int(shifts.size()) * (angles / 2 - 1);
    const std::int64_t paths = disperses(s.display()) ? 3 * s.display().render.wavelength_samples : 1;
    return {screen.count() + angles + others,
            paths * (std::int64_t(colour_lines_a_set(screen)) * independent_sets * screen.count() +
                     (std::int64_t(angles) + others / fewer_lines) * colour_lines_of_angle)};
}

void tell_colour_uniformity(const Subject& s, double distance, Parts& parts, Result& result) {
    if (!has_colours(s.display())) {
        for (const char* of : {"screen", "horizontal", "vertical"})
            for (const char* kind : {"largest", "mean"}) result.add(fmt::format("colour.{}_delta_uv_{}", of, kind), Estimate{0, 0});
        result.remarks.push_back(
            "Colour is exactly uniform: without subpixels and dispersion red, green and blue take the same paths to the same "
            "points.");
        return;
    }
    const ColouredWhite white(s);
    add_colour_of_screen(white, s, distance, parts, result);
    add_colour_over_angle(white, s, distance, parts, result);
}

}  // namespace lfdsim
