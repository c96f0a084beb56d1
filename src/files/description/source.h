// A description as parsed: its TOML tree with overrides applied, and where each part of it was written. Floor 2.
#pragma once
#include "base/input_error.h"

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <toml++/toml.h>

namespace lfdsim {

/// Where a value was written: line and column in the file (0: nowhere in particular), or an override.
struct SourcePosition {
    std::string text;  // "file:line:column", "--set key=value"
    std::size_t line = 0, column = 0;
};

class Source {
  public:
    /// Parses the text, which check_text() has passed, and applies the overrides ("dotted.key=value"). Throws InputError.
    Source(std::string_view text, std::string_view name, const std::vector<std::string>& overrides);

    const toml::table& root() const { return root_; }

    /// Place of the value at a dotted path ("lens.surface.0.index"), or of the innermost part of the path that exists.
    SourcePosition place(std::string_view path) const;
    /// Place of a key itself.
    SourcePosition place(const toml::key& key, std::string_view path) const;
    /// Whether an override gave the value, or took it away.
    bool is_set(std::string_view path) const { return set_.contains(std::string(path)); }

  private:
    SourcePosition at(const toml::source_region& region) const;
    void apply(const std::string& override_text);

    std::string name_;
    toml::table root_;
    std::map<std::string, std::string, std::less<>> set_;  // dotted path: the override as written
};

/// Whether the value at a dotted path is a word (a name, a file, a choice), which an override may give without quotes.
bool takes_word(std::string_view path);
/// Whether it is a glass: a name, which an override may give without quotes, or a table.
bool takes_glass(std::string_view path);

}  // namespace lfdsim
