// The size of a picture in a file, without its pixels. Floor 0.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>

namespace lfdsim {

/// Returns columns and rows. Only the file's header is read. Throws like read_image().
std::array<std::int64_t, 2> picture_size(const std::filesystem::path&);

}  // namespace lfdsim
