// Which lens and panel pixel a point of the picture shows. Floor 5.
#pragma once
#include "analysis/core/result.h"
#include "display/display.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace lfdsim::view {

struct Probe {
    std::optional<std::array<std::int64_t, 2>> lens;         // column and row, from 0 at the upper left of an unturned array
    std::optional<std::array<std::int64_t, 2>> panel_pixel;  // the same of the panel
    std::optional<std::array<double, 2>> panel_mm;           // from the panel's centre, x to the right, y up
    std::string says;                                        // one sentence
    /// Polylines of (y, z), mm, from the eye to the panel: the line of sight as the side views draw it, in the plane of its lens's
    /// axis; with a diffuser five, spread over its vertical angle. One that a lens does not let through ends there.
    std::vector<std::vector<std::array<double, 2>>> fan;
};

/// `at`: 0 .. 1 from the upper left corner of the picture of the display's camera. The line of sight is traced in double precision,
/// and the diffuser does not turn it. A valid display.
Probe probe(const Display&, std::array<double, 2> at);

}  // namespace lfdsim::view
