// A picture as it is sent to the page. Floor 5. docs/view-protocol.md has its form.
#pragma once
#include "image/image.h"
#include "model/job.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lfdsim::view {

enum class Quality { coarse, fine, final };

struct FrameHeader {
    std::int64_t id = 0;
    std::string lane;
    Quality quality = Quality::coarse;
    int width = 0, height = 0;
    std::int64_t samples = 0;  // of a pixel
    double render_ms = 0;
    std::optional<double> ssim = {};  // NaN is told as none
};

/// JPEG, of quality 80 for coarse and 90 for fine, or PNG for final. Throws what the job's advance() throws.
std::string picture_frame(const FrameHeader&, const Image& light, Job&);
/// The same of sRGB codes, three a pixel.
std::string codes_frame(const FrameHeader&, const std::vector<std::uint8_t>& codes, Job&);
/// OpenEXR, with a second picture as the layer "right" where there is one.
std::string exr_frame(const FrameHeader&, const Image& light, const Image* right, Job&);

}  // namespace lfdsim::view
