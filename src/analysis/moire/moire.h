// The pattern that the lens lattice makes with the panel's pixels: period, direction and contrast. Floor 3.
#pragma once
#include "analysis/core/estimate.h"
#include "analysis/core/result.h"
#include "analysis/moire/harmonic_lines.h"

#include <optional>

namespace lfdsim {

/// The strongest component of the pattern after the eye's filter, and errors that cover the true values.
struct MeasuredBeat {
    Beat beat;
    Frequency frequency_error;
    Estimate period_mm, direction_deg, contrast, seen;
};

/// The result of the search for the strongest wave; none where no component rises above the noise of the lines: `least` is then
/// the contrast that one would have needed.
struct MoireSearch {
    std::optional<MeasuredBeat> strongest;
    std::vector<MeasuredBeat> as_strong;  // other ones that may be as strong within the errors
    double least = 0;
};

/// The middle of the screen as an eye on axis sees it, `eye_mm` from the panel: at most 10 degrees of what lies before both panel
/// and array, in squares that tell waves of up to 50 cycles a degree apart.
Window middle_of_screen(const Display&, const Geometry&, double eye_mm);

MoireSearch find_moire(const WhiteLines&, const HarmonicLines&, const std::optional<Beat>& theory, double mm_per_degree);

std::int64_t moire_steps(const Subject&);
Result measure_moire(Subject&, Job&);

}  // namespace lfdsim
