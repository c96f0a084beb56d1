// A white panel: luminance over the screen, within a lens pitch and over viewing angle, and light efficiency. Floor 3.
#pragma once
#include "analysis/core/estimate.h"
#include "analysis/core/eye_rays.h"
#include "analysis/core/parallel.h"
#include "analysis/core/result.h"

#include <vector>

namespace lfdsim {

/// Luminance seen by one eye over the panel's own along its normal, averaged over whole lenses: columns x rows parts of the array
/// as equal as lenses allow, row 0 at the top. Of each what is in front of the panel.
struct ScreenLuminance {
    int columns, rows;
    struct LuminancePart {
        Sums light{};          // mean luminance by each set of lines of sight; 0 where none of it is in front of the panel
        double lenses = 0;     // in front of the panel
        bool whole = false;    // at least least_on_screen of it is; others count in the mean alone
        bool is_inner = true;  // its middle lies in the middle 8/10 of width and height
    };
    std::vector<LuminancePart> parts;
    std::vector<double> values() const;  // NaN of parts that are not whole
    Estimate mean() const;
    double least() const, greatest() const;
    /// 100 least / greatest; `inside`: the least of the inner parts. The error allows for one of many parts looking darkest by
    /// chance.
    Estimate uniformity_percent(bool inside) const;
};
/// Takes screen_luminance_parts(...) parts.
ScreenLuminance screen_luminance(const EyeRays&, const Display&, const Geometry&, const Vec3d& eye, Parts&);
int screen_luminance_parts(const Display&, const Geometry&);

/// Luminance within one lens pitch, averaged over the lenses of the middle half of the array: `side` x `side` values, row 0 at the
/// top, over lines of sight that cross the vertex plane there, in front of the middle 3/4 of the panel's width and height.
struct PitchLuminance {
    static constexpr int side = 32;
    std::vector<Sums> places;
    std::vector<double> values() const;
    std::vector<Sums> profile(int axis) const;  // along x (0) or y (1), averaged over the other
};
constexpr int pitch_luminance_parts = 128;
PitchLuminance pitch_luminance(const EyeRays&, const Display&, const Geometry&, const Vec3d& eye, Parts&);

/// The mean of all sets.
std::vector<double> means(const std::vector<Sums>&);

/// Michelson contrast (max - min) / (max + min); 0 if all is dark.
double michelson(const std::vector<double>&);
/// The contrast of noisy values: seven sets find where the greatest and the least are, the eighth gives their values, each in
/// turn, so that noise alone makes no contrast.
Estimate michelson(const std::vector<Sums>&);

std::int64_t uniformity_steps(const Subject&);
Result measure_uniformity(Subject&, Job&);

}  // namespace lfdsim
