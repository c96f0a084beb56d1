// The likeness of an eye's view to a photograph of the scene from the same point. Floor 5.
#pragma once
#include "base/job.h"
#include "content/content.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lfdsim::view {

/// The white field by which views are divided: the mean light of the screen on the axis, of a white panel. It is kept until its
/// inputs change.
class WhiteField {
  public:
    /// Returns the white field, more than 0. `quick`: from few pixels, accurate to about 1 %. Throws Stopped; InputError where the
    /// camera sees no light.
    double of(const Display&, const Geometry&, bool quick, int threads, const std::string& device, const Job&);

  private:
    std::optional<Display> of_;
    double light_ = 0;
};

struct Compared {
    Image photograph;
    double ssim;  // over the content's rectangle, as `lfdsim analyze` measures it; NaN where too little of it is visible
};

/// Divides `view`, the camera's whole picture, by `white` and compares it with the reference photograph. Throws Stopped.
Compared compared(Image& view, double white, const Display&, const Geometry&, const ContentScene&, int threads, const Job&);

/// Returns view minus photograph in sRGB codes, whose differences are about as large as they look: 128, middle grey, where both are
/// equal, more where the view is lighter, limited to 0 and 255. With its sign, blur can be distinguished from ghosts and from a
/// wrong brightness.
std::vector<std::uint8_t> difference_codes(const Image& view, const Image& photograph);

}  // namespace lfdsim::view
