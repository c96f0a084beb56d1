// The measure of moire, the pattern that the lens lattice makes with the panel's pixels: period, direction and contrast. Floor 3.
#pragma once
#include "analysis/core/estimate.h"
#include "analysis/core/result.h"
#include "analysis/moire/harmonic_lines.h"

#include <optional>

namespace lfdsim {

/// The strongest component of the pattern after the eye's filter, with stated errors.
struct MeasuredBeat {
    Beat beat;
    Frequency frequency_error;
    Estimate period_mm, direction_deg, contrast, seen;
};

/// The result of the search for the strongest wave.
struct MoireSearch {
    std::optional<MeasuredBeat> strongest;  // nothing: no wave rises above the noise of the lines
    std::vector<MeasuredBeat> as_strong;    // other waves that may be as strong within the errors
    double least = 0;                       // the least contrast that rises above the noise, six standard deviations
};

/// Returns the middle of the screen for an eye on axis, `eye_mm` from the panel: at most 10 degrees of what lies in front of the
/// panel and within the array, in squares that resolve waves of up to 50 cycles per degree.
Window middle_of_screen(const Display&, const Geometry&, double eye_mm);

/// Finds the strongest wave among those of the lines and that of theory, which may be too weak for the former. `mm_per_degree`:
/// in the vertex plane.
MoireSearch find_moire(const WhiteLines&, const HarmonicLines&, const std::optional<Beat>& theory, double mm_per_degree);

/// Returns about how long the measure takes, in pictures of the camera's size.
std::int64_t moire_steps(const Subject&);
/// Measures moire (docs/measures.md, "Moire"). Throws Stopped; InputError if the eye is inside the display or sees no light.
Result measure_moire(Subject&, Job&);

}  // namespace lfdsim
