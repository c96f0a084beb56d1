// The folder that holds the results of measures. Floor 4.
#pragma once
#include "analysis/core/measure.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace lfdsim {

/// Holds for each measure: NAME.json (its figures, and under "report" what the report shows), CSV tables, SVG plots and maps, PNG
/// pictures and animations (made smaller so that a report can hold them). Files are written under a temporary name and renamed;
/// NAME.json is written last, so a measure that has one is complete.
class ResultFolder {
  public:
    /// Makes the folder if it is missing. `settings`: everything the results depend on. Throws InputError if it cannot be made.
    ResultFolder(std::filesystem::path, Json settings);

    const std::filesystem::path& path() const { return path_; }
    const Json& settings() const { return settings_; }

    /// Whether a measure has been finished there with the same settings.
    bool has(const Measure&) const;
    /// The measures that have been finished there with other settings, each with what differs: "fov (display, model)".
    std::vector<std::string> others() const;
    /// Removes their results, and the report.
    void remove_others() const;
    /// Removes them if they are to be replaced. Throws InputError that lists them otherwise, and InputError for files that these
    /// measures would write over and that are no result of theirs: under their names where `resume` does not say that an earlier
    /// run may have left them, and a report that lfdsim has not written.
    void keep_apart(std::span<const Measure* const> wanted, bool resume, bool replace) const;
    /// The content of NAME.json. Throws InputError if it cannot be read.
    Json read(const Measure&) const;
    /// Returns the content of NAME.json as written. Throws std::runtime_error when writing fails.
    Json write(const Measure&, const Result&, double seconds) const;
    /// Writes a text file, under a temporary name first.
    void write_text(const std::string& name, const std::string& text) const;

    /// The name of the report in a folder of results.
    static constexpr const char* report_name = "report.html";
    /// The mark in a report's head that lfdsim has written it.
    static constexpr const char* report_mark = "<meta name=\"generator\" content=\"lfdsim\">";
    /// Throws InputError if there is a report that does not have it.
    static void keep_report_apart(const std::filesystem::path& folder, bool replace);

  private:
    Json settings_of(const Measure&) const;
    bool wrote(const Measure&, const std::filesystem::path& name) const;

    std::filesystem::path path_;
    Json settings_;
};

}  // namespace lfdsim
