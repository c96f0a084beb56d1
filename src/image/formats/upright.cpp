#include "image/formats/upright.h"

#include <algorithm>
#include <span>
#include <string_view>
#include <vector>

namespace lfdsim {
namespace {

using Bytes = std::vector<unsigned char>;
constexpr std::size_t most_bytes = 0xffff;  // of Exif data: a JPEG's marker has no more

/// Returns the next bytes of a file, fewer than `count` where it ends.
Bytes next(std::FILE* file, std::size_t count) {
    Bytes bytes(count);
    bytes.resize(std::fread(bytes.data(), 1, count, file));
    return bytes;
}

std::size_t number(std::span<const unsigned char> bytes, std::size_t at, std::size_t size, bool little = false) {
    std::size_t value = 0;
    for (std::size_t k = 0; k < size; ++k) value = value << 8 | bytes[little ? at + size - 1 - k : at + k];
    return value;
}

bool begins(const Bytes& bytes, std::string_view text) {
    return bytes.size() >= text.size() && std::equal(text.begin(), text.end(), bytes.begin(),
                                                     [](char a, unsigned char b) { return static_cast<unsigned char>(a) == b; });
}

/// Returns tag 0x0112 of Exif data (CIPA DC-008: the first directory of a TIFF file); 0 if there is none that can be.
int orientation_in(std::span<const unsigned char> tiff) {
    if (tiff.size() < 8) return 0;
    const bool little = tiff[0] == 'I';  // "II" or "MM": the order of a number's bytes
    const std::size_t directory = number(tiff, 4, 4, little);
    if (directory > tiff.size() - 2) return 0;
    for (std::size_t k = 0; k < number(tiff, directory, 2, little); ++k) {
        const std::size_t entry = directory + 2 + 12 * k;
        if (entry + 12 > tiff.size()) return 0;
        if (number(tiff, entry, 2, little) != 0x0112) continue;
        const std::size_t value = number(tiff, entry + 8, 2, little);
        return value <= 8 ? int(value) : 0;
    }
    return 0;
}

// JPEG: markers of two bytes, with a length and data, up to the first scan. Exif data are in APP1.
int of_jpeg(std::FILE* file) {
    constexpr std::string_view exif("Exif\0\0", 6);
    constexpr int fill = 0xff, scan = 0xda, end = 0xd9, app1 = 0xe1;
    std::fseek(file, 2, SEEK_SET);
    while (std::getc(file) == fill) {
        int marker = fill;
        while (marker == fill) marker = std::getc(file);
        if (marker == scan || marker == end) return 0;
        const Bytes length = next(file, 2);
        if (length.size() < 2 || number(length, 0, 2) < 2) return 0;
        const Bytes data = next(file, number(length, 0, 2) - 2);
        if (marker != app1 || !begins(data, exif)) continue;
        if (const int orientation = orientation_in(std::span(data).subspan(exif.size()))) return orientation;
    }
    return 0;
}

// PNG: chunks of a length, a name, data and a check sum. Exif data are in eXIf.
int of_png(std::FILE* file) {
    std::fseek(file, 8, SEEK_SET);
    for (Bytes head = next(file, 8); head.size() == 8; head = next(file, 8)) {
        const std::size_t bytes = number(head, 0, 4);
        if (std::string_view(reinterpret_cast<const char*>(&head[4]), 4) == "eXIf")
            return orientation_in(next(file, std::min(bytes, most_bytes)));
        if (fseeko(file, off_t(bytes + 4), SEEK_CUR) != 0) return 0;
    }
    return 0;
}

}  // namespace

int read_orientation(std::FILE* file) {
    std::rewind(file);
    const Bytes start = next(file, 8);
    const int found = begins(start, "\xff\xd8") ? of_jpeg(file) : begins(start, "\x89PNG\r\n\x1a\n") ? of_png(file) : 0;
    std::rewind(file);
    return std::max(found, 1);
}

Upright::Upright(int orientation, std::int64_t width, std::int64_t height)
    : columns(width), rows(height), stored_columns(width), stored_rows(height) {
    // The stored picture is mirrored, then exchanges x and y.
    const bool from_right = orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8,
               from_below = orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7,
               exchanges = orientation >= 5;
    if (exchanges) std::swap(columns, rows);
    const std::int64_t along = exchanges ? columns : 1, across = exchanges ? 1 : columns;
    first = (from_right ? (stored_columns - 1) * along : 0) + (from_below ? (stored_rows - 1) * across : 0);
    pixel_step = from_right ? -along : along;
    row_step = from_below ? -across : across;
}

}  // namespace lfdsim
