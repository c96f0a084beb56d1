// Messages from a browser to the viewer, parsed and checked: docs/view-protocol.md. Floor 5.
#pragma once
#include "base/constants.h"
#include "display/display.h"
#include "report/plots/svg.h"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace lfdsim::view {

/// The content that the panel shows.
struct Shown {
    enum class Kind { start, model, panel_image, pattern };  // start: what the program was started with
    Kind kind = Kind::start;
    std::string name;   // a file in the served folder, "built-in:spheres", or a pattern's name
    bool hold = false;  // elemental images stay those of the description without `set`, to see the effect of misalignment
    bool operator==(const Shown&) const = default;
};

enum class Layout { one, pair, crossed };            // pair: the left eye's picture is on the left; crossed: on the right
enum class Beside { none, photograph, difference };  // the further picture for the same eye, if any

/// Everything that a page wants to show. A page sends all of it each time, so nothing is lost when a connection drops.
struct Wanted {
    std::int64_t id = 0;           // rises; frames have the id of the state that they show
    std::string display;           // description in the served folder; empty: the one that the program was started with
    std::vector<std::string> set;  // "key=value" as of --set; at most 100
    Shown shown;
    Vec3d eye_mm{0, 0, 2000};            // of the eye, or midway between two eyes; becomes camera.position_mm
    std::array<int, 2> size{1280, 720};  // columns and rows of one picture, 16 to 4096 each, most_pixels at most
    Layout layout = Layout::one;
    double eye_distance_mm = usual_eye_separation_mm;  // between two eyes, 0 to 1000
    Beside beside = Beside::none;
    bool moving = false;  // further states will follow soon: a coarse picture is enough
    bool operator==(const Wanted&) const = default;

    /// Returns the state with the display as its description has it.
    Wanted without_settings() const {
        Wanted described = *this;
        described.set.clear();
        return described;
    }
};

/// Whether two states are the same, apart from id and `moving`.
inline bool same_state(Wanted a, const Wanted& b) {
    a.id = b.id;
    a.moving = b.moving;
    return a == b;
}

/// A question about the state that was wanted last; its answer has the same id. Members apply to the questions that they name.
struct Ask {
    enum class What { probe, side, plot, files, toml, save, exr };
    std::int64_t id = 0;
    What what = What::probe;
    std::array<double, 2> at{};  // probe: point of the picture, 0 to 1 from its upper left corner
    std::string name;            // side: "display" or "lens"; plot: "fov" or "spot"; save: file in the served folder
    bool overwrite = false;      // save
    double width = plot_width;   // plot: pixels
};
/// The words for Ask::What, in its order.
inline constexpr std::string_view question_words[]{"probe", "side", "plot", "files", "toml", "save", "exr"};

using Message = std::variant<Wanted, Ask>;

inline constexpr std::size_t longest_message = 64 << 10;  // bytes
inline constexpr std::int64_t most_pixels = 3840 * 2160;  // of one picture

/// Parses a message. Throws InputError for anything that is not exactly one: keys that are unknown, missing or given twice, wrong
/// types, numbers that are not finite or out of range, text that is too long or too deep, or not UTF-8.
Message parse_message(std::string_view);

}  // namespace lfdsim::view
