// The measure of uniformity: a white panel's luminance over the screen, within a lens pitch and over viewing angle, and light
// efficiency. Floor 3.
#pragma once
#include "analysis/core/estimate.h"
#include "analysis/core/eye_rays.h"
#include "analysis/core/parallel.h"
#include "analysis/core/result.h"

#include <vector>

namespace lfdsim {

/// The luminance, relative to the panel's along its normal, that one eye sees in blocks of whole lenses: columns x rows parts of
/// the array as equal as lenses allow, row 0 at the top. Only what is in front of the panel counts.
struct ScreenLuminance {
    int columns, rows;
    std::array<double, 2> size_mm;  // of all parts together
    /// The luminance of a block.
    struct LuminancePart {
        Sums light{};          // mean luminance by each set of lines of sight; 0 if nothing of it is in front of the panel
        double lenses = 0;     // number in front of the panel
        bool whole = false;    // at least least_on_screen of it is in front of the panel; others count in the mean only
        bool is_inner = true;  // its middle lies in the middle 80 % of width and height
    };
    std::vector<LuminancePart> parts;
    /// Returns the parts' luminance by all sets; NaN for parts that are not whole.
    std::vector<double> values() const;
    /// Returns the mean over parts, weighted with their lenses in front of the panel.
    Estimate mean() const;
    /// Return the extremes over whole parts; NaN if there are none.
    double least() const, greatest() const;
    /// Returns 100 Lmin/Lmax over whole parts; `inside`: with Lmin of the inner parts. The error is the sum of those of both
    /// parts, each at least the parts' typical one, since one of many parts looks darkest by chance.
    Estimate uniformity_percent(bool inside) const;
};
/// Measures the luminance over the screen. Runs screen_luminance_parts() parts.
ScreenLuminance screen_luminance(const EyeRays&, const Display&, const Geometry&, const Vec3d& eye, Parts&);
/// Returns the number of blocks.
int screen_luminance_parts(const Display&, const Geometry&);

/// The luminance within one lens pitch, averaged over the lenses of the middle half of the array: `side` x `side` values, row 0
/// at the top, by the position at which lines of sight cross the vertex plane, in front of the middle 3/4 of the panel's width
/// and height.
struct PitchLuminance {
    static constexpr int side = 32;
    std::vector<Sums> places;
    /// Returns the values by all sets.
    std::vector<double> values() const;
    /// Returns the values along x' (0) or y' (1), ascending, averaged along the other axis.
    std::vector<Sums> profile(int axis) const;
};
/// The number of parts that pitch_luminance() runs; a multiple of independent_sets.
constexpr int pitch_luminance_parts = 128;
/// Measures the luminance within a pitch.
PitchLuminance pitch_luminance(const EyeRays&, const Display&, const Geometry&, const Vec3d& eye, Parts&);

/// Returns the mean over all sets of each quantity.
std::vector<double> means(const std::vector<Sums>&);

/// Returns Michelson's contrast, (max - min)/(max + min); 0 if all values are 0.
double michelson(const std::vector<double>&);
/// Returns Michelson's contrast of noisy values: seven sets determine where the greatest and the least are, the eighth gives
/// their values, each set in turn, so that noise alone makes no contrast. The error includes the excess of the contrast from all
/// sets together.
Estimate michelson(const std::vector<Sums>&);

/// Returns about how long the measure takes, in pictures of the camera's size.
std::int64_t uniformity_steps(const Subject&);
/// Measures uniformity and efficiency (docs/measures.md, "Uniformity and efficiency"). Throws Stopped; InputError if the viewing
/// distance is inside the display.
Result measure_uniformity(Subject&, Job&);

}  // namespace lfdsim
