// A first design of a display from its requirements: thin-lens arithmetic, docs/model.md "First designs". Floor 0.
#pragma once
#include "display/display.h"
#include "geometry/geometry.h"

#include <array>
#include <optional>

namespace lfdsim {

/// What a display is required to do.
struct DesignRequest {
    double panel_inch = 0;  // the panel's diagonal
    std::array<std::int64_t, 2> pixels{};
    double fov_deg = 30;             // seen through whole elemental images: 2 atan(p' / 2g)
    double distance_mm = 0;          // of the eye from the panel
    std::optional<double> depth_mm;  // L, of the central depth plane from the lenses; absent: chosen
    LensType lens = LensType::plano_convex;
    LatticeKind lattice = LatticeKind::square;  // or hexagon
    std::optional<std::int64_t> views = {};     // N; absent: chosen
    std::optional<double> pitch_mm = {};        // in place of them
};

/// What determines the lens pitch.
enum class PitchRule {
    balanced,  // seen from the eye, a lens is as wide as the image of a panel pixel on the central depth plane
    pupil,     // near eyes: half the pupil, so that light of several lenses enters it together
    lenses,    // the fewest lenses along the panel's shorter side that make a picture
    views,     // the fewest pixels behind a lens that make views
    asked
};

/// What limits the width of a lens.
enum class ApertureRule {
    cell,       // it fills its cell
    sphere,     // its cap would come too near to half a ball
    aberration  // its spherical aberration would be wider than a panel pixel
};

struct FirstOrder {
    DesignRequest request;  // with its depth chosen
    Display display;
    bool near_eye;  // too near for an eye to see the lenses sharply
    int views;      // N, panel pixels behind a lens; of a pitch that was asked for about
    double eye_mm;  // E, of the eye from the lenses' viewer-side principal plane
    Theory theory;  // of the display
    PitchRule pitch_rule;
    ApertureRule aperture_rule;
};

/// Index of PMMA at 589 nm, and the least distance at which an eye sees sharply.
inline constexpr double pmma_index = 1.4918, nearest_sight_mm = 250;
/// An eye's pupil in a dim room.
inline constexpr double pupil_mm = 4;
/// Blur of a plano-convex lens whose flat face is towards its focus, in radians over (aperture / focal length)^3: spherical
/// aberration of third order, whole width, at the paraxial focus (a quarter of it at the best one).
inline constexpr double spherical_blur =
    (pmma_index * pmma_index - 2 * pmma_index + 2 / pmma_index) / (8 * (pmma_index - 1) * (pmma_index - 1));
inline constexpr int fewest_views = 4, fewest_lenses = 10;

/// Lengths are written to a nanometre: finer than lenses are made, and fine enough for a distant central depth plane.
double to_nanometre(double mm);
/// Returns a length rounded to three digits, where more are not needed.
double rounded(double);

/// A valid display that meets the request. Throws InputError with the option of `lfdsim new` as `where`, what is allowed, and the
/// nearest possible values, each with the others unchanged.
FirstOrder first_order(const DesignRequest&);

}  // namespace lfdsim
