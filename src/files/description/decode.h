// Conversion of text that other programs wrote to UTF-8. Floor 2.
#pragma once
#include <string>
#include <string_view>

namespace lfdsim {

/// Converts text to UTF-8: from UTF-16 if the bytes begin with its byte order mark; otherwise they are UTF-8 (a mark is removed)
/// or, if invalid as such, Latin-1. Unpaired halves of surrogate pairs become U+FFFD.
std::string to_utf8(std::string_view bytes);

}  // namespace lfdsim
