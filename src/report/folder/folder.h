// The folder that holds the results of measures. Floor 4.
#pragma once
#include "analysis/core/measure.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace lfdsim {

/// Returns the lines of a report's table as they are in NAME.json and from Python.
Json to_json(const std::vector<Finding>&);

/// A folder that contains for each measure: NAME.json (its figures, and under "report" what the report shows), CSV tables, SVG
/// plots and maps, PNG pictures and animations (reduced, so that a report can contain them). Files are written under a temporary
/// name and renamed; NAME.json is written last, so a measure that has one is complete.
class ResultFolder {
  public:
    /// Makes the folder if it is missing. `settings`: an object with everything that the results depend on (run_settings.h). Throws
    /// InputError if the folder cannot be made.
    ResultFolder(std::filesystem::path, Json settings);

    const std::filesystem::path& path() const { return path_; }
    const Json& settings() const { return settings_; }

    /// Whether the folder has the result of a measure with the same settings, and all of its files.
    bool has(const Measure&) const;
    /// Returns the measures whose results have other settings, each with what differs: "fov (display, model)".
    std::vector<std::string> others() const;
    /// Removes the results of others(), and the report if there were any.
    void remove_others() const;
    /// With `replace`, does what remove_others() does. Otherwise throws InputError if there are others(), for a report that lfdsim
    /// has not written, and for files with the names of these measures that are not of their results. With `resume`, such files are
    /// allowed unless they are .json: an interrupted run may have left them.
    void keep_apart(std::span<const Measure* const> wanted, bool resume, bool replace) const;
    /// Returns the content of NAME.json. Throws InputError if it cannot be read.
    Json read(const Measure&) const;
    /// Returns the content of NAME.json as written. Throws std::runtime_error when writing fails.
    Json write(const Measure&, const Result&, double seconds) const;
    /// Writes a text file, under a temporary name first.
    void write_text(const std::string& name, const std::string& text) const;

    /// The name of the report in a folder of results.
    static constexpr const char* report_name = "report.html";
    /// The mark in the head of a report that lfdsim has written.
    static constexpr const char* report_mark = "<meta name=\"generator\" content=\"lfdsim\">";
    /// Throws InputError if there is a report without the mark that is not to be replaced.
    static void keep_report_apart(const std::filesystem::path& folder, bool replace);

  private:
    Json settings_of(const Measure&) const;
    /// Returns the keys whose values differ from this run's settings; "files" if one of a result's files has changed.
    std::vector<std::string> different_settings(const Json& theirs) const;
    bool wrote(const Measure&, const std::filesystem::path& name) const;

    std::filesystem::path path_;
    Json settings_;
};

}  // namespace lfdsim
