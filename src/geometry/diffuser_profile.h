// How a diffuser distributes light over angles along one of its axes. Floor 0.
#pragma once
#include "display/display.h"

#include <vector>

namespace lfdsim {

/// The figures of a profile (docs/model.md, "Diffuser"). Their unit of angle is `diffuser.angle_deg`: a box's full angle, a normal
/// distribution's full width at half maximum. Theory of small angles takes slopes and lengths for angles.
struct ProfileFigures {
    double (*below)(double angle);     // the share of the light at smaller angles
    double (*transfer)(double waves);  // the contrast of a wave after the diffuser, periods per unit
    double scale;                      // the angle of scattering is this times u, or erfinv(u), u uniform in [-1, 1]
    double reach;                      // angle beyond which there is less than 1e-5 of the light
    double width;                      // full width that holds at least 98 % of the light
    bool rectangular;                  // along an oblique direction the axes' widths add up; otherwise their squares do
};

const ProfileFigures& figures_of(Profile);

/// A diffuser of Profile::box and its weight in a sum.
struct DiffuserBox {
    std::array<double, 2> angle_deg;  // full angles
    double weight;
};

/// Returns per_axis squared boxes about the middle of a normal distribution, whose sum has its first 4 per_axis - 1 moments along
/// each axis. Uniform light between -w and w makes up a normal distribution if w is distributed as w^2 exp(-w^2 / 2); these are
/// the nodes and weights of that weight's Gauss rule, the positive zeros of a Hermite polynomial of odd degree. Boxes end at
/// +-89 degrees, where the distribution is cut. Weights sum to 1. per_axis: 1 to 8.
std::vector<DiffuserBox> boxes_of_normal_distribution(const Diffuser&, int per_axis);

}  // namespace lfdsim
