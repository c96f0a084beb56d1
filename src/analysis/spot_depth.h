// The depth of field by spot size, traced, and by diffraction. Floor 3. Depths z from the lens's rear principal plane, mm.
#pragma once
#include "analysis/lens_trace.h"
#include "analysis/result.h"
#include "analysis/subject.h"

#include <array>
#include <vector>

namespace lfdsim {

/// A width that is allowed at depth z: mm + per_mm z.
struct Allowed {
    double mm, per_mm;
};

/// What theory allows: the width of a panel pixel's image on the central depth plane, or where that is at infinity at each depth.
Allowed pixel_image(const Display&, const Geometry&, const Theory&);

/// The one interval of depths at which a spot is not wider than allowed.
struct SharpDepths {
    double low, high;  // infinite: no bound. NaN where there is none.
    double best;       // where the width is furthest below what is allowed, or least above it
    double least_mm;   // the width there
};

/// Of the fan's width, with the diameter of the Airy disk, airy_per_mm |z|, added in quadrature.
SharpDepths where_sharp(const std::vector<Line>& fan, Allowed, double airy_per_mm = 0);

/// Where a perfect wave that converges to L (or diverges from it, L < 0) through an aperture D differs from one to z by no more
/// than a quarter of the wavelength at the rim: |1/z - 1/L| D^2 / 8 <= wavelength / 4 (Born and Wolf, section 8.8).
std::array<double, 2> quarter_wave_depths(double L, double D, double wavelength_mm);

/// Adds figures and findings, of one lens for the panel point on its axis; returns the range by spot size from the vertex plane,
/// NaN where there is none.
std::array<double, 2> add_spot_depths(const Subject&, Result&);

}  // namespace lfdsim
