// Chromaticity of light, and how far it differs over parts of what is seen. Floor 3.
#pragma once
#include "analysis/core/estimate.h"

#include <array>
#include <vector>

namespace lfdsim {

/// u', v' of CIE 1976.
using Chromaticity = std::array<double, 2>;

/// The chromaticity of light in linear red, green and blue with the primaries of sRGB (IEC 61966-2-1); NaN for none.
Chromaticity chromaticity(const std::array<double, 3>& rgb);

/// Light of one part in red, green and blue, over that of a white panel, by each set of lines of sight.
using ColourSums = std::array<Sums, 3>;

/// The distances in u', v' of the parts' chromaticities from that of their light together.
struct ColourSpread {
    Estimate largest, mean;           // mean: over parts by their weights
    Chromaticity together;            // of all parts' light
    std::vector<Chromaticity> parts;  // NaN: dark
    std::vector<double> distance;     // of each; noise raises it
    int dark = 0;                     // parts that are left out: their luminance is less than a tenth of the mean
};
/// Seven sets find where the largest distance is and in which direction from the mean each part lies; the eighth tells how far
/// that way it is; each in turn, so that noise alone makes no distance. Errors include the excess of all sets together, and what
/// parts change that may as well be dark, or not.
ColourSpread colour_spread(const std::vector<ColourSums>& parts, const std::vector<double>& weights);

}  // namespace lfdsim
