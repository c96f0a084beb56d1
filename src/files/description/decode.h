// Text that other programs wrote: its conversion to UTF-8, its lines and words. Floor 2.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace lfdsim {

/// Converts text to UTF-8: from UTF-16 if the bytes begin with its byte order mark; otherwise they are UTF-8 (a mark is removed)
/// or, if invalid as such, Latin-1. Unpaired halves of surrogate pairs become U+FFFD.
std::string to_utf8(std::string_view bytes);

/// Removes the first line of a text and returns it without its end, which is CR, LF, or CR and LF; next_line() knows LF alone.
std::string_view next_foreign_line(std::string_view& text);
/// Returns the words of a line, between blanks and tabs.
std::vector<std::string_view> words_of(std::string_view line);

}  // namespace lfdsim
