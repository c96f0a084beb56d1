// How near what an eye sees comes to what it should see. Floor 3, public as a part of inverse.h.
#pragma once

namespace lfdsim {

/// PSNR of sRGB codes, dB, and SSIM of luma; NaN where they cannot be computed.
struct Nearness {
    double psnr_db = 0, ssim = 0;
};

}  // namespace lfdsim
