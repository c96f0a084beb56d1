// Slanted edges that a display shows at a depth, and pictures of them from several angles. Floor 3.
#pragma once
#include "analysis/core/elemental_panel.h"
#include "analysis/core/subject.h"
#include "analysis/resolution/slanted_edge.h"

#include <vector>

namespace lfdsim {

inline constexpr double slant_deg = 7;  // of the edges from the normal of the direction that they measure

/// A direction parallel to the panel in which resolution is measured: a unit vector along the display's x and y.
struct Direction {
    const char* name;  // for scripts: figures and tables
    const char* told;  // for sentences
    double x, y;
    int axis;  // axis of the array, 0 (x') or 1 (y'), whose pitch and aperture count along it
};

/// Returns the display's x and y; of strips, which image along x' only, that direction alone.
std::vector<Direction> directions(const Geometry&);

/// White and black bars side by side in a plane in front of or behind the display, mm. Each border is a slanted edge.
struct Bars {
    bool upright;      // edges are within 45 degrees of the vertical; if not, of the horizontal
    double lean_deg;   // of the edges: from the vertical, upper ends to the right; or from the horizontal, left ends up
    double z_mm;       // of their plane, from the panel
    double width_mm;   // of a bar, across it
    double length_mm;  // of the part that is used
    double offset_mm;  // position, across, of an edge with white on its positive side
};

/// Returns bars whose edges are slanted by slant_deg from the normal of a direction; width and length are not set.
Bars bars_across(const Direction&, double z_mm);

/// Returns the unit vector, along x and y, that points across the bars.
std::array<double, 2> across(const Bars&);

/// Returns the panel that shows the bars by the nodal pick-up, or white all over without bars. A pixel, or one of its channels,
/// is white or black like the point that the nodal line of its centre, or its subpixel's, meets, as in elemental images of
/// scenes: none is grey at an edge.
std::unique_ptr<ShownPanel> bars_panel(const Display&, const Geometry&, const std::optional<Bars>&, int threads);

/// The eye that looks at edges: a pinhole on the arc `distance_mm` from the panel's centre, `angle_deg` to the right (within -80
/// to 80).
struct EdgeEye {
    double angle_deg, distance_mm;
    double aside_mm = 0;  // shift to the right and up, so that the pixels of several pictures see different positions
    /// Return the eye's position in the display's frame; its y is aside_mm.
    double x_mm() const;
    double z_mm() const;
};

/// Returns the length in the plane at the height z onto which the eye projects a unit length in the vertex plane: (z_eye -
/// z)/(z_eye - z_v).
double scale_to_plane(const Geometry&, double z_mm, const EdgeEye&);

/// A view of the edges that fit into the middle of the screen. Its frame is parallel to the panel, so that the bars' plane
/// appears at one scale.
struct EdgeView {
    Display seen;  // the display with the view's camera
    Rect crop;
    Edges edges;     // in the crop, which is transposed if they are not upright; empty: none fits
    int lenses = 0;  // crossed by all edges together
};
/// Returns the view of an eye with pixels of `pixel_mm` in the bars' plane.
EdgeView edge_view(const Display&, const Geometry&, const Bars&, const EdgeEye&, double pixel_mm);

/// Returns half the width, across the bars, and half the length, along them, of the part of the bars' plane that an eye sees
/// through the screen; the length is limited so that slanted edges stay within the width. 0 or less: nothing is seen.
std::array<double, 2> seen_half_mm(const Geometry&, const Bars&, const EdgeEye&);

/// Returns the picture of a panel in that view, transposed if the edges are not upright. Throws Stopped.
Image picture_of(const EdgeView&, bool upright, const SummedPanel& panel, RenderOptions, const Job&);

}  // namespace lfdsim
