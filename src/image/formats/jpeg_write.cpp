#include "image/formats/jpeg_memory.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include <jpeglib.h>  // wants cstdio before it

namespace lfdsim {
namespace {

// libjpeg's hook throws in place of longjmp, as those of jpeg.cpp do.
[[noreturn]] void on_error(j_common_ptr common) {
    std::array<char, JMSG_LENGTH_MAX> text;
    common->err->format_message(common, text.data());
    throw std::runtime_error(std::string("JPEG: ") + text.data());
}

struct JpegWriter {
    jpeg_compress_struct jpeg{};
    jpeg_error_mgr error{};
    unsigned char* bytes = nullptr;
    unsigned long size = 0;

    JpegWriter() {
        jpeg.err = jpeg_std_error(&error);
        error.error_exit = on_error;
        jpeg_create_compress(&jpeg);
        jpeg_mem_dest(&jpeg, &bytes, &size);
    }
    ~JpegWriter() {
        jpeg_destroy_compress(&jpeg);
        std::free(bytes);
    }
    JpegWriter(const JpegWriter&) = delete;
    JpegWriter& operator=(const JpegWriter&) = delete;
};

// A picture is compressed in strips, each eight rows of the blocks of 16 x 16 pixels, by several threads. Between two strips is a
// restart marker, after which a decoder begins anew, too (ITU-T T.81, E.1.4 and F.1.2.1).
constexpr int strip_rows = 8 * 16;

/// Returns the rows from `top` to top + rows - 1 as a separate file.
std::string strip(int width, int top, int rows, const std::vector<std::uint8_t>& codes, int quality) {
    JpegWriter writer;
    jpeg_compress_struct& jpeg = writer.jpeg;
    jpeg.image_width = JDIMENSION(width);
    jpeg.image_height = JDIMENSION(rows);
    jpeg.input_components = 3;
    jpeg.in_color_space = JCS_RGB;
    jpeg_set_defaults(&jpeg);  // 4:2:0
    jpeg_set_quality(&jpeg, quality, TRUE);
    jpeg.restart_in_rows = strip_rows / 16;  // stated in the header; no marker falls within a strip
    jpeg_start_compress(&jpeg, TRUE);
    while (jpeg.next_scanline < jpeg.image_height) {
        std::array<JSAMPROW, 16> rows_at_once;
        JDIMENSION count = 0;
        for (; count < rows_at_once.size() && jpeg.next_scanline + count < jpeg.image_height; ++count)
            rows_at_once[count] =
                const_cast<JSAMPROW>(&codes[(std::size_t(top) + jpeg.next_scanline + count) * std::size_t(width) * 3]);
        jpeg_write_scanlines(&jpeg, rows_at_once.data(), count);
    }
    jpeg_finish_compress(&jpeg);
    return std::string(reinterpret_cast<const char*>(writer.bytes), writer.size);
}

constexpr std::size_t end_marker = 2;  // bytes

/// The positions in a strip's file where the compressed pixels begin (`end`), after the segments of the header, each a marker of
/// two bytes and its length, and where the header has the number of rows.
struct Header {
    std::size_t end = 2, rows = 0;

    explicit Header(const std::string& file) {
        constexpr char frame = '\xc0', scan = '\xda';
        for (char marker = 0; marker != scan;) {
            marker = file.at(end + 1);
            if (marker == frame) rows = end + 5;
            end += 2 + 256 * std::size_t(std::uint8_t(file.at(end + 2))) + std::size_t(std::uint8_t(file.at(end + 3)));
        }
    }
};

}  // namespace

std::string jpeg_bytes(int width, int height, const std::vector<std::uint8_t>& codes, int quality) {
    if (width < 1 || height < 1 || width > JPEG_MAX_DIMENSION || height > JPEG_MAX_DIMENSION || quality < 1 || quality > 100 ||
        codes.size() != std::size_t(width) * std::size_t(height) * 3)
        throw std::invalid_argument("jpeg_bytes: size, codes or quality are not possible");
    std::vector<std::string> strips(std::size_t((height + strip_rows - 1) / strip_rows));
    tbb::parallel_for(std::size_t(0), strips.size(), [&](std::size_t k) {
        const int top = int(k) * strip_rows;
        strips[k] = strip(width, top, std::min(strip_rows, height - top), codes, quality);
    });
    std::string all = std::move(strips[0]);
    // The first strip's header, with the height of the whole picture, then the pixels of all strips, with restart markers 0 to 7 in
    // turn.
    const Header header(all);  // the headers of all strips have the same number of bytes
    all[header.rows] = char(height / 256);
    all[header.rows + 1] = char(height % 256);
    for (std::size_t k = 1; k < strips.size(); ++k) {
        all.resize(all.size() - end_marker);
        all += '\xff';
        all += char(0xd0 + (k - 1) % 8);
        all.append(strips[k], header.end);
    }
    return all;
}

}  // namespace lfdsim
