// What the eye makes of a luminance pattern. Floor 3.
#pragma once

namespace lfdsim {

/// Contrast sensitivity over its greatest, for cycles per degree: Mannos and Sakrison, IEEE Trans. Inf. Theory 20(4), 525 (1974),
/// A(f) = 2.6 (0.0192 + 0.114 f) exp(-(0.114 f)^1.1), greatest at 8 cycles per degree.
double eye_filter(double cycles_per_degree);

/// The contrast sensitivity for red against green of equal luminance: it falls from the coarsest on, tenfold every 6 cycles per
/// degree, to nothing at 12; after Mullen, J. Physiol. 359, 381 (1985).
double colour_filter(double cycles_per_degree);

/// Patterns finer than this are invisible: the usual limit of acuity.
inline constexpr double eye_limit_cycles_per_degree = 60;

/// A filter, and the frequency beyond which nothing is seen.
struct EyeFilter {
    double (*filter)(double cycles_per_degree);
    double finest_cycles_per_degree;
};
inline constexpr EyeFilter eye_for_luminance{eye_filter, eye_limit_cycles_per_degree}, eye_for_colour{colour_filter, 12};

/// Millimetres in a degree of what an eye sees from so far.
double mm_per_degree(double distance_mm);

}  // namespace lfdsim
