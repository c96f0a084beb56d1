#include "image/jpeg_memory.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include <jpeglib.h>  // wants cstdio before it

namespace lfdsim {
namespace {

// Throws in place of longjmp, as in jpeg.cpp.
[[noreturn]] void on_error(j_common_ptr common) {
    std::array<char, JMSG_LENGTH_MAX> text;
    common->err->format_message(common, text.data());
    throw std::runtime_error(std::string("JPEG: ") + text.data());
}

struct Writer {
    jpeg_compress_struct jpeg{};
    jpeg_error_mgr error{};
    unsigned char* bytes = nullptr;
    unsigned long size = 0;

    Writer() {
        jpeg.err = jpeg_std_error(&error);
        error.error_exit = on_error;
        jpeg_create_compress(&jpeg);
        jpeg_mem_dest(&jpeg, &bytes, &size);
    }
    ~Writer() {
        jpeg_destroy_compress(&jpeg);
        std::free(bytes);
    }
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;
};

}  // namespace

std::string jpeg_bytes(int width, int height, const std::vector<std::uint8_t>& codes, int quality) {
    if (width < 1 || height < 1 || width > JPEG_MAX_DIMENSION || height > JPEG_MAX_DIMENSION || quality < 1 || quality > 100 ||
        codes.size() != std::size_t(width) * std::size_t(height) * 3)
        throw std::invalid_argument("jpeg_bytes: size, codes or quality are not possible");
    Writer writer;
    jpeg_compress_struct& jpeg = writer.jpeg;
    jpeg.image_width = JDIMENSION(width);
    jpeg.image_height = JDIMENSION(height);
    jpeg.input_components = 3;
    jpeg.in_color_space = JCS_RGB;
    jpeg_set_defaults(&jpeg);  // 4:2:0
    jpeg_set_quality(&jpeg, quality, TRUE);
    jpeg_start_compress(&jpeg, TRUE);
    while (jpeg.next_scanline < jpeg.image_height) {
        std::array<JSAMPROW, 16> rows;  // as many as two blocks are high
        JDIMENSION count = 0;
        for (; count < rows.size() && jpeg.next_scanline + count < jpeg.image_height; ++count)
            rows[count] = const_cast<JSAMPROW>(&codes[std::size_t(jpeg.next_scanline + count) * std::size_t(width) * 3]);
        jpeg_write_scanlines(&jpeg, rows.data(), count);
    }
    jpeg_finish_compress(&jpeg);
    return std::string(reinterpret_cast<const char*>(writer.bytes), writer.size);
}

}  // namespace lfdsim
