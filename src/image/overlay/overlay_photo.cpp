#include "base/input_error.h"
#include "image/formats/encoding.h"
#include "image/overlay/overlay.h"

#include <fmt/format.h>
#include <cmath>
#include <limits>

namespace lfdsim {
void check_near(const std::string& where, const Corners& corners, const std::string& picture, int width, int height,
                double pictures) {
    for (const auto& [x, y] : corners)
        if (std::abs(x / width - 0.5) > 0.5 + pictures || std::abs(y / height - 0.5) > 0.5 + pictures)
            throw InputError(where, fmt::format("the corner {:g},{:g} lies far outside of {}, which is {} x {} pixels", x, y,
                                                picture, width, height));
}

Overlay lay_over(const Image& view, const Corners& in_view, ScreenPhoto photo, const OverlayOptions& options, const Job& job) {
    // Codes from 250 on count as saturated, and a channel that nowhere exceeds 5 as black. Light has no such limits.
    const auto light = [&](double code) { return photo.encoding == Encoding::srgb ? srgb_to_linear(code / 255) : code / 255; };
    constexpr double none = std::numeric_limits<double>::infinity();
    const double saturation = photo.codes ? light(250) : none, white = photo.codes ? 1 : none, black = photo.codes ? light(5) : 0;
    const auto laid_over = [&] {
        return align(photo.image, photo.corners, view.width, view.height, in_view, saturation, options.part, job);
    };
    Aligned aligned = laid_over();
    if (options.fit_corners && !job.cancelled()) {
        photo.corners = fit_corners(view, in_view, aligned, fit_gains(view, aligned, black), photo.corners, 5, job);
        check_corners("--fit-corners", photo.corners);
        aligned = laid_over();
    }
    if (job.cancelled()) return {};
    photo.image = {};  // its memory is needed for what follows
    Match matched = match(view, aligned, options.fit_blur, white, black, job);
    return {photo.corners, std::move(aligned.screen), std::move(matched)};
}

}  // namespace lfdsim
