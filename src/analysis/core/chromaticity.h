// Chromaticity of light, and its differences over parts of the screen or over angles. Floor 3.
#pragma once
#include "analysis/core/estimate.h"

#include <array>
#include <vector>

namespace lfdsim {

/// (u', v') of CIE 1976.
using Chromaticity = std::array<double, 2>;

/// Returns the chromaticity of light in linear red, green and blue of the sRGB primaries (IEC 61966-2-1); NaN if there is no
/// light.
Chromaticity chromaticity(const std::array<double, 3>& rgb);

/// The light of one part in red, green and blue, relative to a white panel's, for each independent set of lines of sight.
using ColourSums = std::array<Sums, 3>;

/// The distances in (u', v') of the parts' chromaticities from that of all parts' light together (docs/measures.md, "Uniformity
/// and efficiency", colour).
struct ColourSpread {
    Estimate largest, mean;           // mean: over parts by their weights
    Chromaticity together;            // of all parts' light
    std::vector<Chromaticity> parts;  // of each part; NaN: dark
    std::vector<double> distance;     // of each part, from all sets together, so that noise raises it; NaN: dark
    int dark = 0;                     // number of parts that are left out: their luminance is less than a tenth of the mean
};
/// Returns the distances of parts with these weights. Noise makes distances, too: so seven sets determine which part has the
/// largest one and in which direction from the mean each part lies, and the eighth determines how far along that direction it
/// lies; each set is the eighth in turn. Errors include the excess of all sets together, and the change that parts make of which
/// noise leaves open whether they are dark.
ColourSpread colour_spread(const std::vector<ColourSums>& parts, const std::vector<double>& weights);

}  // namespace lfdsim
