// A picture in the form in which it is sent to the page: docs/view-protocol.md. Floor 5.
#pragma once
#include "base/job.h"
#include "image/image.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lfdsim::view {

/// The quality of a picture, in the order in which a state's pictures are sent.
enum class Quality { coarse, fine, final };

/// The header of a frame, as far as it does not follow from the picture.
struct FrameHeader {
    std::int64_t id = 0;
    std::string lane;
    Quality quality = Quality::coarse;
    int width = 0, height = 0;
    std::int64_t samples = 0;  // per pixel
    double render_ms = 0;
    std::optional<double> ssim = {};  // NaN is sent as null
};

/// Returns a frame with a JPEG, of quality 80 for coarse and 90 for fine, or a PNG for final. Throws what the job's advance()
/// throws.
std::string picture_frame(const FrameHeader&, const Image& light, Job&);
/// Returns a frame like picture_frame() from sRGB codes, three a pixel.
std::string codes_frame(const FrameHeader&, const std::vector<std::uint8_t>& codes, Job&);
/// Returns a frame with an OpenEXR file, with a second picture as the layer "right" where there is one.
std::string exr_frame(const FrameHeader&, const Image& light, const Image* right, Job&);

}  // namespace lfdsim::view
