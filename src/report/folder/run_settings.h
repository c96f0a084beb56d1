// Everything that the results of a run depend on, by which they are distinguished from those of other runs. Floor 4.
#pragma once
#include "analysis/core/result.h"
#include "analysis/core/subject.h"

#include <string>
#include <vector>

namespace lfdsim {

/// Returns the stamp of a file, {"file", "bytes", "changed"}, which changes with it; of a name that is not a file, {"file"}.
Json stamp(const std::string& file);
/// Returns the stamp of a display's model, or a list of those of its objects' files.
Json content_stamp(const Display&);
/// Returns the files that a description names, in the order of their keys; with `content` those of [content], too.
std::vector<std::string> named_files(Display, bool content);
/// Returns the stamps of files, each once.
Json stamps(const std::vector<std::string>& files);
/// Returns whether each of the files is as it was when its stamp was taken; false for what is no list of stamps.
bool files_unchanged(const Json& stamps);

/// Returns the settings of a ResultFolder for the measures of a subject; `version` is the program's.
Json run_settings(const Subject&, const std::string& version);

}  // namespace lfdsim
