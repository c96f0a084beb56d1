#include "cli/options/display_options.h"

#include "cli/program/arguments.h"
#include "cli/program/input_files.h"
#include "display/keys.h"
#include "files/description/display_file.h"

#include <fmt/format.h>
#include <algorithm>
#include <limits>

namespace lfdsim::cli {
namespace {

constexpr KeyOption camera[] = {
    {"--camera-mm", "camera.position_mm", Form::point, "X,Y,Z",
     "Camera; the panel's centre is the origin, +x right, +y up, +z to the viewer"},
    {"--target-mm", "camera.target_mm", Form::point, "X,Y,Z", "What the camera looks at"},
    {"--frame-width-mm", "camera.frame_width_mm", Form::number, "W", "Width of the frame in the plane through the target",
     "camera.fov_deg"},
    {"--size", "camera.resolution", Form::size, "WxH", "Pixels of the frame"},
};
constexpr KeyOption sample[] = {
    {"--estimator", "render.estimator", Form::word, "filtered|point|lens_by_lens",
     "filtered: averages of the panel over footprints where they agree with point samples; point: brute force, one panel pixel per "
     "sample; lens_by_lens: averages whether they agree or not"},
    {"--samples", "render.samples", Form::count, "N",
     "Samples per pixel, where a diffuser, pixel filter or pupil spreads the light"},
    {"--seed", "render.seed", Form::count, "S", "Seed of the samples"},
    {"--sampling", "render.sampling", Form::word, "sobol|random", "Low-discrepancy or plain random points"},
};
constexpr KeyOption content[] = {
    {"--depth-mm", "content.depth_mm", Form::number, "Z", "Depth of the model's centre in front of the lenses' vertex plane"},
    {"--height-mm", "content.height_mm", Form::number, "H", "Height of the model"},
    {"--tilt-deg", "content.tilt_deg", Form::number, "B",
     "Tilt of the model about the horizontal axis, before the yaw; positive raises the front"},
    {"--yaw-deg", "content.yaw_deg", Form::number, "A", "Rotation of the model, counter-clockwise seen from above"},
    {"--pickup", "content.pickup", Form::word, "nodal|traced|integrated|inverse",
     "Elemental images for a perfect lens; for the line on which most of a pixel's light leaves the real lens; the mean over all "
     "of its light; or the panel picture with the best views (on the CPU)"},
    {"--eyes-mm", "content.inverse.eyes_mm", Form::box, "X,Y,Z,X,Y,Z",
     "Inverse pick-up: opposite corners of the box that contains the eyes; default: the viewing zone"},
    {"--levels", "content.inverse.levels", Form::pair, "B,W",
     "Inverse pick-up: light of the content's black and white relative to a white panel; a raised black leaves a margin to "
     "subtract crosstalk"},
};

// Returns a whole number within the range of the key.
std::int64_t count(const KeyOption& option, const Option& value) {
    constexpr auto most = std::numeric_limits<std::int64_t>::max();
    const Range& range = key_at(option.key)->key.range;
    return value.whole_number(std::int64_t(range.low), range.high < double(most) ? std::int64_t(range.high) : most);
}

// Returns the option's value in TOML syntax.
std::string toml_value(const KeyOption& option, const Option& value) {
    switch (option.form) {
        case Form::number:
            return fmt::format("{}", value.number());
        case Form::point:
            return fmt::format("[{}]", fmt::join(value.numbers("0,-300,1800"), ", "));
        case Form::pair:
            return fmt::format("[{}]", fmt::join(value.numbers("0.1,0.9"), ", "));
        case Form::box: {
            const std::vector<double> n = value.numbers("-100,0,450,100,0,450");
            return fmt::format("[[{}, {}, {}], [{}, {}, {}]]", n[0], n[1], n[2], n[3], n[4], n[5]);
        }
        case Form::size:
            return fmt::format("[{}]", fmt::join(value.size(), ", "));
        case Form::count:
            return fmt::format("{}", count(option, value));
        case Form::word:
            break;
    }
    return fmt::format("\"{}\"", value.word());
}

/// Remembers the files that a display names and that are read: those of the inverse pick-up are not with another one.
void remember_files(Display& display) {
    visit_files(display, [&](const std::string& key, const std::string& file) {
        if (!key.starts_with("content.inverse.") || display.content.pickup == PickupKind::inverse) remember_input(key, file);
    });
}

}  // namespace

const std::span<const KeyOption> camera_options = camera;
const std::span<const KeyOption> sample_options = sample;
const std::span<const KeyOption> point_options = std::span(sample).subspan(1);
const std::span<const KeyOption> content_options = content;

DisplayOptions::DisplayOptions(Command command, std::initializer_list<std::span<const KeyOption>> groups, bool required)
    : path_(command.option("DISPLAY.toml", "", "Description of the display")),
      settings_(command
                    .list("--set", "KEY=VALUE",
                          "Overrides a key of the description, value in TOML syntax: array.pitch_mm=8; none removes a key or "
                          "table: diffuser=none")
                    .one_each()) {
    if (required) path_.required();
    for (const auto group : groups)
        for (const KeyOption& option : group)
            options_.emplace_back(&option, command.option(option.option, option.value, option.help));
}

bool DisplayOptions::given(std::string_view option) const {
    return std::any_of(options_.begin(), options_.end(),
                       [&](const auto& each) { return each.first->option == option && each.second.given(); });
}

// Options become overrides of the description, so that one validation checks file, --set and options together.
std::pair<std::vector<std::string>, std::map<std::string, std::string>> DisplayOptions::all_overrides(Faults& faults) const {
    std::vector<std::string> overrides = settings_.texts();
    std::map<std::string, std::string> written;
    for (const auto& [option, on_line] : options_) {
        if (!on_line.given()) continue;
        if (option->replaces) overrides.push_back(fmt::format("{}=none", option->replaces));
        faults.of([&, o = option, value = on_line] {
            overrides.push_back(fmt::format("{}={}", o->key, toml_value(*o, value)));
            written["--set " + overrides.back()] = fmt::format("{} {}", o->option, value.text());
        });
    }
    return {std::move(overrides), std::move(written)};
}

std::vector<std::string> DisplayOptions::overrides() const {
    Faults faults;
    std::vector<std::string> all = all_overrides(faults).first;
    faults.report();
    return all;
}

Display DisplayOptions::read(const std::string& path, const std::string& compared) const {
    remember_input("the description", path);
    Faults faults;
    auto [overrides, written] = all_overrides(faults);
    if (!compared.empty()) {
        overrides.push_back(compared);
        written["--set " + compared] = fmt::format("--compare {}", compared);
    }
    Display display;
    // Faults of the description at an override are reported at the option from which it was made.
    faults.of([&, &set = overrides, &places = written] {
        try {
            display = read_display(path, set);
            remember_files(display);
        } catch (InputError& e) {
            for (Problem& p : e.problems)
                if (const auto option = places.find(p.where); option != places.end()) p.where = option->second;
            throw InputError(std::move(e.problems));
        }
    });
    faults.report();
    for (const char* const option : {"--eyes-mm", "--levels"})
        if (given(option) && compared.empty() && display.content.pickup != PickupKind::inverse)
            throw InputError(option, "is only for --pickup inverse; give that, too, or leave it out");
    return display;
}

}  // namespace lfdsim::cli
