// Which displays the whole program covers: pictures and elemental images are made of all, exports of nearly all; measures and
// pictures through lenses of triangles so far of some. Floor 0.
#pragma once
#include "model/display.h"
#include "model/error.h"
#include "model/keys.h"
#include "model/lattice.h"

#include <fmt/format.h>
#include <optional>
#include <string_view>

namespace lfdsim {

/// Why `who` ("the measure fov") cannot take a display, if it covers only rows and columns of lenses in air.
inline std::optional<Problem> beyond_lenses_in_air(const Display& d, std::string_view who) {
    if (is_staggered(d.array) || is_strips(d.array))
        return Problem{"array.lattice", fmt::format("is \"{}\", which {} does not cover yet; take \"square\" or \"rectangle\"",
                                                    word(d.array.lattice), who)};
    if (!d.panel.layers.empty())
        return Problem{"panel.layer", fmt::format("is given, but {} does not cover layers yet; leave them out", who)};
    if (d.lens.type() == LensType::pinhole)
        return Problem{"lens.type", fmt::format("is \"pinhole\", which {} does not cover yet; take another lens", who)};
    return {};
}

}  // namespace lfdsim
