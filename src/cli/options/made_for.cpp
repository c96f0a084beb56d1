#include "cli/options/made_for.h"

#include "display/keys.h"
#include "files/description/display_file.h"
#include "geometry/geometry.h"
#include "geometry/lens_misalignment.h"
#include "geometry/subpixels.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace lfdsim::cli {
namespace {

/// A key or length of a display, and its numbers.
struct Said {
    const char* key;
    std::vector<double> values;
};

/// The display that a picture was made for, as its metadata describes it.
struct IntendedDisplay {
    Display display;
    Geometry geometry;
};

// Returns the display of a picture's metadata; nothing where there is none, or where the reader of descriptions refuses it, since
// any program may have written it.
std::optional<IntendedDisplay> made_for(const Metadata& about) {
    const auto text = about.find("display");
    if (text == about.end()) return {};
    try {
        Display display = parse_display(text->second, "display");
        Geometry geometry = resolve(display);
        return IntendedDisplay{std::move(display), std::move(geometry)};
    } catch (const InputError&) {
        return {};
    }
}

// Returns the numbers that nodal elemental images depend on, except the model's and errors of assembly. Lengths on the lens's axis
// represent the lens, however it is described.
std::vector<Said> pickup_of(const Display& d) {
    const Geometry g = resolve(without_errors(d));
    return {{"panel.pixel_pitch_mm", {d.panel.pixel_pitch_mm}},
            {"array.count", {g.lattice.count[0], g.lattice.count[1]}},
            {"array.pitch_mm", {d.array.pitch_mm.begin(), d.array.pitch_mm.end()}},
            {"array.gap_mm", {g.gap_mm}},
            {"array.offset_mm", {d.array.offset_mm[0], d.array.offset_mm[1]}},
            {"array.rotation_deg", {d.array.turn_deg()}},
            {"content.viewing_distance_mm", {d.content.viewing_distance_mm}},
            {"distance of the lens's principal planes", {g.rear_principal_mm - g.front_principal_mm}},
            {"distance of its vertex from them", {g.vertex_plane_mm - g.rear_principal_mm}}};
}

std::vector<Said> camera_of(const IntendedDisplay& made) {
    const Camera& c = made.display.camera;
    return {{"camera.position_mm", {c.position_mm.begin(), c.position_mm.end()}},
            {"camera.target_mm", {c.target_mm.begin(), c.target_mm.end()}},
            {"camera.up", {c.up.begin(), c.up.end()}},
            {"camera.frame_width_mm", {made.geometry.frame_width_mm}},
            {"camera.resolution", {double(c.resolution[0]), double(c.resolution[1])}}};
}

// Returns numbers with ten digits: those of one length that is described in two ways may differ in further digits.
std::string text_of(const Said& said) { return fmt::format("{:.10g}", fmt::join(said.values, ",")); }

bool same(const Said& a, const Said& b) {
    for (std::size_t k = 0; k < a.values.size(); ++k)
        if (a.values[k] != b.values[k] && !(std::abs(a.values[k] - b.values[k]) <= 1e-9 * std::max(1., std::abs(a.values[k]))))
            return false;
    return true;
}

/// Returns the differences as "array.gap_mm 3.2, not 3.4; ...", the first's values and then the second's.
std::string differences(const std::vector<Said>& first, const std::vector<Said>& second) {
    std::vector<std::string> all;
    for (std::size_t k = 0; k < first.size(); ++k)
        if (!same(first[k], second[k]))
            all.push_back(fmt::format("{} {}, not {}", first[k].key, text_of(first[k]), text_of(second[k])));
    return fmt::format("{}", fmt::join(all, "; "));
}

/// Returns whether two displays have the same errors of assembly, apart from tables of single lenses.
bool same_errors(Errors a, Errors b) {
    for (Errors* e : {&a, &b}) e->table.clear(), e->given.reset();
    return a == b;
}

/// Whether a panel image depends on the lenses: elemental images, and patterns that are made for them.
bool drawn_for_lenses(const Metadata& about) {
    const auto pattern = about.find(pattern_mark);
    return pattern == about.end() || pattern->second == "view" || pattern->second == "edge";
}

}  // namespace

void warn_if_for_another(const std::filesystem::path& panel_image, const Metadata& about, const Display& display) {
    const std::optional<IntendedDisplay> made = made_for(about);
    if (!made || !drawn_for_lenses(about)) return;
    std::string what = differences(pickup_of(made->display), pickup_of(display));
    const auto compare_words = [&](const char* key, std::string_view was, std::string_view is) {
        if (was != is) what += fmt::format("{}{} {}, not {}", what.empty() ? "" : "; ", key, was, is);
    };
    if (shown_places(made->display) != shown_places(display))
        what += fmt::format("{}panel.subpixels {}, not {}, or for other positions of them", what.empty() ? "" : "; ",
                            word(made->display.panel.subpixels), word(display.panel.subpixels));
    compare_words("array.lattice", word(made->display.array.lattice), word(display.array.lattice));
    const Display& then = made->display;
    if (then.content.pickup != PickupKind::nodal &&
        (then.lens != display.lens || then.panel.layers != display.panel.layers || then.array.surround != display.array.surround ||
         then.array.aperture != display.array.aperture))
        what += fmt::format("{}its pick-up was {} through another lens", what.empty() ? "" : "; ", word(then.content.pickup));
    if (then.content.made_for == MadeFor::built && !same_errors(then.errors, display.errors))
        what += fmt::format("{}other errors of assembly", what.empty() ? "" : "; ");
    if (holds_codes(panel_image)) compare_words("panel.encoding", word(made->display.panel.encoding), word(display.panel.encoding));
    if (!what.empty()) spdlog::warn("{}: was made for another display: {}", panel_image.string(), what);
}

void warn_if_other_camera(const std::filesystem::path& a, const std::filesystem::path& b) {
    const std::optional<IntendedDisplay> first = made_for(read_metadata(a)), second = made_for(read_metadata(b));
    if (!first || !second) return;
    const std::string what = differences(camera_of(*first), camera_of(*second));
    if (!what.empty()) spdlog::warn("{} and {}: show the display from different cameras: {}", a.string(), b.string(), what);
}

}  // namespace lfdsim::cli
