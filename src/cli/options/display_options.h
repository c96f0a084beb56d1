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

/// The form of an option's value: a number, two, three (X,Y,Z) or six numbers, WxH, a whole number, or a word.
enum class Form { number, pair, point, box, size, count, word };

/// An option that overrides a key of the description.
struct KeyOption {
    const char* option;
    const char* key;
    Form form;
    const char* value;  // as help shows it
    const char* help;
    const char* replaces = nullptr;  // another key for the same property, which is removed
};

extern const std::span<const KeyOption> camera_options;   // the camera's position and the size of the picture
extern const std::span<const KeyOption> sample_options;   // the samples of a rendering
extern const std::span<const KeyOption> point_options;    // sample_options without the estimator
extern const std::span<const KeyOption> content_options;  // the model's pose, and the pick-up

/// The description of a command, with --set and groups of options that override its keys.
class DisplayOptions {
  public:
    /// Adds the argument DISPLAY.toml, --set and the groups.
    explicit DisplayOptions(Command command, std::initializer_list<std::span<const KeyOption>> groups = {}, bool required = true);

    /// Returns the description with all overrides, validated. Throws InputError with all problems; those of an option have its
    /// name.
    Display read() const { return read(path()); }
    /// Returns another description with the same overrides, and after them that of --compare if it is not empty.
    Display read(const std::string& path, const std::string& compared = {}) const;
    /// Returns --set and the options as "key=value", in the order in which they apply. Throws InputError.
    std::vector<std::string> overrides() const;
    const std::string& path() const { return path_.text(); }
    /// Whether an option of the groups was given.
    bool given(std::string_view option) const;

  private:
    // Returns the overrides, and for "--set OVERRIDE", the place that errors have, the text that the user wrote.
    std::pair<std::vector<std::string>, std::map<std::string, std::string>> all_overrides(Faults&) const;

    Option path_;
    List settings_;
    std::vector<std::pair<const KeyOption*, Option>> options_;
};

}  // namespace lfdsim::cli
