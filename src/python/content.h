// What a display shows, with what there is to warn of. Floor 5.
#pragma once
#include "content/content.h"

#include <string>
#include <vector>

namespace lfdsim::python {

/// The display's model, or its objects, in place; `notes` get what was dropped from their files or repaired. Throws InputError,
/// also where the job is cancelled while files are read.
ContentScene scene_of(const Display&, const Geometry&, std::vector<std::string>& notes, const Job&);

}  // namespace lfdsim::python
