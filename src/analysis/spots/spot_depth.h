// The depth of field by spot size, traced, and by diffraction. Floor 3.
//
// Depths are intervals of 1/z, 1/mm, z from the lens's rear principal plane towards the viewer: there a lens has one interval,
// whether its central depth plane is real, virtual or at infinity. 1/z = 0 is infinity, negative ones are behind the lens.
#pragma once
#include "analysis/core/result.h"
#include "analysis/core/subject.h"
#include "analysis/spots/ray_fan.h"

#include <array>
#include <vector>

namespace lfdsim {

/// The interval of sharp depths; NaN where none is.
struct SharpDepths {
    double near_per_mm, far_per_mm;
    double best_per_mm;  // where the spot is narrowest against a panel pixel's image
    double least_width;  // the spot's width there over its depth: a slope, as a pixel's image a |z|/g has the slope a/g
};

/// The depths at which a fan is no wider than a panel pixel's image, |width(z)| <= a |z|/g with `pixel_slope` = a/g. The Airy
/// disk's diameter over its depth, `airy_slope`, is added in quadrature.
SharpDepths where_sharp(const std::vector<FanRay>& fan, double pixel_slope, double airy_slope = 0);

/// The interval in which a fan is no wider than `width_mm`, or than at the lens itself: depths z from the rear principal plane,
/// below and above 0; infinite where it never is wider. The fan is not empty.
std::array<double, 2> where_narrow(const std::vector<FanRay>& fan, double width_mm);

/// The range in which a perfect wave that converges to L (or diverges from it, L < 0) through an aperture D differs from one to z
/// by no more than a quarter of the wavelength at the rim: |1/z - 1/L| D^2 / 8 <= wavelength / 4 (Born and Wolf, section 8.8).
/// Near, far.
std::array<double, 2> quarter_wave_per_mm(double L, double D, double wavelength_mm);

/// Adds figures and findings, of one lens for the panel point on its axis; returns the depths by spot size.
SharpDepths add_spot_depths(const Subject&, Result&);

}  // namespace lfdsim
