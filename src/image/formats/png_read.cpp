#include "base/printable.h"
#include "image/formats/encoding.h"
#include "image/formats/first_failure.h"
#include "image/formats/formats.h"
#include "image/formats/upright.h"

#include <fmt/format.h>
#include <png.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
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

void check_signature(const InputFile& file) {
    std::array<png_byte, 8> signature{};
    if (std::fread(signature.data(), 1, 8, file.stream()) != 8 || png_sig_cmp(signature.data(), 0, 8) != 0)
        file.refuse("is not a PNG file, whatever its name says");
}

/// Refuses chunks that claim more bytes than the file has: libpng allocates what a chunk claims before it reads it.
void check_chunks(const InputFile& file) {
    constexpr std::int64_t first = 8, sum_bytes = 4;  // the signature; after each chunk
    for (std::int64_t at = first; at < file.size();) {
        std::array<png_byte, 8> head{};
        if (fseeko(file.stream(), at, SEEK_SET) != 0 || std::fread(head.data(), 1, head.size(), file.stream()) != head.size())
            break;
        const std::string_view name(reinterpret_cast<const char*>(&head[4]), 4);
        const std::int64_t bytes = png_get_uint_32(head.data());
        at += std::int64_t(head.size()) + bytes + sum_bytes;
        if (name == "IEND") break;
        if (at > file.size())
            file.refuse(fmt::format("is damaged: it ends too early, its chunk \"{}\" claims {} bytes", printable(name), bytes));
    }
    fseeko(file.stream(), first, SEEK_SET);
}

struct PngReader {
    png_structp png;
    png_infop info;

    explicit PngReader(const InputFile& file)
        : png(png_create_read_struct(PNG_LIBPNG_VER_STRING, const_cast<InputFile*>(&file), on_error, on_warning)),
          info(png ? png_create_info_struct(png) : nullptr) {
        if (!info) throw std::bad_alloc();
        png_set_read_fn(png, file.stream(), on_read);
        png_set_sig_bytes(png, 8);                                   // check_signature() has read them
        png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);  // check_size() is stricter
    }
    ~PngReader() { png_destroy_read_struct(&png, &info, nullptr); }
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;
};

/// The codes of the rows from `first` to first + rows - 1; `Code` is the type of a sample.
template <class Code>
struct Band {
    std::int64_t first, rows;
    std::vector<Code> codes;
};

/// Reads all rows in bands. One thread inflates; others convert codes to light, which takes as long again, mostly for the first
/// touch of the memory. Returns the index, row by row, of the first stored pixel whose alpha is not full, or -1.
template <class Code>
std::int64_t read_rows(const PngReader& reader, int passes, const Upright& upright, const std::vector<float>& table,
                       const Pixels& pixels) {
    constexpr std::int64_t band_codes = 1 << 18;  // codes of a band, which fit into the cache of one core
    constexpr std::int64_t none = std::numeric_limits<std::int64_t>::max();
    const int channels = png_get_channels(reader.png, reader.info);  // 3, or 4 with alpha
    const std::int64_t columns = upright.stored_columns, rows = upright.stored_rows, row_codes = columns * channels;
    std::atomic<std::int64_t> clear{none};  // the least index so far of a pixel whose alpha is not full
    const auto check_alpha = [&](const Code* codes, std::int64_t row) {
        for (std::int64_t i = 0; i < columns; ++i)
            if (codes[i * channels + 3] != std::numeric_limits<Code>::max()) {
                std::int64_t first = clear;
                while (row * columns + i < first && !clear.compare_exchange_weak(first, row * columns + i)) {
                }
                return;
            }
    };
    // Interlaced pictures are read in passes, each of which touches every row: all codes must be kept until the last pass.
    const std::int64_t most_rows = passes > 1 ? rows : std::max<std::int64_t>(1, band_codes / row_codes);
    std::int64_t next = 0;
    FirstFailure failure;
    const auto inflate = [&](tbb::flow_control& flow) {
        Band<Code> band{next, std::min(most_rows, rows - next), {}};
        failure.guard([&] {
            band.codes.resize(std::size_t(band.rows * row_codes));
            for (int pass = 0; pass < passes; ++pass)
                for (std::int64_t r = 0; r < band.rows; ++r)
                    png_read_row(reader.png, reinterpret_cast<png_bytep>(&band.codes[std::size_t(r * row_codes)]), nullptr);
        });
        if (band.rows == 0 || failure.failed()) flow.stop();
        next += band.rows;
        return band;
    };
    const auto decode = [&](const Band<Code>& band) {
        for (std::int64_t r = 0; r < band.rows; ++r) {
            const Code* const codes = &band.codes[std::size_t(r * row_codes)];
            if (channels == 4) check_alpha(codes, band.first + r);
            decode_row(codes, table, columns, upright.pixel_step * pixels.stride, pixels.at(upright.row(band.first + r)), channels);
        }
        pixels.job->advance(upright.progress(band.first + band.rows) - upright.progress(band.first));
    };
    tbb::parallel_pipeline(std::size_t(2 * tbb::this_task_arena::max_concurrency()),
                           tbb::make_filter<void, Band<Code>>(tbb::filter_mode::serial_in_order, inflate) &
                               tbb::make_filter<Band<Code>, void>(tbb::filter_mode::parallel, decode));
    failure.rethrow();
    return clear == none ? -1 : std::int64_t(clear);
}

}  // namespace

