// The likeness of an eye's view to a photograph of the scene from the same point. Floor 5.
#pragma once
#include "base/job.h"
#include "content/content.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lfdsim::view {

/// The light that the camera receives from a white panel, by which analysis divides views; kept until its inputs change.
class WhiteField {
  public:
    /// More than 0. Quick: from few pixels, accurate to about 1 %. Throws Stopped; InputError where the camera sees no light.
    double of(const Display&, const Geometry&, bool quick, int threads, const std::string& device, const Job&);

  private:
    std::optional<Display> of_;
    double light_ = 0;
};

struct Compared {
    Image photograph;
    double ssim;  // of the content, as `lfdsim analyze` measures it; NaN where too little of it is seen
};

/// `view` is the camera's whole picture; it is divided by `white`. Throws Stopped.
Compared compared(Image& view, double white, const Display&, const Geometry&, const ContentScene&, int threads, const Job&);

/// View minus photograph in sRGB codes, whose differences are about as large as they look: middle grey where both are equal,
/// lighter where the view is lighter, limited to 127 codes either way. With its sign, blur can be distinguished from ghosts and
/// from a wrong brightness.
std::vector<std::uint8_t> difference_codes(const Image& view, const Image& photograph);

}  // namespace lfdsim::view
