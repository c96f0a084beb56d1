#include "image/encoding.h"
#include "image/formats.h"

#include <fmt/format.h>
#include <png.h>
#include <array>
#include <vector>

namespace lfdsim::detail {
namespace {

// libpng lets its error function throw in place of longjmp: every x86-64 library carries the tables that unwinding needs.
[[noreturn]] void on_error(png_structp png, png_const_charp message) {
    static_cast<const InputFile*>(png_get_error_ptr(png))->refuse(fmt::format("is damaged: {}", message));
}

void on_warning(png_structp, png_const_charp) {}

void on_read(png_structp png, png_bytep to, std::size_t bytes) {
    if (std::fread(to, 1, bytes, static_cast<std::FILE*>(png_get_io_ptr(png))) != bytes) png_error(png, "it ends too early");
}

struct Reader {
    png_structp png;
    png_infop info;

    explicit Reader(const InputFile& file)
        : png(png_create_read_struct(PNG_LIBPNG_VER_STRING, const_cast<InputFile*>(&file), on_error, on_warning)),
          info(png ? png_create_info_struct(png) : nullptr) {
        if (!info) throw std::bad_alloc();
        png_set_read_fn(png, file.stream(), on_read);
    }
    ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;
};

/// Reads all rows; `Code` is the type of a sample.
template <class Code>
void read_rows(const Reader& reader, int passes, std::int64_t rows, const std::vector<float>& table, const Pixels& pixels) {
    // Interlaced pictures come in passes, each of which touches every row: all codes must be kept until the last.
    const std::size_t row_codes = std::size_t(pixels.columns) * 3;
    std::vector<Code> codes(row_codes * (passes > 1 ? std::size_t(rows) : 1));
    for (int pass = 0; pass < passes; ++pass)
        for (std::int64_t r = 0; r < rows; ++r) {
            Code* const row = codes.data() + (passes > 1 ? std::size_t(r) * row_codes : 0);
            png_read_row(reader.png, reinterpret_cast<png_bytep>(row), nullptr);
            if (pass == passes - 1) decode_row(row, table, pixels.columns, pixels.stride, pixels.row(r));
        }
}

}  // namespace

void read_png(const InputFile& file, Encoding encoding, const Allocate& allocate) {
    std::array<png_byte, 8> signature{};
    if (std::fread(signature.data(), 1, 8, file.stream()) != 8 || png_sig_cmp(signature.data(), 0, 8) != 0)
        file.refuse("is not a PNG file, whatever its name says");

    const Reader reader(file);
    png_set_sig_bytes(reader.png, 8);
    png_set_user_limits(reader.png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);  // check_size is stricter
    png_set_chunk_cache_max(reader.png, 16);                            // texts are not used: do not collect them
    png_read_info(reader.png, reader.info);

    const std::int64_t columns = png_get_image_width(reader.png, reader.info);
    const std::int64_t rows = png_get_image_height(reader.png, reader.info);
    const int color = png_get_color_type(reader.png, reader.info), depth = png_get_bit_depth(reader.png, reader.info);
    const int bits_per_pixel = depth * png_get_channels(reader.png, reader.info);
    file.check_size(columns, rows, 1032.0 * 8 / bits_per_pixel);  // deflate packs 1032 bytes into one at best
    if ((color & PNG_COLOR_MASK_ALPHA) || png_get_valid(reader.png, reader.info, PNG_INFO_tRNS))
        file.refuse(
            "has transparency (an alpha channel), which a panel cannot show; remove it, for instance with "
            "'convert IN.png -background black -alpha remove -alpha off OUT.png'");

    png_set_expand(reader.png);  // palettes to RGB, gray of 1, 2, 4 bits to 8
    png_set_gray_to_rgb(reader.png);
    if (depth == 16) png_set_swap(reader.png);  // big-endian in the file
    const int passes = png_set_interlace_handling(reader.png);
    png_read_update_info(reader.png, reader.info);

    const Pixels pixels = allocate(columns, rows);
    const int bits = depth == 16 ? 16 : 8;
    const std::vector<float>& table = decode_table(encoding, bits);
    if (bits == 16)
        read_rows<std::uint16_t>(reader, passes, rows, table, pixels);
    else
        read_rows<std::uint8_t>(reader, passes, rows, table, pixels);
    png_read_end(reader.png, nullptr);
}

}  // namespace lfdsim::detail
