// What measures found, as text for a terminal. Floor 5.
#pragma once
#include "cli/output/output.h"

#include <string>

namespace lfdsim::cli {

/// Returns a measure's findings as lines, theory beside measurement; `measured` is the content of its NAME.json.
std::string table_of(const Json& measured);

/// Returns the result of differences() as a table: a line for each figure with the values of all displays, and whether the others
/// differ from the first by more than the errors.
std::string table_of_differences(const Json&);

}  // namespace lfdsim::cli
