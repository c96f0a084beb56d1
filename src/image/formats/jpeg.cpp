#include "image/formats/encoding.h"
#include "image/formats/formats.h"
#include "image/formats/upright.h"

#include <fmt/format.h>
#include <cstdlib>
#include <memory>
#include <vector>

#include <jpeglib.h>  // wants cstdio before it

namespace lfdsim::detail {
namespace {

constexpr int max_scans = 100;  // a progressive picture has about ten; thousands are an attack by slowness

/// The functions that libjpeg calls on errors and progress. They throw in place of longjmp: every x86-64 library contains the
/// tables that unwinding needs.
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

struct JpegReader {
    jpeg_decompress_struct jpeg{};
    Hooks hooks{};

    explicit JpegReader(const InputFile& file) {
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
    ~JpegReader() { jpeg_destroy_decompress(&jpeg); }
    JpegReader(const JpegReader&) = delete;
    JpegReader& operator=(const JpegReader&) = delete;
};

}  // namespace

StatedColours read_jpeg_colours(const InputFile& file) {
    JpegReader reader(file);
    jpeg_save_markers(&reader.jpeg, JPEG_APP0 + 2, 0xffff);  // ICC profiles come in parts of at most 64 KiB
    jpeg_read_header(&reader.jpeg, TRUE);
    JOCTET* bytes = nullptr;
    unsigned size = 0;
    if (!jpeg_read_icc_profile(&reader.jpeg, &bytes, &size)) return {};
    const std::unique_ptr<JOCTET, decltype(&std::free)> owner(bytes, &std::free);
    return colours_of_profile({bytes, size});
}

void read_jpeg(const InputFile& file, Encoding encoding, const Allocate& allocate) {
    const int orientation = read_orientation(file.stream());  // before libjpeg begins to read
    JpegReader reader(file);
    jpeg_decompress_struct& jpeg = reader.jpeg;
    jpeg_read_header(&jpeg, TRUE);
    // At best one bit codes a block of 8 x 8 samples, each of which covers 4 x 4 pixels.
    file.check_size(jpeg.image_width, jpeg.image_height, 8 * 64 * 16);
    if (jpeg.num_components != 1 && jpeg.num_components != 3)
        file.refuse(fmt::format("has {} colour components; gray or RGB is needed", jpeg.num_components));
    jpeg.out_color_space = JCS_RGB;
    // allocate() checks the memory before libjpeg takes some: a progressive picture takes memory for all its coefficients.
    const Upright upright(orientation, jpeg.image_width, jpeg.image_height);
    const Pixels pixels = allocate(upright.columns, upright.rows);
    jpeg_start_decompress(&jpeg);

    const std::vector<float>& table = decode_table(encoding, 8);
    std::vector<JSAMPLE> codes(std::size_t(jpeg.image_width) * 3);
    while (jpeg.output_scanline < jpeg.output_height) {
        const std::int64_t r = jpeg.output_scanline;
        JSAMPROW row = codes.data();
        jpeg_read_scanlines(&jpeg, &row, 1);
        decode_row(codes.data(), table, jpeg.image_width, upright.pixel_step * pixels.stride, pixels.at(upright.row(r)));
        pixels.job->advance(upright.progress(r + 1) - upright.progress(r));
    }
    jpeg_finish_decompress(&jpeg);
}

}  // namespace lfdsim::detail
