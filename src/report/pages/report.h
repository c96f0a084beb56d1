// The report: one HTML file with everything in a folder of results. Floor 4.
#pragma once
#include "analysis/core/subject.h"
#include "report/folder/folder.h"

#include <string>
#include <utility>
#include <vector>

namespace lfdsim {

/// What a report says about the run.
struct ReportAbout {
    std::string command;                                              // the command line
    std::string description;                                          // the display's, TOML
    std::vector<const Measure*> wanted;                               // measures of this run
    std::vector<std::pair<const Measure*, std::string>> failed = {};  // measures that refused their input, and why
    bool interrupted = false;
};

/// Whether the folder has the result of any measure with the folder's settings.
bool has_results(const ResultFolder&);

/// Returns the report: first the warnings and the main findings, in short; then the figures, once; then each measure with its plots
/// and pictures. It is UTF-8, without scripts or references to other files: plots and pictures are inline, pictures at most 1000
/// pixels wide. It shows every measure of the folder with the folder's settings; where some of those wanted are missing it says so
/// at the top. The same folder and arguments give the same text. In place of a picture that cannot be read is a message.
std::string report_html(const Subject&, const ResultFolder&, const ReportAbout&);

}  // namespace lfdsim
