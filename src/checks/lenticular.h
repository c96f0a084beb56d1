// Displays with a sheet of cylindrical lenses, designed from their requirements: docs/model.md "First designs". Floor 0.
#pragma once
#include "display/display.h"
#include "geometry/geometry.h"

#include <optional>

namespace lfdsim {

/// Cylinders that focus on the panel, on a sheet of the same glass in contact with it: from the panel to the cylinders' vertices
/// the sheet is n g thick.
struct CylinderSheet {
    PlanoConvex lens;
    double layer_mm = 0;  // of the part of the sheet that is a layer, under the lens's wall
};
/// Returns the sheet for lengths in mm; nothing if the radius that focuses on the panel, (n - 1) g, is less than half the pitch.
std::optional<CylinderSheet> cylinder_sheet(double pitch_mm, double gap_mm, double index);

/// What a display with vertical or slanted strips is required to do. At most one of `views` and `pitch_mm` is given, and at most
/// one of `fov_deg`, `sheet_mm` and `eyes_mm`.
struct LenticularRequest {
    double panel_inch = 0;                 // the panel's diagonal
    std::array<std::int64_t, 2> pixels{};  // columns, rows
    double distance_mm = 0;                // D', of the eye from the panel
    std::optional<double> views = {};      // N, panel pixels of a row behind a lens; absent: by the eyes' distance
    std::optional<double> pitch_mm = {};   // p, across the lenses
    std::optional<double> slant_deg = {};  // absent: atan(1/3), or 0 of two views
    std::optional<double> fov_deg = {};    // of whole elemental images along the rows; absent: 30, or by the eyes of two views
    std::optional<double> sheet_mm = {};   // T, from the panel to the lenses' vertices, all in the lenses' glass
    std::optional<double> eyes_mm = {};    // b, between a viewer's eyes, for two views; absent: usual_eye_separation_mm
    LensType lens = LensType::plano_convex;
};

/// The rule that determines the number of views.
enum class ViewsRule {
    asked,  // the request's views or pitch
    eyes,   // two views from eye to eye
    lenses  // fewer views, for lenses that the eye does not resolve
};

/// A first design with strips.
struct Lenticular {
    LenticularRequest request;
    Display display;
    double gap_mm, sheet_mm;  // g; T = n g, or g of ideal lenses
    double eye_mm;            // E, of the eye from H'
    double views;             // N, along a row
    double view_step_mm;      // a E/g, from view to view at the eye's distance
    double fov_deg;           // of whole elemental images along the rows
    ViewsRule views_rule;
    bool two_view;  // two views, whose gap follows from the distance between the eyes
};

/// The largest angle of a lens that the eye hardly resolves, arc minutes.
inline constexpr double lens_arc_minutes = 5;

/// Returns a valid display that meets the request. Throws InputError with the option of `lfdsim new` as `where`, and what is
/// possible.
Lenticular lenticular(const LenticularRequest&);

}  // namespace lfdsim
