// What the results of a run depend on, so that they can be told from those of another. Floor 4.
#pragma once
#include "analysis/core/result.h"
#include "analysis/core/subject.h"

#include <string>

namespace lfdsim {

/// The stamp of a file, which changes with it; of a name that is no file's, only the name.
Json stamp(const std::string& file);
/// The stamps of a display's content: of its model, or a list of its objects' files.
Json content_stamp(const Display&);

/// The settings of a ResultFolder for the measures of a subject.
Json run_settings(const Subject&, const std::string& version);

}  // namespace lfdsim
