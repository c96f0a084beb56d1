// What to write in place of an override's value that is not TOML. Floor 2.
#pragma once
#include <string>
#include <string_view>

namespace lfdsim {

/// Of a value that the parser refused, for the key at a dotted path ("lens.index", ".6"): what is wrong and what to write; empty:
/// nothing better is known than what the parser says.
std::string override_hint(std::string_view path, std::string_view value);

}  // namespace lfdsim
