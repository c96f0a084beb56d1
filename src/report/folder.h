// The folder in which measures leave what they found. Floor 4.
#pragma once
#include "analysis/measure.h"

#include <filesystem>
#include <string>
#include <vector>

namespace lfdsim {

/// Of each measure: NAME.json (its figures, and under "report" what the report shows), CSV tables, SVG plots and maps, PNG pictures
/// and animations (made smaller so that a report can hold them). Files are written beside and renamed; NAME.json comes last, so
/// that where it is, the measure is complete.
class ResultFolder {
  public:
    /// Makes the folder if it is missing. `settings`: all that the results depend on. Throws InputError if that is not possible.
    ResultFolder(std::filesystem::path, Json settings);

    const std::filesystem::path& path() const { return path_; }
    const Json& settings() const { return settings_; }

    /// Whether a measure has been finished there with the same settings.
    bool has(const Measure&) const;
    /// The measures that have been finished there with other settings, each with what differs: "fov (display, model)".
    std::vector<std::string> others() const;
    /// Removes their results, and the report.
    void remove_others() const;
    /// What NAME.json holds. Throws InputError if it cannot be read.
    Json read(const Measure&) const;
    /// Returns what NAME.json then holds. Throws std::runtime_error when writing fails.
    Json write(const Measure&, const Result&, double seconds) const;
    /// Writes a text file, beside and renamed.
    void write_text(const std::string& name, const std::string& text) const;

    /// The name of the report in a folder of results.
    static constexpr const char* report_name = "report.html";

  private:
    Json settings_of(const Measure&) const;

    std::filesystem::path path_;
    Json settings_;
};

}  // namespace lfdsim
