// The content of a display, with the warnings of reading it. Floor 5.
#pragma once
#include "content/content.h"

#include <string>
#include <vector>

namespace lfdsim::python {

/// The display's model, or its objects, placed before it. Appends to `notes` what was dropped from their files or repaired, once
/// for each file. Throws InputError, also if the job is cancelled while files are read.
ContentScene scene_of(const Display&, const Geometry&, std::vector<std::string>& notes, const Job&);

}  // namespace lfdsim::python
