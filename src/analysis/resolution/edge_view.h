// Slanted edges that a display shows at a depth, and pictures of them from several angles. Floor 3.
#pragma once
#include "analysis/core/elemental_panel.h"
#include "analysis/core/subject.h"
#include "analysis/resolution/slanted_edge.h"

#include <vector>

namespace lfdsim {

inline constexpr double slant_deg = 7;  // of the edges from the normal of the direction that they measure

/// A direction, parallel to the panel, in which resolution is measured: a unit vector along the display's x and y.
struct Direction {
    const char* name;  // in figures and tables
    const char* told;  // in sentences
    double x, y;
    int axis;  // of the array, 0 (x') or 1 (y'), whose pitch and aperture count along it
};

/// The display's x and y; of strips, which image along x' alone, that one.
std::vector<Direction> directions(const Display&);

/// White and black bars, side by side in a plane in front of or behind the display: each border is a slanted edge.
struct Bars {
    bool upright;      // edges within 45 degrees of the vertical; else of the horizontal
    double lean_deg;   // of the edges: from the vertical, upper ends to the right; or from the horizontal, left ends up
    double z_mm;       // of their plane, from the panel
    double width_mm;   // of a bar, across it
    double length_mm;  // of the part that is used
    double offset_mm;  // across, of one edge with white on the side that `across_mm` rises to
};

/// Bars whose edges stand across a direction but for `slant_deg`; without width and length yet.
Bars bars_across(const Direction&, double z_mm);

/// The unit vector in x and y that points across the bars: a point of their plane lies as far across them, from the display's axis,
/// as its place does along this.
std::array<double, 2> across(const Bars&);

/// The panel that shows the bars by the nodal pick-up. A pixel, or a channel of it, is white or black as the point is that its
/// nodal line meets, from its centre or its subpixel's, as elemental images of scenes are made: none is grey at an edge. Without
/// bars: white all over.
std::unique_ptr<ShownPanel> bars_panel(const Display&, const Geometry&, const std::optional<Bars>&, int threads);

/// The eye that looks at edges: a pinhole at `distance_mm` from the panel's centre, `angle_deg` to the right (within +-80).
struct EdgeEye {
    double angle_deg, distance_mm;
    double aside_mm = 0;  // shift to the right and up, so that the pixels of several pictures look at different places
    double x_mm() const;
    double z_mm() const;
};

/// The length in a plane at a height above the panel onto which the eye projects a unit length of the lenses' plane.
double scale_to_plane(const Geometry&, double z_mm, const EdgeEye&);

/// A view of the edges that fit into the middle of the screen as an eye sees it. Its frame is parallel to the panel, so that the
/// bars' plane appears at one scale, `pixel_mm` to a pixel.
struct EdgeView {
    Display seen;
    Rect crop;
    Edges edges;     // in the crop, or in the crop transposed where they are not upright; empty: none fits
    int lenses = 0;  // that the edges cross, all together
};
EdgeView edge_view(const Display&, const Geometry&, const Bars&, const EdgeEye&, double pixel_mm);

/// Half the width and length of the part of the bars' plane that an eye sees through the screen: across the bars, and along them,
/// where it is limited so that slanted edges stay within it. 0 or less: nothing is seen.
std::array<double, 2> seen_half_mm(const Display&, const Geometry&, const Bars&, const EdgeEye&);

/// The picture of a panel in that view, transposed where the edges are not upright. Throws Stopped.
Image picture_of(const EdgeView&, bool upright, const SummedPanel& panel, RenderOptions, const Job&);

}  // namespace lfdsim
