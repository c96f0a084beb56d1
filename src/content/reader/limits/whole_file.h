// Files by Assimp's way of opening them, which keeps to the model's folder.
#pragma once
#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>

#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>

namespace lfdsim::reader {

/// Reads a whole file; nothing if it cannot be opened.
inline std::optional<std::string> whole_file(Assimp::IOSystem& io, const std::string& file) {
    Assimp::IOStream* const stream = io.Open(file.c_str(), "rb");
    if (!stream) return {};
    std::string bytes(stream->FileSize(), '\0');
    bytes.resize(bytes.empty() ? 0 : stream->Read(bytes.data(), 1, bytes.size()));
    io.Close(stream);
    return bytes;
}

/// The byte order mark of UTF-8, which most of Assimp's loaders take for a part of the first word.
inline constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

/// Returns whether a file begins with it; bytes_without_mark() returns what follows it, or the whole file.
inline bool has_byte_order_mark(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    char first[byte_order_mark.size()] = {};
    return stream.read(first, sizeof first) && std::string_view(first, sizeof first) == byte_order_mark;
}
inline std::string bytes_without_mark(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    if (has_byte_order_mark(file)) stream.ignore(byte_order_mark.size());
    return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace lfdsim::reader
