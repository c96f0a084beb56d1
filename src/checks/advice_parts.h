// The parts of advice(), which add texts one after another. Floor 0, internal to it.
#pragma once
#include "display/display.h"
#include "geometry/geometry.h"

#include <fmt/format.h>
#include <optional>
#include <string>
#include <vector>

namespace lfdsim {

/// A valid display with what is known of it, and the advice so far.
struct Advised {
    const Display& display;
    const Geometry& geometry;
    const Theory& theory;
    std::optional<Vec3d> model_half_size_mm;  // of the posed model, if it has been read
    std::vector<std::string> sentences = {};

    /// Adds a text, formatted as by fmt::format().
    template <class... Values>
    void say(fmt::format_string<Values...> text, Values&&... values) {
        sentences.push_back(fmt::format(text, std::forward<Values>(values)...));
    }
};

void advise_on_lenses(Advised&);     // their power and size
void advise_on_layout(Advised&);     // array and panel
void advise_on_diffuser(Advised&);   // dark bands, and too much of it
void advise_on_eye(Advised&);        // the eye's position, and that for which elemental images are made
void advise_on_scene(Advised&);      // the scene's position, size and depth of field
void advise_on_idle_keys(Advised&);  // changed keys that another key's value leaves without effect

}  // namespace lfdsim
