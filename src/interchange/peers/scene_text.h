// Numbers and text in the syntax of scene files. Floor 2.
#pragma once
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <string_view>

namespace lfdsim::peers {

/// Returns the shortest text that reads back as the same double; 0 for values that are not finite.
inline std::string text(double x) { return std::isfinite(x) ? fmt::format("{}", x) : "0"; }

/// Returns "<x,y,z>", as POV-Ray writes vectors.
inline std::string vector(double x, double y, double z) { return fmt::format("<{},{},{}>", text(x), text(y), text(z)); }
inline std::string vector(const double* v) { return vector(v[0], v[1], v[2]); }

/// Returns a name with "?" in place of all characters but printable ASCII. Names come from outside: no character of theirs may end
/// a comment's line, or look as if it did.
inline std::string one_line(std::string_view name) {
    std::string line;
    for (const char c : name) line += static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) >= 0x7f ? '?' : c;
    return line;
}

/// Returns the lines, each after a mark that makes it a comment.
template <class Lines>
std::string comment(std::string_view mark, const Lines& lines) {
    std::string all;
    for (const auto& line : lines) all += fmt::format("{} {}\n", mark, one_line(line));
    return all;
}

}  // namespace lfdsim::peers
