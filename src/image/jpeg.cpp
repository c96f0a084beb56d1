#include "image/encoding.h"
#include "image/formats.h"

#include <fmt/format.h>
#include <vector>

#include <jpeglib.h>  // wants cstdio before it

namespace lfdsim::detail {
namespace {

constexpr int max_scans = 100;  // a progressive picture has about ten; thousands are an attack on the reader's time

/// libjpeg's hooks. They throw in place of longjmp: every x86-64 library carries the tables that unwinding needs.
struct Hooks {
    jpeg_error_mgr error;
    jpeg_progress_mgr progress;
    const InputFile* file;
};

const InputFile& file_of(j_common_ptr common) { return *static_cast<Hooks*>(common->client_data)->file; }

[[noreturn]] void on_error(j_common_ptr common) {
    char text[JMSG_LENGTH_MAX];
    common->err->format_message(common, text);
    file_of(common).refuse(fmt::format("is damaged or not a JPEG file: {}", text));
}

// Warnings (level -1) mean lost data: libjpeg would fill the rest with gray.
void on_message(j_common_ptr common, int level) {
    if (level < 0) on_error(common);
}

void on_progress(j_common_ptr common) {
    if (reinterpret_cast<j_decompress_ptr>(common)->input_scan_number > max_scans)
        file_of(common).refuse(fmt::format("has more than {} scans; save it again as a baseline JPEG", max_scans));
}

struct Reader {
    jpeg_decompress_struct jpeg{};
    Hooks hooks{};

    explicit Reader(const InputFile& file) {
        jpeg.err = jpeg_std_error(&hooks.error);
        hooks.error.error_exit = on_error;
        hooks.error.emit_message = on_message;
        hooks.progress.progress_monitor = on_progress;
        hooks.file = &file;
        jpeg.client_data = &hooks;
        jpeg_create_decompress(&jpeg);
        jpeg.progress = &hooks.progress;
        jpeg_stdio_src(&jpeg, file.stream());
    }
    ~Reader() { jpeg_destroy_decompress(&jpeg); }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;
};

}  // namespace

void read_jpeg(const InputFile& file, Encoding encoding, const Allocate& allocate) {
    Reader reader(file);
    jpeg_decompress_struct& jpeg = reader.jpeg;
    jpeg_read_header(&jpeg, TRUE);
    // At best one bit tells a block of 8 x 8 samples, each of which covers 4 x 4 pixels.
    file.check_size(jpeg.image_width, jpeg.image_height, 8 * 64 * 16);
    if (jpeg.num_components != 1 && jpeg.num_components != 3)
        file.refuse(fmt::format("has {} colour components; gray or RGB is needed", jpeg.num_components));
    jpeg.out_color_space = JCS_RGB;
    // Before libjpeg allocates: a progressive picture takes memory for all its coefficients.
    const Pixels pixels = allocate(jpeg.image_width, jpeg.image_height);
    jpeg_start_decompress(&jpeg);

    const std::vector<float>& table = decode_table(encoding, 8);
    std::vector<JSAMPLE> codes(std::size_t(pixels.columns) * 3);
    while (jpeg.output_scanline < jpeg.output_height) {
        const std::int64_t r = jpeg.output_scanline;
        JSAMPROW row = codes.data();
        jpeg_read_scanlines(&jpeg, &row, 1);
        decode_row(codes.data(), table, pixels.columns, pixels.stride, pixels.row(r));
        pixels.job->advance(1);
    }
    jpeg_finish_decompress(&jpeg);
}

}  // namespace lfdsim::detail
