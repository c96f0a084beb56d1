// The depth of field by spot size, traced and by diffraction. Floor 3. docs/measures.md, "Depth of field by spot size".
//
// Depths are intervals of 1/z, 1/mm, z from H' towards the viewer: in 1/z a lens has one interval, whether its central depth
// plane is real, virtual or at infinity. 1/z = 0 is infinity; negative values are behind the lens.
#pragma once
#include "analysis/core/result.h"
#include "analysis/core/subject.h"
#include "analysis/spots/ray_fan.h"

#include <array>
#include <vector>

namespace lfdsim {

/// The interval of sharp depths; NaN if no depth is sharp.
struct SharpDepths {
    double near_per_mm, far_per_mm;  // its greatest and its least 1/z
    double best_per_mm;              // where the spot is narrowest relative to a panel pixel's image
    double least_width;              // the spot's width there over |z|: a slope, as the pixel's image a |z|/g has the slope a/g
};

/// Returns the depths at which a fan is no wider than a panel pixel's image, w(z) <= a |z|/g, with `pixel_slope` = a/g.
/// `airy_slope`, the Airy disk's diameter over the depth, 2.44 lambda/D, is added to w/|z| in quadrature.
SharpDepths where_sharp(const std::vector<FanRay>& fan, double pixel_slope, double airy_slope = 0);

/// Returns the interval of depths z, mm from H', in which a fan is no wider than `width_mm`, or than at the lens if that is more:
/// its ends below and above 0, infinite if the fan is never wider. The fan must not be empty.
std::array<double, 2> where_narrow(const std::vector<FanRay>& fan, double width_mm);

/// Returns the range, near and far end, in which a perfect wave that converges to L (or diverges from it, L < 0) through an
/// aperture D differs at the rim from one to z by at most a quarter of the wavelength: |1/z - 1/L| D^2/8 <= lambda/4 (Born and
/// Wolf, section 8.8). Lengths in mm.
std::array<double, 2> quarter_wave_per_mm(double L, double D, double wavelength_mm);

/// Adds the depths of field by lens, pixel and diffraction of one lens for the panel point on its axis. Returns those by the
/// pixel.
SharpDepths add_spot_depths(const Subject&, Result&);

}  // namespace lfdsim
