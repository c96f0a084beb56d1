// The two halves of validate(). Floor 0.
#pragma once
#include "model/geometry.h"

#include <vector>

namespace lfdsim {

// Both add to problems found before, as by a reader: a key that could not be read is in `where` of one, and is not judged again.

/// Each key by itself: missing numbers, ranges, NaN, counts, keys that exclude or need one another.
void validate_values(const Display&, std::vector<Problem>&);

/// What stands in the way of what: lens solid, array, diffuser, camera, by the resolved geometry. Only of those tables that have no
/// problem yet, so that no fault is reported twice.
void validate_layout(const Display&, std::vector<Problem>&);

}  // namespace lfdsim
