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

/// Makes text of several lines printable, whose line breaks and tabs are its own.
std::string printable_lines(std::string_view text);

/// Whether printable() leaves the text as it is.
bool is_printable(std::string_view text);

/// A word of a file or of the command line as a message quotes it: printable, 40 bytes of it at most, and an ellipsis for the
/// rest.
std::string shortened(std::string_view word);

/// A whole message, whoever wrote it (libraries quote files, too): the middle of a long one is left out, with the number of
/// bytes. What is wrong stands at its beginning, and the remedy at its end.
std::string bounded(std::string_view message);

}  // namespace lfdsim
