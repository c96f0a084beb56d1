// The functions of each file format that image_file.cpp calls. A new format adds its reader or writer here, and its rows in
// image_file.cpp. Internal to src/image. Floor 0.
#pragma once
#include "base/job.h"
#include "display/display.h"
#include "image/formats/file.h"
#include "image/formats/image_file.h"
#include "image/image.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace lfdsim::detail {

/// The memory in which a reader stores linear light: rows of `columns` pixels of `stride` floats each, the first three R, G, B. It
/// is zero at first. Each finished row is reported to `job`.
struct Pixels {
    float* data;
    std::int64_t columns;
    int stride;  // 3 in an Image, 4 in Texels
    Job* job;

    float* row(std::int64_t r) const { return at(r * columns); }
    float* at(std::int64_t index) const { return data + index * stride; }
};

/// The function by which a reader gets its memory: called once, when the size is known and InputFile::check_size() has passed it.
using Allocate = std::function<Pixels(std::int64_t columns, std::int64_t rows)>;

// All readers throw InputError, which names the file and the fault. EXR, NPY and PFM may store values that are not finite.
void read_png(const InputFile&, Encoding, const Allocate&);
void read_jpeg(const InputFile&, Encoding, const Allocate&);
void read_exr(const InputFile&, const Allocate&);
/// Reads a layer; nothing is allocated if the file has none of this name.
void read_exr_layer(const InputFile&, const std::string& layer, const Allocate&);
/// Reads an array of shape (rows, columns, 3): floats are light, whole numbers of one or two bytes are codes.
void read_npy(const InputFile&, Encoding, const Allocate&);
/// Whether an array has whole numbers. Only the header is read.
bool npy_holds_codes(const InputFile&);
void read_pfm(const InputFile&, const Allocate&);

/// The light, relative to white, of a code value that is half the greatest, by the curve of sRGB.
constexpr double srgb_mid_gray = 0.2140;

/// What a file states of its colours; those of sRGB where it states nothing.
struct StatedColours {
    std::string name;  // "the ICC profile "Display P3""
    bool srgb_primaries = true;
    double mid_gray = srgb_mid_gray;  // light of half the greatest code value; NaN if unknown
};

StatedColours colours_of_profile(std::span<const std::uint8_t> icc_bytes);
/// Whether x and y of red, green, blue and white are those of sRGB to 0.01.
bool are_srgb_primaries(const std::array<double, 8>& xy);
/// Returns how the stated colours differ from sRGB and how they are read, or nothing. The curve does not count where codes are read
/// as linear light.
std::string not_srgb(const StatedColours&, Encoding);

// These read the header alone, and throw like the readers.
StatedColours read_png_colours(const InputFile&);
StatedColours read_jpeg_colours(const InputFile&);
StatedColours read_exr_colours(const InputFile&);
Metadata read_png_metadata(const InputFile&);
Metadata read_exr_metadata(const InputFile&);

// All writers throw std::runtime_error when writing fails, and report each finished row to the job.
void write_png(Output&, const Image&, const WriteOptions&, Job&);
void write_exr(Output&, const Image&, const WriteOptions&, Job&);
void write_npy(Output&, const Image&, Job&);

/// Decodes the codes of one row, `channels` a pixel of which the first three are R, G, B, to light, a pixel every `stride` floats.
template <class Code>
void decode_row(const Code* codes, const std::vector<float>& table, std::int64_t columns, std::int64_t stride, float* light,
                int channels = 3) {
    for (std::int64_t i = 0; i < columns; ++i)
        for (int c = 0; c < 3; ++c) light[i * stride + c] = table[codes[i * channels + c]];
}

/// Refuses a picture whose alpha is not full at a pixel.
[[noreturn]] inline void refuse_transparency(const InputFile& file, std::int64_t column, std::int64_t row) {
    file.refuse(
        fmt::format("has transparency (an alpha channel that is not full at column {}, row {}), which a panel cannot show; remove "
                    "it, for instance with 'convert IN.png -background black -alpha remove -alpha off OUT.png'",
                    column, row));
}

}  // namespace lfdsim::detail
