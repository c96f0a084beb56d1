// The tracer as a matrix: which panel pixels the rays of a camera's pixels end on. Floor 2.
#pragma once
#include "engine/devices/kernel.h"
#include "engine/render.h"
#include "engine/scene/traced_display.h"

#include <string>
#include <vector>

namespace lfdsim {

/// The rays of a display's camera by the estimator `point`: a pixel's light is the mean over its rays of share times the light of
/// the panel pixel that they end on. May be used by several threads.
class PanelRays {
  public:
    /// `kernel` is that of RenderOptions; the rays do not depend on it. Throws InputError.
    PanelRays(const Display&, const Geometry&, const std::string& kernel = {});

    /// Returns the number of rays of each pixel.
    int samples() const { return int(samples_); }
    /// Sets `rays` to the rays of the pixels of `part` of the camera's frame, row by row, for each pixel samples() rays.
    void trace(const Rect& part, std::vector<PanelRay>& rays) const;

  private:
    StoredDisplay<float> scene_;
    optics::RayOrigin view_;
    Kernel kernel_;
    std::uint32_t samples_;
    Sampling sampling_;
    int dimensions_;
};

}  // namespace lfdsim
