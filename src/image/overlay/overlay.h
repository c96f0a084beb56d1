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

/// A photograph on the view's grid.
struct Aligned {
    Image light;                          // the photograph's mean light over each pixel's area; black outside `screen`
    Region screen;                        // pixels that show the screen in both pictures
    std::vector<std::uint8_t> saturated;  // for each pixel: 1 where the camera may have been saturated
};

/// Maps a photograph to the grid of a view of view_width x view_height pixels. `saturation` is the linear light from which a value
/// of the photograph means "this or more", infinite where values have no upper limit. Both corners must pass check_corners().
/// `part` restricts the screen to some pixels of the view. Where the job is cancelled, rows stay black.
Aligned align(const Image& photograph, const Corners& in_photograph, int view_width, int view_height, const Corners& in_view,
              double saturation, std::optional<Rect> part = {}, const Job& = Job());

/// Returns the light of the photograph divided by that of the simulation, for R, G, B. A channel that is black in the simulation
/// gets the mean of the others. The photograph's channels must exceed `black` somewhere. Throws InputError if there is nothing to
/// fit: no common pixels, or a screen that is black in either picture or saturated on more than 99 % of it.
std::array<double, 3> fit_gains(const Image& simulated, const Aligned& photograph, double black);

/// Returns the corners in the photograph, each moved by at most `most_px` of its pixels to where view and photograph agree best.
/// `aligned` is the result of align() with the given corners, `gains` that of fit_gains() with `aligned`. A corner that the light
/// does not determine stays. Where the job is cancelled, the result is what the fit had reached.
Corners fit_corners(const Image& view, const Corners& in_view, const Aligned& aligned, const std::array<double, 3>& gains,
                    const Corners& in_photograph, double most_px, const Job& = Job());

/// The relation of photograph and simulation, and both in the light of the simulation.
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
/// screen. Where the job is cancelled, the blur is what the fit had reached.
Match match(const Image& simulated, const Aligned& photograph, bool fit_blur, double white, double black, const Job& = Job());

/// Throws InputError at `where` for a corner that is outside a picture of width x height pixels by more than `pictures` times its
/// size. Corners a little outside are right: a click may miss the edge, and a view may be a close-up.
void check_near(const std::string& where, const Corners&, const std::string& picture, int width, int height, double pictures);

/// A photograph of a screen.
struct ScreenPhoto {
    Image image;
    bool codes = true;                   // its values were codes, limited by white; false: light without a limit
    Encoding encoding = Encoding::srgb;  // of these codes
    Corners corners{};                   // of the screen, in the picture's pixels
};

struct OverlayOptions {
    bool fit_corners = false;  // by up to 5 pixels of the photograph
    bool fit_blur = false;
    std::optional<Rect> part = {};  // see align()
};

struct Overlay {
    Corners corners;  // in the photograph, fitted or as they were
    Region screen;
    Match match;
};

/// Calls put(name, value) for each figure, by the name that it has in JSON and in Python.
template <class Put>
void visit_figures(const Overlay& o, const Put& put) {
    put("ssim", o.match.ssim);
    put("rmse", o.match.rmse);
    put("psnr_db", o.match.psnr_db);
    put("gains", o.match.gains);
    put("blur_px", o.match.blur_px);
    put("pixels", o.screen.pixels());
    put("unsaturated_share", o.match.used);
    put("corners", o.corners);
}

/// Returns the bytes that lay_over() takes for a view of this size, in addition to the pictures.
constexpr double overlay_bytes(double view_width, double view_height) { return 160 * view_width * view_height; }

/// Aligns, fits and matches a photograph and a view. Both corners must pass check_corners(). Throws InputError as the steps do,
/// and at `--fit-corners` for fitted corners that do not pass. If the job is cancelled it ends soon, with a meaningless result.
Overlay lay_over(const Image& view, const Corners& in_view, ScreenPhoto, const OverlayOptions&, const Job& = Job());

}  // namespace lfdsim
