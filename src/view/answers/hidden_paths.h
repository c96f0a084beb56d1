// Removes absolute paths from messages to visitors. Floor 5.
#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace lfdsim::view {

/// A visitor learns names of files in the served folder, and of no other place. Paths come into messages in many ways (errors of
/// readers, the command to copy, descriptions that name files elsewhere), so they are taken out of every message where it is sent.
class HiddenPaths {
  public:
    /// Hides folders in messages. The served folder is left out of the paths in it. Of other absolute paths only the last part is
    /// left, as in "…/tablet.toml"; `others` are folders that are known by name, so that their own parts may have any characters.
    HiddenPaths(const std::filesystem::path& served, const std::vector<std::filesystem::path>& others);

    /// Returns a message in JSON without absolute paths.
    std::string without(const std::string& json) const;

  private:
    std::vector<std::pair<std::string, std::string>> folders_;  // as written in JSON, and what replaces it; the longest first
};

}  // namespace lfdsim::view
