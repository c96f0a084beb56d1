// Hints for values that are not TOML, of overrides and of lines in a description: decimal commas, units, missing brackets. Floor 2.
#pragma once
#include <string>
#include <string_view>

namespace lfdsim {

/// Explains a value that the parser refused, such as ".6" for the key "lens.index": what is wrong and what to write. Empty if the
/// parser's message is better; `path` need not be a known key.
std::string override_hint(std::string_view path, std::string_view value);

}  // namespace lfdsim
