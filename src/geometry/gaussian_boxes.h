// A gaussian diffuser as a sum of even ones. Floor 0.
#pragma once
#include "display/display.h"

#include <vector>

namespace lfdsim {

struct DiffuserBox {
    std::array<double, 2> angle_deg;  // full angles, as of a diffuser of Profile::box
    double weight;
};

/// `per_axis` squared boxes, about the same middle as the bell, whose sum has its first 4 per_axis - 1 moments along each axis.
/// Even light between -w and w makes up a normal distribution if w is distributed as w^2 exp(-w^2 / 2); these are the nodes and
/// weights of that weight's Gauss rule, the positive zeros of a Hermite polynomial of odd degree. Boxes end at +-89 degrees, where
/// the bell is cut. Weights sum to 1. per_axis: 1 to 8.
std::vector<DiffuserBox> boxes_of_bell(const Diffuser&, int per_axis);

}  // namespace lfdsim
