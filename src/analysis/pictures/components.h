// The parts of a display one by one, as pictures: the component tests of the 2019 paper. Floor 3.
#pragma once
#include "analysis/core/result.h"
#include "analysis/core/subject.h"

namespace lfdsim {

std::int64_t components_steps(const Subject&);
/// A checkerboard on the panel through the lens array alone, and through the diffuser alone; the scene's elemental images; what the
/// whole display shows of them; close-ups of both.
Result measure_components(Subject&, Job&);

}  // namespace lfdsim
