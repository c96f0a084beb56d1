// How like the view of an eye is to the photograph of the scene from there. Floor 5.
#pragma once
#include "content/content.h"
#include "model/job.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace lfdsim::view {

/// Light that a white panel gives the camera, as analysis divides views by it; kept until what it depends on changes.
class WhiteField {
  public:
    /// More than 0. Quick: from few pixels, good to about a hundredth. Throws Stopped; InputError where the camera sees no light.
    double of(const Display&, const Geometry&, bool quick, int threads, const Job&);

  private:
    std::optional<Display> of_;
    double light_ = 0;
};

struct Compared {
    Image photograph;
    double ssim;  // over the screen, as `lfdsim analyze` measures it; NaN where too little of it is seen
};

/// `view` is the camera's whole picture; it is divided by `white`. Throws Stopped.
Compared compared(Image& view, double white, const Display&, const Geometry&, const ContentScene&, int threads, const Job&);

/// View less photograph in sRGB codes, which are about as far apart as they look: middle grey where both are equal, lighter where
/// the view is, ends at 127 codes either way. A sign tells blur from ghosts and a wrong brightness, an amount alone does not.
std::vector<std::uint8_t> difference_codes(const Image& view, const Image& photograph);

}  // namespace lfdsim::view
