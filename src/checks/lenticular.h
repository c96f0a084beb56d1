// Displays with a sheet of cylindrical lenses, designed from their requirements: docs/model.md "First designs". Floor 0.
#pragma once
#include "display/display.h"
#include "geometry/geometry.h"

#include <optional>

namespace lfdsim {

/// Cylinders that focus on the panel, on a sheet of the same glass that lies on it: the sheet's thickness is n g up to their
/// vertices.
struct CylinderSheet {
    PlanoConvex lens;
    double layer_mm = 0;  // of the sheet under the lens's own wall
};
/// Nothing where the radius that focuses there, (n - 1) g, is less than half the pitch.
std::optional<CylinderSheet> cylinder_sheet(double pitch_mm, double gap_mm, double index);

/// What a display with vertical or slanted strips is required to do. Of `views` and `pitch_mm` at most one is given, of `fov_deg`,
/// `sheet_mm` and `eyes_mm` at most one.
struct LenticularRequest {
    double panel_inch = 0;  // the panel's diagonal
    std::array<std::int64_t, 2> pixels{};
    double distance_mm = 0;                // of the eye from the panel
    std::optional<double> views = {};      // N, panel pixels of a row behind a lens; absent: by the eyes' distance
    std::optional<double> pitch_mm = {};   // across the lenses
    std::optional<double> slant_deg = {};  // absent: by 1 in 3, but 0 of two views
    std::optional<double> fov_deg = {};    // along the rows, of whole elemental images; absent: 30, or by the eyes of two views
    std::optional<double> sheet_mm = {};   // from the panel to the lenses' vertices, all of it of the lenses' glass
    std::optional<double> eyes_mm = {};    // of two views: from an eye to the other; absent: the usual
    LensType lens = LensType::plano_convex;
};

/// What determines the views of a first design.
enum class ViewsRule {
    asked,
    eyes,   // two from eye to eye
    lenses  // fewer, for lenses that the eye does not see one by one
};

struct Lenticular {
    LenticularRequest request;
    Display display;
    double gap_mm, sheet_mm;  // g; n g, or g of ideal lenses
    double eye_mm;            // E, of the eye from the lenses
    double views;             // N
    double view_step_mm;      // from view to view at the eye's distance
    double fov_deg;           // along the rows, of whole elemental images
    ViewsRule views_rule;
    bool two_view;  // its gap follows from the eyes
};

/// The distance between a viewer's eyes, and the largest angle of a lens that the eye hardly resolves.
inline constexpr double usual_eyes_mm = 65, lens_arc_minutes = 5;

/// A valid display that meets the request. Throws InputError with the option of `lfdsim new` as `where`, and what is possible.
Lenticular lenticular(const LenticularRequest&);

}  // namespace lfdsim
