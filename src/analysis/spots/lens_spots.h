// The spots of one lens over field and depth, and the distortion of its elemental image. Floor 3.
#pragma once
#include "analysis/core/result.h"
#include "analysis/core/subject.h"
#include "analysis/spots/ray_fan.h"

#include <vector>

namespace lfdsim {

/// Returns the depths z, mm from H', at which spots are computed, ascending: the ends of the published depth of field, L, and
/// half-way between, within 0.1 to 1.9 times L. If L is infinite: 1, 1.5, 2, 3, 4 times the near end of the depth of field by the
/// pixel.
std::vector<double> spot_depths_mm(const Theory&);

/// The mean position of a bundle's rays at a depth and the root mean square of their distances from it, mm.
struct Centroid {
    double x, y, rms;
};
/// Returns the centroid at depth z, mm from H'. The bundle must not be empty.
Centroid centroid_at(const Bundle&, double z);

/// A point of the panel under the lens, and its light on the viewer's side.
struct LensField {
    const char *name, *title;
    Point panel;  // mm from the lens's axis, along the array's axes
    Bundle light;
    Fans rims;  // rays over the whole aperture up to its rims
};

/// Traces the points on the axis, half-way to the edge of the cell, at its edge and, except for strips, in its corner.
std::vector<LensField> trace_fields(const Subject&, const LensTrace&);

/// The sizes of a spot at a depth, mm: RMS radius and full widths, the latter also with the diffuser. NaN: there is none.
struct Spot {
    double rms, meridional, sagittal, meridional_diffused, sagittal_diffused;
};

/// Returns the spot of a field at depth z, mm from H'.
Spot spot_at(const Subject&, const LensField&, double z);

/// The distance of the centroid of each panel pixel's light from its nodal line (content/pickup/pickup.h) at the central depth
/// plane, in images of a panel pixel. Pixels are those of a lens whose axis is their centre of symmetry; of more than 96 along an
/// axis, 96 evenly spread positions. NaN if no light gets through.
struct Distortion {
    int columns, rows;
    std::vector<double> pixel_images;  // columns x rows, row 0 at the top
};
/// Computes the distortion of a lens's elemental image. Throws Stopped.
Distortion distortion(const Display&, const Geometry&, const Theory&, int threads, const Job&);

/// Adds a note to each figure of the result, and a remark, that names the keys of [errors] that are left out: the figures are those
/// of one perfect lens, parallel to the panel.
void note_left_out_errors(const Subject&, Result&);

}  // namespace lfdsim
