// Display descriptions (TOML) in and out. Floor 2, public.
#pragma once
#include "base/input_error.h"
#include "display/display.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace lfdsim {

/// Reads and validates a description. `overrides` are "dotted.key=value" with the value in TOML syntax, applied before validation.
/// Throws InputError with every problem found, each as file:line:column (or --set key) with what was given and what is allowed;
/// an unknown key names the nearest known one. Files that it names (content.model, those of content.object, glass_catalogues)
/// become relative to the working directory; glasses are looked up. With overrides the default of content.depth_mm is that of the
/// description as written.
Display read_display(const std::filesystem::path&, const std::vector<std::string>& overrides = {});

/// Reads a description from text; `name` is the file's name in messages, and files that the text names are relative to `folder`.
/// Limits: 1 MiB of text, 16 levels.
Display parse_display(std::string_view text, std::string_view name, const std::vector<std::string>& overrides = {},
                      const std::filesystem::path& folder = {});

/// Returns the display with further overrides, as if its description had been read with them after those that it was read with.
/// Files that they name are relative to the working directory.
Display changed(const Display&, const std::vector<std::string>& overrides);

/// Returns a description that reads back as the same display: every key that has a value, and glasses of catalogues by their
/// coefficients, so that glass_catalogues is left out. Names of files are written as the display has them, relative to the working
/// directory.
std::string write_display(const Display&);

/// Returns the text of docs/format.md: name, type, unit, range, default and meaning of every key.
std::string format_reference_markdown();

}  // namespace lfdsim
