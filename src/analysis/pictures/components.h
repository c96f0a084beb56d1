// The measure "components": pictures of the parts of a display one by one, the component tests of the 2019 paper. Floor 3.
#pragma once
#include "analysis/core/result.h"
#include "analysis/core/subject.h"

namespace lfdsim {

/// Returns the number of pictures.
std::int64_t components_steps(const Subject&);
/// Makes pictures of a checkerboard on the panel through the lens array alone and through the diffuser alone, of the scene's
/// elemental images, of what the whole display shows of them, and close-ups of both. Throws Stopped; InputError if there is no
/// scene.
Result measure_components(Subject&, Job&);

}  // namespace lfdsim
