// Pieces of HTML of which reports are made. `report` is the object "report" of a NAME.json, `measured` the whole of it. Floor 4.
#pragma once
#include "analysis/core/subject.h"
#include "report/folder/folder.h"

#include <string>
#include <vector>

namespace lfdsim {

/// Returns a finding's values in words: "-20.1 to 19.9°", "12.3 mm", "–" for none; "not found" where they are null.
std::string value_html(const Json& values, const std::string& unit);

/// Returns a value in four digits. What is nearer to 0 than 1e-12 of its unit is a rounding error: 0.
std::string digits_of(double value);

/// Returns " ± 0.02" for the largest of a finding's errors, one for each value, but for those that are too small to be seen in the
/// digits of their value; an empty text if there is none.
std::string error_text(const Json& errors, const Json& values);

/// Returns the rows of one measure in the table of theory and measurement.
std::string finding_rows(const Json& report);

/// Returns a row of the first table: the measure, and its first finding with the value by theory; without a finding, what it shows.
std::string headline_row(const Json& report);

/// Returns the first three pictures of a measure, small, as links to its section; empty if there are none.
std::string glance(const ResultFolder&, const Json& measured);

/// Returns a part that is shown when a reader opens it, and on paper. It needs no script: the style sheet shows the part that
/// follows an open <details>, and a link to the section opens it, too.
std::string folded(const std::string& summary, const std::string& html);

/// Returns the section of one measure: title, meaning, source, remarks, plots, pictures and all figures, from its NAME.json.
std::string measure_section(const ResultFolder&, const Json& measured);

/// Returns plots, maps, pictures and animations of one measure, in this order, as separate elements.
std::vector<std::string> figures_of(const ResultFolder&, const Json& measured);

/// Returns the display's drawings from the side, and its sizes and paraxial theory as a table.
std::string display_section(const Subject&);

/// The opening tag and the header of a table of findings.
extern const char* const findings_table;

}  // namespace lfdsim
