// What measures found, as text for a terminal. Floor 5.
#pragma once
#include "cli/output/output.h"

#include <string>

namespace lfdsim::cli {

/// A measure's findings as lines, theory beside measurement; `measured` is what its NAME.json holds.
std::string table_of(const Json& measured);

/// The table of what differences() found: a line for each figure with what all displays have, and whether the others differ from
/// the first.
std::string table_of_differences(const Json&);

}  // namespace lfdsim::cli
