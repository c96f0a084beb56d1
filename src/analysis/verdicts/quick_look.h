// Properties of a display that some thousand rays show within milliseconds: how much of the panel one eye sees at once, how sharp
// a lens is, which colours a white screen shows. Floor 3.
//
// They decide the verdicts of analysis/verdicts/verdicts.h. docs/model.md, "Advice".
#pragma once
#include "analysis/moire/moire_theory.h"
#include "analysis/spots/spot_depth.h"
#include "base/constants.h"
#include "display/display.h"
#include "geometry/geometry.h"

#include <optional>

namespace lfdsim {

/// A figure by tracing, and by paraxial theory along the same lines of sight.
struct TracedAndTheory {
    double traced, theory;
};

/// The width of the part of its elemental image that the lens in the array's middle shows at once to an eye on the display's
/// axis, at the camera's distance; along that axis of the array that is nearer to the line through a viewer's eyes.
struct SeenAtOnce {
    double image_mm;              // p', the elemental image's width
    TracedAndTheory width_mm;     // of the part that holds the middle 95 % of the light, over 0.95
    double through_apertures_mm;  // D |1 + g/E - g/f|: in theory, without the diffuser
};
/// Returns that width; nothing if the camera is inside the display, or if too little light gets through.
std::optional<SeenAtOnce> seen_at_once(const Display&, const Geometry&);

/// Returns the width of the viewing zone at the camera's distance, mm; NaN where both eyes see the same.
double zone_before_camera_mm(const Display&, const Geometry&);

/// Returns the crosstalk of that eye of a viewer in front of the screen's middle, at the camera's distance, which has more of it,
/// %: as docs/measures.md, "Crosstalk", defines it, with elemental images made for that distance, by fewer lines of sight and only
/// of those that meet a lens. Infinite: the eye sees only what is intended for the other one. Nothing if both eyes do not fit into
/// the viewing zone, if no light gets through, or if rounding decides on it.
std::optional<TracedAndTheory> between_eyes_percent(const Display&, const Geometry&);

/// The width of the light of the panel point on a lens's axis, in images of a panel pixel at the same depth. Light that is not
/// evenly spread has the width of an even spread of the same variance, sqrt(12) sigma.
struct LensBlur {
    double pixels, full_pixels;  // in the central depth plane: that width, and the full width of all rays
    SharpDepths sharp;           // the depth of field by the pixel, by all rays
};
/// Returns the blur of a lens on its axis, by the rays no farther than `stop_mm` from the axis in the principal plane. Nothing
/// for pinholes, and if too little light gets through.
std::optional<LensBlur> blur(const Display&, const Geometry&, double stop_mm = infinity);

/// The strongest wave of colours on a white screen that a viewer's left eye sees, or, for near-eye displays, the eye on the axis.
/// Its contrast is that of red, or blue, less the luminance.
struct ColourWave {
    double period_mm;                         // infinite: the screen has one colour all over
    double direction_deg, cycles_per_degree;  // of the wave's normal; cycles as the eye sees them
    double contrast;                          // traced, through the eye's pupil
    double visible;                           // contrast after the eye's filter for colours
    double turned_per_degree[2];  // periods by which each degree of a diffuser's angle moves the wave, along the display's x and y
};
/// Returns the strongest colour wave; nothing without subpixels, and if theory has none.
std::optional<ColourWave> colour_wave(const Display&, const Geometry&);

}  // namespace lfdsim
