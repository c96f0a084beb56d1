// The eye's sensitivity to patterns of luminance and of colour. Floor 3.
#pragma once

namespace lfdsim {

/// Returns the contrast sensitivity relative to its greatest: Mannos and Sakrison, IEEE Trans. Inf. Theory 20(4), 525 (1974),
/// A(f) = 2.6 (0.0192 + 0.114 f) exp(-(0.114 f)^1.1), f in cycles per degree, greatest at 7.9.
double eye_filter(double cycles_per_degree);

/// Returns the contrast sensitivity to red against green of equal luminance relative to that for the coarsest patterns: it falls
/// tenfold every 6 cycles per degree, and ends at 12; after Mullen, J. Physiol. 359, 381 (1985). The end is EyeFilter's.
double colour_filter(double cycles_per_degree);

/// The usual limit of acuity: finer patterns are invisible.
inline constexpr double eye_limit_cycles_per_degree = 60;

/// A filter, and the frequency beyond which nothing is seen.
struct EyeFilter {
    double (*filter)(double cycles_per_degree);
    double finest_cycles_per_degree;  // finer patterns are not seen at all
};
inline constexpr EyeFilter eye_for_luminance{eye_filter, eye_limit_cycles_per_degree}, eye_for_colour{colour_filter, 12};

/// Returns the length, mm, of a degree at a distance from the eye: distance pi/180.
double mm_per_degree(double distance_mm);

}  // namespace lfdsim
