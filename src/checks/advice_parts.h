// The parts of advice(). Floor 0, internal to it.
#pragma once
#include "display/display.h"
#include "geometry/geometry.h"

#include <fmt/format.h>
#include <optional>
#include <string>
#include <vector>

namespace lfdsim {

struct Advised {
    const Display& display;
    const Geometry& geometry;
    const Theory& theory;
    std::optional<Vec3d> model_half_size_mm;
    std::vector<std::string> sentences = {};

    template <class... Values>
    void say(fmt::format_string<Values...> text, Values&&... values) {
        sentences.push_back(fmt::format(text, std::forward<Values>(values)...));
    }
};

void advise_on_lenses(Advised&);    // their power and size
void advise_on_layout(Advised&);    // array and panel
void advise_on_diffuser(Advised&);  // dark bands, and too much of it
void advise_on_eye(Advised&);       // where it stands, and for where the elemental images are made
void advise_on_scene(Advised&);     // where it stands and how large it is

}  // namespace lfdsim
