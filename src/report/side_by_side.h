// Displays measured in the same way, beside one another. Floor 4.
#pragma once
#include "model/display.h"
#include "report/folder.h"

#include <span>
#include <string>
#include <vector>

namespace lfdsim {

/// A display and the folder that holds what was found of it: a subfolder, of its name, of the folder that holds the comparison.
struct MeasuredDisplay {
    std::string name;
    Display display;
    ResultFolder folder;
};

/// What is different, as plain data: {"displays": [names], "settings": [{"key", "values"}], "findings": [{"measure", "what",
/// "unit", "measured", "error", "difference", "more_than_errors"}]}. "settings" holds the keys of the description whose values are
/// not all the same. "measured" and "error" hold a list for each display, null where it has no such figure; "difference" that of
/// each display to the first one; "more_than_errors" whether it is more than the errors of both together, null where they state
/// none.
Json differences(std::span<const MeasuredDisplay>);

/// The same as a page, plots and pictures of the same measure next to each other; like report_html() a file by itself, but that it
/// links to the reports in the subfolders. `missing`: a sentence on what could not be measured; empty: nothing is missing.
std::string side_by_side_html(std::span<const MeasuredDisplay>, const Json& differences, const std::string& command,
                              const std::string& missing);

}  // namespace lfdsim
