// The report: one HTML file with everything in a folder of results. Floor 4.
#pragma once
#include "analysis/core/subject.h"
#include "report/folder/folder.h"

#include <string>
#include <utility>
#include <vector>

namespace lfdsim {

struct ReportAbout {
    std::string command;                                              // the command line
    std::string description;                                          // the display's, TOML
    std::vector<const Measure*> wanted;                               // of this run
    std::vector<std::pair<const Measure*, std::string>> failed = {};  // and why
    bool interrupted = false;
};

/// Whether the folder holds a measure with its settings, to be shown.
bool has_results(const ResultFolder&);

/// First what was found and what is worth knowing, in short; then the figures, once; then each measure with its plots and pictures.
/// UTF-8, without scripts or references to other files: plots and pictures are inline, pictures about 1000 pixels wide. Shows every
/// measure that the folder holds with its settings; where some of those wanted are missing it says so at the top. The same folder
/// and arguments give the same text. A picture that cannot be read is named in its place.
std::string report_html(const Subject&, const ResultFolder&, const ReportAbout&);

}  // namespace lfdsim