Metadata read_png_metadata(const InputFile& file) {
    check_signature(file);
    check_chunks(file);
    const PngReader reader(file);
    // Texts are unpacked into memory: 64 of 4 MiB each are more than any picture of this program has.
    png_set_chunk_cache_max(reader.png, 64);
    png_set_chunk_malloc_max(reader.png, std::size_t(1) << 22);
    png_read_info(reader.png, reader.info);
    png_textp texts = nullptr;
    const int count = png_get_text(reader.png, reader.info, &texts, nullptr);
    Metadata metadata;
    for (int i = 0; i < count; ++i) metadata[texts[i].key] = texts[i].text;
    return metadata;
}

StatedColours read_png_colours(const InputFile& file) {
    check_signature(file);
    check_chunks(file);
    const PngReader reader(file);
    // Texts are not used. Older versions of libpng do not know cICP; of such chunks one is kept (3 means one).
    png_set_chunk_cache_max(reader.png, 3);
    png_set_keep_unknown_chunks(reader.png, PNG_HANDLE_CHUNK_NEVER, reinterpret_cast<png_const_bytep>("tEXt\0zTXt\0iTXt"), 3);
    png_set_keep_unknown_chunks(reader.png, PNG_HANDLE_CHUNK_ALWAYS, reinterpret_cast<png_const_bytep>("cICP"), 1);
    png_read_info(reader.png, reader.info);
    // The first of these counts (PNG, third edition, 4.3): cICP, iCCP, sRGB, gAMA with cHRM.
    png_unknown_chunkp chunks = nullptr;
    if (png_get_unknown_chunks(reader.png, reader.info, &chunks) > 0 && chunks[0].size >= 2) {
        const int primaries = chunks[0].data[0], curve = chunks[0].data[1];  // ITU-T H.273: 1 and 13 are those of sRGB
        return {fmt::format("cICP {}, {}", primaries, curve), primaries == 1,
                curve == 13 ? srgb_mid_gray : std::numeric_limits<double>::quiet_NaN()};
    }
    png_charp name = nullptr;
    png_bytep profile = nullptr;
    png_uint_32 bytes = 0;
    int compression = 0, intent = 0;
    if (png_get_iCCP(reader.png, reader.info, &name, &compression, &profile, &bytes) != 0)
        return colours_of_profile({profile, bytes});
    StatedColours stated;
    if (png_get_sRGB(reader.png, reader.info, &intent) != 0) return stated;
    if (double gamma = 0; png_get_gAMA(reader.png, reader.info, &gamma) != 0) {
        stated.name = fmt::format("gAMA {:g}", gamma);
        stated.mid_gray = std::pow(0.5, 1 / gamma);
    }
    std::array<double, 8> xy{};
    if (png_get_cHRM(reader.png, reader.info, &xy[6], &xy[7], &xy[0], &xy[1], &xy[2], &xy[3], &xy[4], &xy[5]) != 0) {
        stated.name += stated.name.empty() ? "cHRM" : " and cHRM";
        stated.srgb_primaries = are_srgb_primaries(xy);
    }
    return stated;
}

void read_png(const InputFile& file, Encoding encoding, const Allocate& allocate) {
    const int orientation = read_orientation(file.stream());
    check_signature(file);
    check_chunks(file);
    const PngReader reader(file);
    png_set_chunk_cache_max(reader.png, 1);  // texts are not used: 1 collects none
    png_read_info(reader.png, reader.info);

    // The size is checked before anything is allocated.
    const std::int64_t columns = png_get_image_width(reader.png, reader.info);
    const std::int64_t rows = png_get_image_height(reader.png, reader.info);
    const int depth = png_get_bit_depth(reader.png, reader.info);
    const int bits_per_pixel = depth * png_get_channels(reader.png, reader.info);
    file.check_size(columns, rows, 1032.0 * 8 / bits_per_pixel);  // deflate packs 1032 bytes into one at best

    png_set_expand(reader.png);  // palettes to RGB, gray of 1, 2, 4 bits to 8, a transparent colour to alpha
    png_set_gray_to_rgb(reader.png);
    if (depth == 16) png_set_swap(reader.png);  // big-endian in the file
    const int passes = png_set_interlace_handling(reader.png);
    png_read_update_info(reader.png, reader.info);

    const Upright upright(orientation, columns, rows);
    const Pixels pixels = allocate(upright.columns, upright.rows);
    const int bits = depth == 16 ? 16 : 8;
    const std::vector<float>& table = decode_table(encoding, bits);
    const std::int64_t clear = bits == 16 ? read_rows<std::uint16_t>(reader, passes, upright, table, pixels)
                                          : read_rows<std::uint8_t>(reader, passes, upright, table, pixels);
    if (clear >= 0) {
        const std::int64_t shown = upright.row(clear / columns) + clear % columns * upright.pixel_step;
        refuse_transparency(file, shown % upright.columns, shown / upright.columns);
    }
    png_read_end(reader.png, nullptr);
}

}  // namespace lfdsim::detail
