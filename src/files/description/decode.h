// Text of older programs in UTF-8. Floor 2.
#pragma once
#include <string>
#include <string_view>

namespace lfdsim {

/// From UTF-16 where the bytes begin with its mark; else they are UTF-8 (its mark is cut off), or, where they cannot be, Latin-1.
/// Halves of surrogate pairs that stand alone become U+FFFD.
std::string to_utf8(std::string_view bytes);

}  // namespace lfdsim
