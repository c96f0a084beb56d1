// A small display for the tests of the measures.
#pragma once
#include "base/constants.h"
#include "display/display.h"

#include <cmath>

namespace lfdsim::analysis_example {

/// 40 x 24 ideal lenses of 6 mm pitch in square cells, the field of view `fov_deg`, the central depth plane `depth_mm` before the
/// lenses, a diffuser there that closes the gaps (none where it would stand behind the lenses); seen from 2 m.
inline Display display(double fov_deg, double depth_mm) {
    Display d;
    d.panel.pixels = {1200, 720};
    d.panel.pixel_pitch_mm = 0.2;
    d.array.count = {40, 24};
    d.array.pitch_mm = 6;
    d.array.aperture = Aperture::cell;
    const double gap = 3 / std::tan(0.5 * fov_deg * degree);
    d.array.gap_mm = gap;
    d.lens.kind = IdealLens{{}, 1 / (1 / depth_mm + 1 / gap)};
    if (depth_mm > 0) d.diffuser = Diffuser{depth_mm, {2 * std::atan(3 / depth_mm) / degree, 2 * std::atan(3 / depth_mm) / degree}};
    d.camera.resolution = {480, 288};
    d.content.height_mm = 90;
    return d;
}

}  // namespace lfdsim::analysis_example
