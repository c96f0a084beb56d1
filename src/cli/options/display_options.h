// The description file and the options that override its keys. Floor 5.
#pragma once
#include "cli/program/arguments.h"
#include "cli/program/command.h"
#include "display/display.h"

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lfdsim::cli {

enum class Form { number, pair, point, box, size, count, word };

/// An option that stands for a key of the description.
struct KeyOption {
    const char* option;
    const char* key;
    Form form;
    const char* value;  // as help shows it
    const char* help;
    const char* replaces = nullptr;  // a key of the description that says the same in another way
};

extern const std::span<const KeyOption> camera_options;   // from where and how large the picture is
extern const std::span<const KeyOption> sample_options;   // how a rendering samples
extern const std::span<const KeyOption> point_options;    // those of them that matter where no estimator is chosen
extern const std::span<const KeyOption> content_options;  // where the model stands

class DisplayOptions {
  public:
    /// Adds DISPLAY.toml and --set.
    explicit DisplayOptions(Command command, std::initializer_list<std::span<const KeyOption>> groups = {}, bool required = true);

    /// The description with all overrides, validated. Throws InputError with all problems; those of an option carry its name.
    Display read() const { return read(path()); }
    /// Another description with the same overrides, and after them one of --compare if it is not empty.
    Display read(const std::string& path, const std::string& compared = {}) const;
    /// --set and the options as "key=value", in the order in which they apply. Throws InputError.
    std::vector<std::string> overrides() const;
    const std::string& path() const { return path_.text(); }
    /// Whether an option of the groups was given.
    bool given(std::string_view option) const;

  private:
    // With, for each override, the place that messages give for it: what the user wrote.
    std::pair<std::vector<std::string>, std::map<std::string, std::string>> all_overrides(Faults&) const;

    Option path_;
    List settings_;
    std::vector<std::pair<const KeyOption*, Option>> options_;
};

}  // namespace lfdsim::cli
