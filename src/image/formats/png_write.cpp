#include "image/formats/encoder.h"
#include "image/formats/first_failure.h"
#include "image/formats/formats.h"

#include <fmt/format.h>
#include <png.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>
#include <zlib.h>
#include <algorithm>
#include <vector>

namespace lfdsim::detail {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr int strip_rows = 64;  // strips are compressed separately; larger than deflate's 32 KiB window, so little is lost

[[noreturn]] void on_write_error(png_structp, png_const_charp message) {
    throw std::runtime_error(fmt::format("PNG: {}", message));
}

void no_warning(png_structp, png_const_charp) {}

void on_write(png_structp png, png_bytep data, std::size_t bytes) { static_cast<Output*>(png_get_io_ptr(png))->write(data, bytes); }

void on_flush(png_structp) {}

struct PngWriter {
    png_structp png;
    png_infop info;

    explicit PngWriter(Output& file)
        : png(png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, on_write_error, no_warning)),
          info(png ? png_create_info_struct(png) : nullptr) {
        if (!info) throw std::bad_alloc();
        png_set_write_fn(png, &file, on_write, on_flush);
    }
    ~PngWriter() { png_destroy_write_struct(&png, &info); }
    PngWriter(const PngWriter&) = delete;
    PngWriter& operator=(const PngWriter&) = delete;
};

/// Writes everything before the pixels: size, encoding and texts.
void write_header(const PngWriter& writer, const Image& image, const WriteOptions& options) {
    png_set_IHDR(writer.png, writer.info, png_uint_32(image.width), png_uint_32(image.height), options.bits, PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (options.encoding == Encoding::srgb)
        png_set_sRGB_gAMA_and_cHRM(writer.png, writer.info, PNG_sRGB_INTENT_RELATIVE);
    else
        png_set_gAMA(writer.png, writer.info, 1.0);
    for (const auto& [key, value] : options.metadata) {
        png_text text{};  // tEXt holds Latin-1 only; UTF-8 goes into iTXt
        const bool ascii = std::all_of(value.begin(), value.end(), [](char c) { return (c & 0x80) == 0; });
        text.compression = ascii ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE;
        text.key = const_cast<char*>(key.c_str());
        text.text = const_cast<char*>(value.c_str());
        (ascii ? text.text_length : text.itxt_length) = value.size();
        png_set_text(writer.png, writer.info, &text, 1);
    }
    png_write_info(writer.png, writer.info);
}

/// Encodes one row as code values in PNG's byte order: 16-bit ones big-endian. `codes` has the row's size.
void encode_row(const float* light, const WriteOptions& options, Bytes& codes) {
    if (options.bits == 8) {
        const Encoder8& encoder = Encoder8::of(options.encoding);
        for (std::size_t i = 0; i < codes.size(); ++i) codes[i] = encoder(light[i]);
        return;
    }
    for (std::size_t i = 0; i < codes.size() / 2; ++i) {
        const unsigned code = encode16(light[i], options.encoding);
        codes[2 * i] = std::uint8_t(code >> 8);
        codes[2 * i + 1] = std::uint8_t(code);
    }
}

struct DeflatedStrip {
    int begin;  // its first row
    bool last;
    Bytes deflated;
    uLong adler;  // of the uncompressed bytes
    std::size_t bytes;
};

/// Returns the codes of the rows from `begin` to end - 1 after the filter Up: of all filters, measured on elemental images and
/// views, the quickest and, with the quickest compression, as small as any.
Bytes filter_up(const Image& image, const WriteOptions& options, int begin, int end) {
    const std::size_t row_bytes = std::size_t(image.width) * 3 * std::size_t(options.bits / 8);
    Bytes above(row_bytes), row(row_bytes), filtered;
    filtered.reserve((row_bytes + 1) * std::size_t(end - begin));
    if (begin > 0) encode_row(image.at(0, begin - 1), options, above);
    for (int r = begin; r < end; ++r) {
        encode_row(image.at(0, r), options, row);
        filtered.push_back(PNG_FILTER_VALUE_UP);
        for (std::size_t i = 0; i < row_bytes; ++i) filtered.push_back(std::uint8_t(row[i] - above[i]));
        above.swap(row);
    }
    return filtered;
}

/// Returns a strip as a part of a deflate stream that ends at a byte, so that parts join by concatenation.
DeflatedStrip compress(const Bytes& filtered, int begin, bool last) {
    z_stream stream{};
    if (deflateInit2(&stream, Z_BEST_SPEED, Z_DEFLATED, -MAX_WBITS, MAX_MEM_LEVEL, Z_DEFAULT_STRATEGY) != Z_OK)
        throw std::bad_alloc();
    constexpr std::size_t flush_bytes = 16;  // an empty stored block, which deflateBound does not count
    DeflatedStrip strip{begin, last, Bytes(deflateBound(&stream, filtered.size()) + flush_bytes),
                        adler32_z(1, filtered.data(), filtered.size()), filtered.size()};
    stream.next_in = const_cast<Bytef*>(filtered.data());
    stream.avail_in = uInt(filtered.size());
    stream.next_out = strip.deflated.data();
    stream.avail_out = uInt(strip.deflated.size());
    deflate(&stream, last ? Z_FINISH : Z_SYNC_FLUSH);
    strip.deflated.resize(stream.total_out);
    strip.deflated.shrink_to_fit();
    deflateEnd(&stream);
    return strip;
}

}  // namespace

