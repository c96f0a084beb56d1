// What some thousand rays tell of a display within milliseconds: how much one eye sees at once, how sharp one lens is, which
// colours a white screen shows. Floor 3.
//
// They decide whether there is something to say (analysis/core/verdicts.h). docs/model.md, "Advice".
#pragma once
#include "analysis/moire/moire_theory.h"
#include "analysis/spots/spot_depth.h"
#include "base/constants.h"
#include "display/display.h"
#include "geometry/geometry.h"

#include <optional>

namespace lfdsim {

/// Traced, and by paraxial theory along the same lines of sight.
struct TracedAndTheory {
    double traced, theory;
};

/// The width of the part of its elemental image that the lens in the array's middle shows at once to an eye on the display's
/// axis, at the camera's distance; along that axis of the array that is nearer to the line through a viewer's eyes.
struct SeenAtOnce {
    double image_mm;              // p', the elemental image's width
    TracedAndTheory width_mm;     // that holds the middle 95 % of the light, over 0.95
    double through_apertures_mm;  // in theory, without the diffuser: D |1 + g/E - g/f|
};
/// Computes that width; none where the camera is inside the display, or where no light gets through.
std::optional<SeenAtOnce> seen_at_once(const Display&, const Geometry&);

/// Between a viewer's eyes, mm.
inline constexpr double usual_eyes_apart_mm = 65;

/// The crosstalk between the eyes of a viewer in front of the screen's middle, at the camera's distance: the light through lenses
/// that is meant for the other eye over that meant for the eye itself, of elemental images made for that distance; per cent. None
/// where the viewing zone does not contain both eyes.
std::optional<TracedAndTheory> between_eyes_percent(const Display&, const Geometry&);

/// The light of the panel's point on a lens's axis, in images of a panel pixel at the same depth. The width of light that is
/// unevenly spread is that of an even spread of the same variance.
struct LensBlur {
    double pixels, full_pixels;  // at the central depth plane: the light's width, and that of all rays to the very rims
    SharpDepths sharp;           // by all rays
};
/// The blur of a lens on the axis, by rays no farther from the axis than `stop_mm` in the principal plane. None of pinholes, and
/// where no light gets through.
std::optional<LensBlur> blur(const Display&, const Geometry&, double stop_mm = infinity);

/// The strongest wave of colours that a viewer's left eye, or before near-eye displays the eye on the axis, sees on a white screen.
/// Contrast is that of red, or blue, less luminance.
struct ColourWave {
    double period_mm;  // infinite: the screen has one colour all over
    double direction_deg, cycles_per_degree;
    double contrast;              // traced, with the eye's pupil
    double visible;               // the same after the eye's filter for colours
    double turned_per_degree[2];  // periods by which a diffuser's degree moves the wave, along the display's x and y
};
/// The strongest colour wave; none without subpixels, and where theory has none.
std::optional<ColourWave> colour_wave(const Display&, const Geometry&);

}  // namespace lfdsim
