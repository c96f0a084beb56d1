#include "image/formats/apng.h"

#include "base/output_file.h"
#include "image/formats/encoding.h"
#include "image/formats/png_memory.h"

#include <tbb/parallel_for.h>
#include <zlib.h>
#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace lfdsim {
namespace {

constexpr std::size_t signature_bytes = 8, header_end = signature_bytes + 25;  // the signature; IHDR with its length and check sum

/// Appends the `count` lowest bytes of a value, the highest of them first, as PNG has numbers.
void put(std::string& bytes, std::uint32_t value, int count) {
    for (int k = count - 1; k >= 0; --k) bytes += char(value >> (8 * k) & 0xff);
}

std::uint32_t number_at(std::string_view png, std::size_t place) {
    std::uint32_t value = 0;
    for (std::size_t k = 0; k < 4; ++k) value = value << 8 | std::uint8_t(png[place + k]);
    return value;
}

/// Returns a chunk: the number of its data's bytes, its type, the data, and the check sum of type and data.
std::string chunk(std::string_view type, std::string_view data) {
    std::string body(type), bytes;
    body += data;
    put(bytes, std::uint32_t(data.size()), 4);
    bytes += body;
    put(bytes, std::uint32_t(crc32_z(0, reinterpret_cast<const Bytef*>(body.data()), body.size())), 4);
    return bytes;
}

/// The parts of a PNG of one frame: everything before its pixels, and its pixels, compressed.
struct Still {
    std::string head, pixels;
};

Still still(const Image& frame) {
    const std::string png = png_bytes(frame.width, frame.height, 3, encode8(frame, Encoding::srgb));
    Still parts;
    for (std::size_t at = signature_bytes; at + 12 <= png.size();) {
        const std::size_t length = number_at(png, at);
        const std::string_view type = std::string_view(png).substr(at + 4, 4), data = std::string_view(png).substr(at + 8, length);
        if (type == "IDAT")
            parts.pixels += data;
        else if (parts.pixels.empty())
            parts.head += png.substr(at, length + 12);
        at += length + 12;
    }
    parts.head = png.substr(0, signature_bytes) + parts.head;
    return parts;
}

/// Returns the chunk that precedes a frame's pixels, with its size and duration.
std::string frame_control(std::uint32_t sequence, const Image& frame, double seconds) {
    std::string data;
    put(data, sequence, 4);
    put(data, std::uint32_t(frame.width), 4);
    put(data, std::uint32_t(frame.height), 4);
    put(data, 0, 4);  // its position
    put(data, 0, 4);
    put(data, std::uint32_t(std::lround(seconds * 1000)), 2);
    put(data, 1000, 2);
    put(data, 0, 2);  // dispose_op none, blend_op source: each frame replaces the one before it
    return chunk("fcTL", data);
}

}  // namespace

void write_animation(const std::filesystem::path& path, std::span<const Image> frames, double seconds_per_frame) {
    if (frames.empty()) throw std::invalid_argument("an animation without frames");
    if (!(seconds_per_frame >= 0.001 && seconds_per_frame <= 65.5))
        throw std::invalid_argument("seconds of a frame: 0.001 .. 65.5");
    for (const Image& frame : frames)
        if (frame.width != frames[0].width || frame.height != frames[0].height)
            throw std::invalid_argument("frames of an animation differ in size");
    std::vector<Still> stills(frames.size());
    tbb::parallel_for(std::size_t(0), frames.size(), [&](std::size_t k) { stills[k] = still(frames[k]); });

    // The head of the first frame with acTL after IHDR, then frames: the first one as IDAT, which every program shows, the others
    // as fdAT. fcTL and fdAT are numbered in one sequence.
    std::string control;
    put(control, std::uint32_t(frames.size()), 4);
    put(control, 0, 4);  // without end
    std::string bytes = stills[0].head.substr(0, header_end) + chunk("acTL", control) + stills[0].head.substr(header_end);
    std::uint32_t sequence = 0;
    for (std::size_t k = 0; k < frames.size(); ++k) {
        bytes += frame_control(sequence++, frames[k], seconds_per_frame);
        if (k == 0) {
            bytes += chunk("IDAT", stills[k].pixels);
            continue;
        }
        std::string data;
        put(data, sequence++, 4);
        bytes += chunk("fdAT", data + stills[k].pixels);
    }
    bytes += chunk("IEND", "");
    write_file(path, bytes);
}

}  // namespace lfdsim
