// A comparison of displays that were measured in the same way. Floor 4.
#pragma once
#include "display/display.h"
#include "report/folder/folder.h"

#include <span>
#include <string>
#include <vector>

namespace lfdsim {

/// A display and the folder of its results: a subfolder, with its name, of the folder that holds the comparison.
struct MeasuredDisplay {
    std::string name;
    Display display;
    ResultFolder folder;
};

/// Returns the differences as plain data: {"displays": [names], "settings": [{"key", "values"}], "findings": [{"measure", "what",
/// "unit", "measured", "error", "difference", "more_than_errors"}]}. "settings" has the keys of the description whose values are
/// not all the same. "measured" and "error" have a list for each display, null where it has no such figure; "difference" has that
/// of each other display from the first; "more_than_errors" says for each whether it exceeds the sum of both errors, null where an
/// error is not stated.
Json differences(std::span<const MeasuredDisplay>);

/// Returns the comparison as a page, with plots and pictures of the same measure next to each other; like report_html() a single
/// file, except for links to the reports in the subfolders. `missing` is a sentence on what could not be measured, or empty.
std::string side_by_side_html(std::span<const MeasuredDisplay>, const Json& differences, const std::string& command,
                              const std::string& missing);

}  // namespace lfdsim
