// Warnings of light above white: of light that may be codes, and of light that codes cut off. Floor 0.
#pragma once
#include "image/image.h"

#include <cstdint>
#include <string>

namespace lfdsim {

/// What light is of, which decides how bright it may be.
enum class LightOf {
    panel,   // shows at most 1, its white
    picture  // of a display, whose subpixels and lenses may be some times as bright as its mean white
};
/// Returns the warning, to follow the picture's name, or an empty text. `light` has R, G, B at the beginning of each `stride`
/// floats. A panel's light is doubted above 1; a picture's where it also has whole numbers only, or exceeds 16.
std::string above_white(const float* light, std::int64_t pixels, int stride, LightOf);

/// Light that pictures lose where they become codes, which end at white.
struct CutOff {
    std::int64_t pixels = 0, cut = 0;  // all pixels; those that are brighter than white by more than half an 8-bit code
    float greatest = 0;                // the brightest channel
    double light = 0, lost = 0;        // sums over all channels: the light; what of it is above white

    void add(const Image&);
    CutOff& operator+=(const CutOff&);
    double pixels_share() const { return pixels > 0 ? double(cut) / double(pixels) : 0; }
    double light_share() const { return light > 0 ? lost / light : 0; }
    /// Returns the warning, to follow the pictures' name, or an empty text where less than 0.1 % of the light is lost.
    std::string text() const;
};

}  // namespace lfdsim
