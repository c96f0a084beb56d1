// Files by Assimp's way of opening them, which keeps to the model's folder.
#pragma once
#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>

#include <optional>
#include <string>

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

}  // namespace lfdsim::reader
