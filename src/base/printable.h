// Text from files and command lines, made harmless for a person who reads it. Floor 0.
#pragma once
#include <string>
#include <string_view>

namespace lfdsim {

/// Escapes what a terminal or a page would obey in place of showing it: control characters (U+0000..U+001F, U+007F..U+009F),
/// marks that change the direction of writing, characters without a width, and separators of lines become \u and four
/// hexadecimal digits (two such, by UTF-16, above U+FFFF), as in JSON; bytes that are not UTF-8 become \x and two digits. For a
/// name: line breaks and tabs are escaped, too.
std::string printable(std::string_view text);

/// Makes text of several lines printable: as printable(), but line breaks and tabs remain.
std::string printable_lines(std::string_view text);

/// Returns whether printable() leaves the text as it is.
bool is_printable(std::string_view text);

/// Returns a word of a file or of the command line as a message quotes it: printable, at most 40 bytes of it, and "..." for the
/// rest.
std::string shortened(std::string_view word);

/// Returns a message of at most 900 bytes: the middle of a longer one is left out, with the number of bytes. The fault is named
/// at a message's beginning and the remedy at its end, and libraries quote files, too, so that any message may be long.
std::string bounded(std::string_view message);

}  // namespace lfdsim
