// The spots of one lens over field and depth, and the distortion of its elemental image. Floor 3.
#pragma once
#include "analysis/core/subject.h"
#include "analysis/spots/ray_fan.h"

#include <vector>

namespace lfdsim {

/// The depths z from the rear principal plane at which spots are shown, rising: the marginal planes, the central depth plane and
/// half-way between, within 0.1 to 1.9 times L. Where L is infinite: 1, 1.5, 2, 3, 4 times the marginal plane.
std::vector<double> spot_depths_mm(const Theory&);

/// Mean place of a bundle's light and root mean square of its distance from there, at depth z.
struct Centroid {
    double x, y, rms;
};
Centroid centroid_at(const Bundle&, double z);

/// A point of the panel under the lens, and its light.
struct LensField {
    const char *name, *title;
    Point panel;
    Bundle light;
    Fans rims;
};

std::vector<LensField> trace_fields(const Subject&, const LensTrace&);

/// A spot has these sizes at a depth, mm: RMS radius and full widths, these also with the diffuser. NaN: there is none.
struct Spot {
    double rms, meridional, sagittal, meridional_diffused, sagittal_diffused;
};

Spot spot_at(const Subject&, const LensField&, double z);

/// The distance of the centroid of each panel pixel's light from its nodal line (content/pickup/pickup.h), at the central depth
/// plane, in images of a panel pixel. Pixels are symmetric about the axis; of more than 96 across or up, 96 places evenly spread.
/// NaN where no light gets through.
struct Distortion {
    int columns, rows;
    std::vector<double> pixel_images;  // columns x rows, row 0 at the top
};
/// Throws Stopped.
Distortion distortion(const Display&, const Geometry&, const Theory&, int threads, const Job&);

}  // namespace lfdsim
