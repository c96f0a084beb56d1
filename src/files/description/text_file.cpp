#include "files/description/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "base/input_error.h"

namespace lfdsim {
namespace {

constexpr int deepest = 16;  // levels of nesting; a description needs 3

[[noreturn]] void refuse_size(std::string_view name, std::uintmax_t bytes, std::size_t most, std::string_view kind) {
    throw InputError(std::string(name), fmt::format("has {} bytes, allowed are {}; is this {}?", bytes, most, kind));
}

// Returns where a TOML string that starts at `i` ends: after its closing quotes or, without them, at the end of the line or text.
// Three quotes enclose strings of several lines, which may themselves end in one or two quotes; only double quotes have escapes.
std::size_t skip_string(std::string_view text, std::size_t i) {
    const char quote = text[i];
    const std::string_view fence = text.substr(i, 3);
    const bool multi_line = fence.size() == 3 && fence[1] == quote && fence[2] == quote;
    const std::string_view end = multi_line ? fence : fence.substr(0, 1);
    for (i += end.size(); i < text.size(); ++i) {
        if (text[i] == '\\' && quote == '"')
            ++i;
        else if (text[i] == '\n' && !multi_line)
            return i;
        else if (text.substr(i, end.size()) == end) {
            i += end.size();
            for (const std::size_t last = i + 2; multi_line && i < std::min(last, text.size()) && text[i] == quote;) ++i;
            return i;
        }
    }
    return text.size();
}

}  // namespace

std::string read_text(const std::filesystem::path& path, std::string_view kind, std::size_t most_bytes) {
    const std::string name = path.string();
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (error == std::errc::permission_denied) throw InputError(name, "cannot be read: " + error.message());
    if (!std::filesystem::exists(status)) throw InputError(name, "there is no such file");
    if (std::filesystem::is_directory(status)) throw InputError(name, "is a folder; give the file in it");
    if (!std::filesystem::is_regular_file(status)) throw InputError(name, "is not a regular file");
    const std::uintmax_t bytes = std::filesystem::file_size(path, error);
    if (!error && bytes > most_bytes) refuse_size(name, bytes, most_bytes, kind);
    std::ifstream file(path, std::ios::binary);
    if (!file) throw InputError(name, "cannot be opened for reading; check its permissions");
    // One byte more than the file's size is read, and no more even if the file grows meanwhile.
    std::string text(error ? most_bytes + 1 : std::size_t(bytes) + 1, '\0');
    file.read(text.data(), std::streamsize(text.size()));
    text.resize(std::size_t(file.gcount()));
    if (file.bad()) throw InputError(name, "cannot be read to its end");
    return text;
}

void check_text(std::string_view text, std::string_view name) {
    if (text.size() > largest_text_bytes) refuse_size(name, text.size(), largest_text_bytes, "a display description");
    if (text.find('\0') != text.npos) throw InputError(std::string(name), "is a binary file, not a display description in TOML");
    if (text.find_first_not_of(" \t\r\n") == text.npos)
        throw InputError(std::string(name), "is empty; a display description starts with schema = 1");
    // The parser recurses into brackets, and into the tables of a dotted key when it frees them. This scan of strings, comments,
    // brackets and dots finds the depth; it is right up to the text's first fault, where the parser stops.
    int brackets = 0, dots = 0, line = 1;
    for (std::size_t i = 0, line_start = 0; i < text.size();) {
        const char c = text[i];
        if (c == '"' || c == '\'') {
            const std::size_t end = skip_string(text, i);
            for (; i < end; ++i)
                if (text[i] == '\n') ++line, line_start = i + 1;
            continue;
        }
        if (c == '#') {
            i = std::min(text.find('\n', i), text.size());
            continue;
        }
        if (c == '[' || c == '{')
            ++brackets;
        else if (c == ']' || c == '}')
            brackets = std::max(brackets - 1, 0);
        if (c == '.')
            ++dots;
        else if (std::string_view("=,[]{}\n").find(c) != std::string_view::npos)
            dots = 0;
        if (brackets + dots > deepest)
            throw InputError(
                fmt::format("{}:{}:{}", name, line, i - line_start + 1),
                fmt::format("is nested {} levels deep, allowed are {}; a display description needs 3", brackets + dots, deepest));
        if (c == '\n') ++line, line_start = i + 1;
        ++i;
    }
}

}  // namespace lfdsim
