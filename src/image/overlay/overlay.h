// Lays a photograph of a screen over a simulated view of it: docs/measures.md, "Overlay". Floor 0.
#pragma once
#include "base/job.h"
#include "display/display.h"
#include "image/compare/ssim.h"
#include "image/image.h"
#include "image/overlay/homography.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lfdsim {

/// The photograph on the view's grid, each pixel the mean light over its area; black outside `screen`.
struct Aligned {
    Image light;
    Region screen;                        // pixels that show the screen in both pictures
    std::vector<std::uint8_t> saturated;  // for each pixel: 1 where the camera may have been saturated
};

/// `saturation`: linear light from which a photograph's value means "this or more"; infinite where values have no upper limit. Both
/// corners must pass check_corners(). `part` restricts the screen to some pixels of the view. Where the job is cancelled, rows stay
/// black.
Aligned align(const Image& photograph, const Corners& in_photograph, int view_width, int view_height, const Corners& in_view,
              double saturation, std::optional<Rect> part = {}, const Job& = Job());

/// Light of the photograph divided by light of the simulation: R, G, B. A channel that is black in the simulation gets the mean of
/// the others. The photograph's channels must exceed `black` somewhere. Throws InputError if there is nothing to fit: no common
/// pixels, or the screen black in either picture or saturated all over.
std::array<double, 3> fit_gains(const Image& simulated, const Aligned& photograph, double black);

/// The corners in the photograph, each moved by at most `most_px` of its pixels to where view and photograph agree best; `aligned`
/// is the result of align() with the given corners, `gains` that of fit_gains() with `aligned`. A corner that the light does not
/// determine stays. Where the job is cancelled, they are as far as the fit had come.
Corners fit_corners(const Image& view, const Corners& in_view, const Aligned& aligned, const std::array<double, 3>& gains,
                    const Corners& in_photograph, double most_px, const Job& = Job());

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
/// screen. Where the job is cancelled, the blur is as far as the fit had come.
Match match(const Image& simulated, const Aligned& photograph, bool fit_blur, double white, double black, const Job& = Job());

/// A click may miss the edge of a picture of width x height pixels, and a view may be a close-up: throws InputError at `where` for
/// a corner that is more than so many pictures outside.
void check_near(const std::string& where, const Corners&, const std::string& picture, int width, int height, double pictures);

/// A photograph of a screen.
struct ScreenPhoto {
    Image image;                         // as it is stored
    bool codes = true;                   // its values are codes, which white limits; or light without a limit
    Encoding encoding = Encoding::srgb;  // of codes
    int orientation = 1;                 // see read_orientation()
    Corners corners{};                   // of the screen, in pixels of the picture as viewers show it
};

struct OverlayOptions {
    bool fit_corners = false;  // by up to 5 pixels of the photograph
    bool fit_blur = false;
    std::optional<Rect> part = {};  // see align()
};

struct Overlay {
    Corners corners;  // in the photograph as viewers show it, fitted or as they were
    Region screen;
    Match match;
};

/// Memory that lay_over() takes for a view of this size, besides that of the pictures.
constexpr double overlay_bytes(double view_width, double view_height) { return 160 * view_width * view_height; }

/// Runs all of the steps above. Both corners must pass check_corners(). Throws InputError as the steps do, and at `--fit-corners`
/// for fitted corners that do not pass. If the job is cancelled it ends soon, and what it returns means nothing.
Overlay lay_over(const Image& view, const Corners& in_view, ScreenPhoto, const OverlayOptions&, const Job& = Job());

}  // namespace lfdsim
