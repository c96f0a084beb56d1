// The two halves of validate(). Floor 0.
#pragma once
#include "model/geometry.h"

#include <vector>

namespace lfdsim {

/// Each key by itself: missing numbers, ranges, NaN, counts, keys that exclude or need one another.
void validate_values(const Display&, std::vector<Problem>&);

/// What stands in the way of what: lens solid, array, diffuser, camera, by the resolved geometry. Takes up only those parts that
/// validate_values() found in order, so that no fault is reported twice.
void validate_layout(const Display&, std::vector<Problem>&);

}  // namespace lfdsim
