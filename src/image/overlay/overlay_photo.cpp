#include "base/input_error.h"
#include "image/formats/encoding.h"
#include "image/overlay/overlay.h"

#include <fmt/format.h>
#include <cmath>
#include <limits>

namespace lfdsim {
namespace {

/// Returns, for a point of a picture as viewers show it, rotated or mirrored as its Exif orientation says, the same point in the
/// picture as it is stored, which is width x height pixels.
Point as_stored(const Point& shown, int orientation, int width, int height) {
    const auto [x, y] = shown;
    switch (orientation) {
        case 2:
            return {width - x, y};
        case 3:
            return {width - x, height - y};
        case 4:
            return {x, height - y};
        case 5:
            return {y, x};
        case 6:
            return {y, height - x};
        case 7:
            return {width - y, height - x};
        case 8:
            return {width - y, x};
        default:
            return shown;
    }
}

/// Returns the inverse of as_stored(). `width` and `height` are those of the picture as it is stored.
Point as_shown(const Point& stored, int orientation, int width, int height) {
    const int back = orientation == 6 ? 8 : orientation == 8 ? 6 : orientation;
    return orientation >= 5 ? as_stored(stored, back, height, width) : as_stored(stored, back, width, height);
}

}  // namespace

void check_near(const std::string& where, const Corners& corners, const std::string& picture, int width, int height,
                double pictures) {
    for (const auto& [x, y] : corners)
        if (std::abs(x / width - 0.5) > 0.5 + pictures || std::abs(y / height - 0.5) > 0.5 + pictures)
            throw InputError(where, fmt::format("the corner {:g},{:g} lies far outside of {}, which is {} x {} pixels", x, y,
                                                picture, width, height));
}

Overlay lay_over(const Image& view, const Corners& in_view, ScreenPhoto photo, const OverlayOptions& options, const Job& job) {
    const int width = photo.image.width, height = photo.image.height;
    Corners stored;
    for (std::size_t k = 0; k < 4; ++k) stored[k] = as_stored(photo.corners[k], photo.orientation, width, height);
    // Codes from 250 on count as saturated, and a channel that nowhere exceeds 5 as black. Light has no such limits.
    const auto light = [&](double code) { return photo.encoding == Encoding::srgb ? srgb_to_linear(code / 255) : code / 255; };
    constexpr double none = std::numeric_limits<double>::infinity();
    const double saturation = photo.codes ? light(250) : none, white = photo.codes ? 1 : none, black = photo.codes ? light(5) : 0;
    const auto laid_over = [&] {
        return align(photo.image, stored, view.width, view.height, in_view, saturation, options.part, job);
    };
    Aligned aligned = laid_over();
    if (options.fit_corners && !job.cancelled()) {
        stored = fit_corners(view, in_view, aligned, fit_gains(view, aligned, black), stored, 5, job);
        for (std::size_t k = 0; k < 4; ++k) photo.corners[k] = as_shown(stored[k], photo.orientation, width, height);
        check_corners("--fit-corners", photo.corners);
        aligned = laid_over();
    }
    if (job.cancelled()) return {};
    photo.image = {};  // its memory is needed for what follows
    Match matched = match(view, aligned, options.fit_blur, white, black, job);
    return {photo.corners, std::move(aligned.screen), std::move(matched)};
}

}  // namespace lfdsim
