// The lens and the panel pixel that a point of the picture shows. Floor 5.
#pragma once
#include "display/display.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace lfdsim::view {

/// What a line of sight meets. Lens and panel are absent where no lens transmits it; the pixel also where it ends beside the panel.
struct Probe {
    std::optional<std::array<std::int64_t, 2>> lens;  // column and row, from 0 at the upper left of an array without rotation
    std::optional<std::array<std::int64_t, 2>> panel_pixel;  // column and row, from 0 at the upper left
    std::optional<std::array<double, 2>> panel_mm;           // from the panel's centre, x to the right, y up
    std::string says;                                        // one sentence
    /// Polylines of (y, z), mm, from the eye to the panel: the line of sight as the side views draw it, in the plane of its lens's
    /// axis; with a diffuser five, spread over its vertical angle. One that a lens does not transmit ends there.
    std::vector<std::vector<std::array<double, 2>>> fan;
};

/// Traces the line of sight through a point of the picture of a valid display's camera, in double precision; the diffuser does not
/// turn it. `at` is 0 to 1 from the picture's upper left corner.
Probe probe(const Display&, std::array<double, 2> at);

}  // namespace lfdsim::view
