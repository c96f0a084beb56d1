// What to write in place of an override's value that is not TOML. Floor 2.
#pragma once
#include <string>
#include <string_view>

namespace lfdsim {

/// Explains a value that the parser refused, of the key at a dotted path ("lens.index", ".6"): what is wrong and what to write;
/// empty if nothing is better than the parser's message.
std::string override_hint(std::string_view path, std::string_view value);

}  // namespace lfdsim
