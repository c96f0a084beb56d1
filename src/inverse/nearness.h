// How near what an eye sees comes to what it should see. Floor 3, public as a part of inverse.h.
#pragma once
#include <limits>

namespace lfdsim {

/// PSNR of sRGB codes, dB, and SSIM of luma; NaN where they cannot be computed.
struct Nearness {
    double psnr_db = std::numeric_limits<double>::quiet_NaN(), ssim = psnr_db;
};

}  // namespace lfdsim