void write_png(Output& file, const Image& image, const WriteOptions& options, Job& job) {
    constexpr int most = PNG_USER_WIDTH_MAX;  // libpng's limit, which most readers share
    if (image.width > most || image.height > most)
        throw InputError(file.name(), fmt::format("{} x {} pixels; a PNG has at most {} columns and rows, use .exr or .npy",
                                                  image.width, image.height, most));
    const PngWriter writer(file);
    write_header(writer, image, options);

    // A pipeline: strips in order, compressed by all threads, and written in order. The check sum of all rows is combined from
    // those of the strips.
    static constexpr png_byte idat[] = "IDAT", iend[] = "IEND";
    int next = 0;
    uLong adler = 1;
    FirstFailure failure;
    const auto begin_strip = [&](tbb::flow_control& flow) {
        const int begin = next;
        if (begin >= image.height || failure.failed()) flow.stop();
        next += strip_rows;
        return begin;
    };
    const auto compress_strip = [&](int begin) {
        DeflatedStrip strip{};
        failure.guard([&] {
            const int end = std::min(begin + strip_rows, image.height);
            strip = compress(filter_up(image, options, begin, end), begin, end == image.height);
        });
        return strip;
    };
    const auto write_strip = [&](DeflatedStrip& strip) {
        adler = adler32_combine(adler, strip.adler, z_off_t(strip.bytes));
        if (strip.begin == 0) strip.deflated.insert(strip.deflated.begin(), {0x78, 0x01});  // zlib header: 32 KiB window
        if (strip.last)
            for (int shift = 24; shift >= 0; shift -= 8) strip.deflated.push_back(std::uint8_t(adler >> shift));
        png_write_chunk(writer.png, idat, strip.deflated.data(), strip.deflated.size());
        job.advance(std::min(strip_rows, image.height - strip.begin));
    };
    // Only twice as many strips as threads are in memory at a time, whatever the picture's size.
    tbb::parallel_pipeline(std::size_t(2 * tbb::this_task_arena::max_concurrency()),
                           tbb::make_filter<void, int>(tbb::filter_mode::serial_in_order, begin_strip) &
                               tbb::make_filter<int, DeflatedStrip>(tbb::filter_mode::parallel, compress_strip) &
                               tbb::make_filter<DeflatedStrip, void>(tbb::filter_mode::serial_in_order, [&](DeflatedStrip strip) {
                                   failure.guard([&] { write_strip(strip); });
                               }));
    failure.rethrow();
    png_write_chunk(writer.png, iend, nullptr, 0);
}

}  // namespace lfdsim::detail
