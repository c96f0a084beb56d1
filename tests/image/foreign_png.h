// PNG files of all the kinds that other programs write, made with libpng.
#pragma once
#include <png.h>
#include <zlib.h>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

namespace lfdsim::test {

inline std::string big_endian(std::uint32_t value, int bytes = 4) {
    std::string text;
    for (int k = bytes - 1; k >= 0; --k) text += char(value >> (8 * k));
    return text;
}

/// Returns a chunk of a PNG file with its length and sum.
inline std::string chunk(const std::string& name, const std::string& data) {
    const std::string body = name + data;
    const uLong crc = crc32(0, reinterpret_cast<const Bytef*>(body.data()), uInt(body.size()));
    return big_endian(std::uint32_t(data.size())) + body + big_endian(std::uint32_t(crc));
}

struct ForeignPng {
    png_uint_32 width, height;
    int depth, color_type;
    std::vector<std::vector<png_byte>> rows;  // packed as the file holds them
    bool interlaced = false;
    std::vector<png_color> palette{};
    bool transparent_color = false;
};

inline void save_png(const std::filesystem::path& path, ForeignPng picture) {
    std::FILE* const file = std::fopen(path.c_str(), "wb");
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, file);
    png_set_IHDR(png, info, picture.width, picture.height, picture.depth, picture.color_type,
                 picture.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    if (!picture.palette.empty()) png_set_PLTE(png, info, picture.palette.data(), int(picture.palette.size()));
    const png_color_16 black{};
    if (picture.transparent_color) png_set_tRNS(png, info, nullptr, 0, &black);
    png_write_info(png, info);
    std::vector<png_bytep> rows;
    for (auto& row : picture.rows) rows.push_back(row.data());
    png_set_interlace_handling(png);
    png_write_image(png, rows.data());
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    std::fclose(file);
}

}  // namespace lfdsim::test
