// A description as parsed: its TOML tree with overrides applied, and where each part of it was written. Floor 2.
#pragma once
#include "base/input_error.h"

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <toml++/toml.h>

namespace lfdsim {

/// Where a value was written: in the file or in an override.
struct SourcePosition {
    std::string text;                  // "file:line:column", "--set key=value", or the file's name alone
    std::size_t line = 0, column = 0;  // from 1; 0: in an override, or nowhere in the file
};

/// The tree of a description's text. Paths are dotted, elements of lists are numbers from 0: "lens.surface.0.index".
class Source {
  public:
    /// Parses the text, which check_text() has passed, and applies the overrides ("dotted.key=value") in their order. Throws
    /// InputError: of the text the parser's first fault, else all faults of the overrides.
    Source(std::string_view text, std::string_view name, const std::vector<std::string>& overrides);

    const toml::table& root() const { return root_; }

    /// Returns the place of the value at a dotted path, or of the innermost part of the path that exists.
    SourcePosition place(std::string_view path) const;
    /// Returns the place of a key, which precedes its value; `path` is the key's.
    SourcePosition place(const toml::key& key, std::string_view path) const;
    /// Whether an override gave the value at this path, or removed it. An override of a table that contains it does not count.
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
/// Whether the value at a dotted path is a glass: a name, which an override may give without quotes, or a table.
bool takes_glass(std::string_view path);

}  // namespace lfdsim
