// Lays a photograph of a screen over a simulated view of it: docs/model.md, "Overlay". Floor 0.
#pragma once
#include "image/homography.h"
#include "image/image.h"
#include "image/ssim.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace lfdsim {

/// The photograph on the view's grid, each pixel the mean light over its area; black outside `screen`.
struct Aligned {
    Image light;
    Region screen;                        // pixels that show the screen in both pictures
    std::vector<std::uint8_t> saturated;  // for each pixel: 1 where the camera may have been saturated
};

/// `saturation`: linear light from which a photograph's value means "this or more"; infinite where values have no upper limit. Both
/// corners must pass check_corners(). `part` restricts the screen to some pixels of the view.
Aligned align(const Image& photograph, const Corners& in_photograph, int view_width, int view_height, const Corners& in_view,
              double saturation, std::optional<Rect> part = {});

/// Light of the photograph divided by light of the simulation: R, G, B. A channel that is black in the simulation gets the mean of
/// the others. The photograph's channels must exceed `black` somewhere. Throws InputError if there is nothing to fit: no common
/// pixels, or the screen black in either picture or saturated all over.
std::array<double, 3> fit_gains(const Image& simulated, const Aligned& photograph, double black);

/// The corners in the photograph, each moved by at most `most_px` of its pixels to where view and photograph agree best; `aligned`
/// is the result of align() with the given corners, `gains` that of fit_gains() with `aligned`. A corner that the light does not
/// determine stays.
Corners fit_corners(const Image& view, const Corners& in_view, const Aligned& aligned, const std::array<double, 3>& gains,
                    const Corners& in_photograph, double most_px);

/// How photograph and simulation relate, and both made comparable.
struct Match {
    std::array<double, 3> gains;  // see fit_gains()
    double blur_px;               // standard deviation in pixels of the view; 0 where none was fitted
    double used;                  // share of the screen's pixels that are used for the fit: those not saturated
    double ssim, rmse, psnr_db;   // over the screen; light in units of the simulation
    Image simulated;              // blurred, clipped at the photograph's white
    Image photograph;             // divided by the gains
};

/// Fits gains and, with `fit_blur`, a Gaussian blur of the simulated picture. `white` is the brightest light that the photograph
/// can hold; `black` as in fit_gains(). Throws InputError as fit_gains() does, and where no window of 11 x 11 pixels fits into the
/// screen.
Match match(const Image& simulated, const Aligned& photograph, bool fit_blur, double white, double black);

}  // namespace lfdsim
