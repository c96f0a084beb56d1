// Pieces of the report. Floor 4.
#pragma once
#include "analysis/core/subject.h"
#include "report/folder/folder.h"

#include <string>
#include <vector>

namespace lfdsim {

/// "-20.1 to 19.9°", "12.3 mm", "–" for none; null: "not found".
std::string value_html(const Json& values, const std::string& unit);

/// " ± 0.02", the largest of a finding's errors; nothing if none is stated.
std::string error_text(const Json& errors);

/// Rows of the table of theory and measurement.
std::string finding_rows(const Json& report);

/// A row of the table at the head: the measure, its first finding with theory's value; without a finding, what it shows.
std::string headline_row(const Json& report);

/// The first pictures of a measure, small, as links to its section. Empty if there are none.
std::string glance(const ResultFolder&, const Json& measured);

/// A part that is shown when a reader opens it, and on paper. It needs no script: the switch is before what it opens, and a link
/// to the section opens it, too.
std::string folded(const std::string& summary, const std::string& html);

/// Title, meaning, source, remarks, plots, pictures and all figures of one measure, from its NAME.json.
std::string measure_section(const ResultFolder&, const Json& measured);

/// Plots, maps, pictures and animations of one measure, in this order, as separate elements.
std::vector<std::string> figures_of(const ResultFolder&, const Json& measured);

/// Sizes and paraxial theory of the display as a table, and its views from the side.
std::string display_section(const Subject&);

/// Opening tag and rows' header of a table of findings.
extern const char* const findings_table;

}  // namespace lfdsim
