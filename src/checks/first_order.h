// First designs of displays from their requirements, by thin-lens equations: docs/model.md, "First designs". Floor 0.
#pragma once
#include "display/display.h"
#include "geometry/geometry.h"

#include <array>
#include <optional>

namespace lfdsim {

/// What a display is required to do.
struct DesignRequest {
    double panel_inch = 0;                 // the panel's diagonal
    std::array<std::int64_t, 2> pixels{};  // columns, rows
    double fov_deg = 30;                   // of whole elemental images: 2 atan(p'/2g)
    double distance_mm = 0;                // D', of the eye from the panel
    std::optional<double> depth_mm;        // L, of the central depth plane from the lenses; absent: chosen
    LensType lens = LensType::plano_convex;
    LatticeKind lattice = LatticeKind::square;  // or hexagon
    std::optional<std::int64_t> views = {};     // N; absent: chosen
    std::optional<double> pitch_mm = {};        // p, in place of `views`; absent: chosen
};

/// The rule that determines the lens pitch.
enum class PitchRule {
    balanced,  // a lens and the image of a panel pixel in the central depth plane look equally wide from the eye
    pupil,     // near eyes: half the pupil, so that light of several lenses enters it together
    lenses,    // the panel's shorter side is fewest_lenses pitches long: wider lenses would make no picture
    views,     // the fewest pixels behind a lens that make views
    asked      // the request's views or pitch
};

/// The limit that determines the width of a lens.
enum class ApertureRule {
    cell,       // the lens fills its cell
    sphere,     // a wider cap would be nearly half a ball: r = 0.9 R
    aberration  // a wider lens would blur by more than a panel pixel's angle a/g
};

/// A first design.
struct FirstOrder {
    DesignRequest request;  // with the depth that was chosen
    Display display;
    bool near_eye;  // the eye is too near to see the lenses sharply, less than nearest_sight_mm from the panel
    int views;      // N, panel pixels behind a lens; rounded if a pitch was requested
    double eye_mm;  // E, of the eye from H'
    Theory theory;  // of `display`
    PitchRule pitch_rule;
    ApertureRule aperture_rule;
};

/// The index of PMMA at 589 nm.
inline constexpr double pmma_index = 1.4918;
/// K of docs/model.md, "First designs": the blur, radians, of a plano-convex lens whose flat face is towards its focus is K
/// (aperture/focal length)^3. Spherical aberration of third order, whole width, at the paraxial focus (a quarter of it at the
/// best one).
inline constexpr double spherical_blur =
    (pmma_index * pmma_index - 2 * pmma_index + 2 / pmma_index) / (8 * (pmma_index - 1) * (pmma_index - 1));
/// The fewest panel pixels behind a lens, and the fewest pitches that the panel's shorter side is long, in a design. Elemental
/// images are wider than the pitch, so that fewer of them may fit there.
inline constexpr int fewest_views = 4, fewest_lenses = 10;

/// Returns a length, mm, rounded to a nanometre: finer than lenses are made, and fine enough for a distant central depth plane.
double to_nanometre(double mm);
/// Returns a length, mm, rounded to a picometre: of lenses that focus on the panel, so that theory takes g for f.
double to_picometre(double mm);
/// Returns a number rounded to three digits, for values of which more are not needed.
double rounded(double);

/// Returns a valid display that meets the request. Throws InputError with the option of `lfdsim new` as `where`, what is allowed,
/// and the nearest possible values, each with the others unchanged.
FirstOrder first_order(const DesignRequest&);

}  // namespace lfdsim
