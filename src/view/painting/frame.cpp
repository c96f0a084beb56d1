#include "view/painting/frame.h"

#include "image/formats/encoding.h"
#include "image/formats/image_file.h"
#include "image/formats/jpeg_memory.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <cmath>

namespace lfdsim::view {
namespace {

using Clock = std::chrono::steady_clock;

// Returns milliseconds to a hundredth, so that headers stay short.
double ms_since(Clock::time_point start) {
    return std::round(std::chrono::duration<double, std::milli>(Clock::now() - start).count() * 100) / 100;
}

// Returns the frame: four bytes with the header's length, the header in JSON, the picture's file.
std::string assembled(const FrameHeader& h, const char* format, Clock::time_point start, const std::string& picture) {
    static constexpr const char* quality[] = {"coarse", "fine", "final"};
    nlohmann::ordered_json json{{"id", h.id},
                                {"lane", h.lane},
                                {"quality", quality[int(h.quality)]},
                                {"format", format},
                                {"width", h.width},
                                {"height", h.height},
                                {"samples", h.samples},
                                {"render_ms", std::round(h.render_ms * 100) / 100},
                                {"encode_ms", ms_since(start)},
                                {"ssim", nullptr}};
    if (h.ssim && std::isfinite(*h.ssim)) json["ssim"] = *h.ssim;
    const std::string header = json.dump();
    std::string bytes;
    bytes.reserve(4 + header.size() + picture.size());
    for (int shift = 0; shift < 32; shift += 8) bytes.push_back(char(header.size() >> shift & 0xff));
    return bytes.append(header).append(picture);
}

std::string jpeg(const FrameHeader& h, const std::vector<std::uint8_t>& codes) {
    return jpeg_bytes(h.width, h.height, codes, h.quality == Quality::coarse ? 80 : 90);
}

}  // namespace

std::string picture_frame(const FrameHeader& h, const Image& light, Job& job) {
    const auto start = Clock::now();
    if (h.quality == Quality::final) return assembled(h, "png", start, image_bytes(".png", light, {}, &job));
    return assembled(h, "jpeg", start, jpeg(h, encode8(light, Encoding::srgb)));
}

std::string codes_frame(const FrameHeader& h, const std::vector<std::uint8_t>& codes, Job& job) {
    const auto start = Clock::now();
    if (h.quality != Quality::final) return assembled(h, "jpeg", start, jpeg(h, codes));
    const std::vector<float>& light = decode_table(Encoding::srgb, 8);
    Image image(h.width, h.height);
    for (std::size_t i = 0; i < codes.size(); ++i) image.rgb[i] = light[codes[i]];
    return assembled(h, "png", start, image_bytes(".png", image, {}, &job));
}

std::string exr_frame(const FrameHeader& h, const Image& light, const Image* right, Job& job) {
    const auto start = Clock::now();
    WriteOptions options;
    if (right) options.layers.push_back({"right", *right});
    return assembled(h, "exr", start, image_bytes(".exr", light, options, &job));
}

}  // namespace lfdsim::view
