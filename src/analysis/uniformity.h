// A white panel: luminance over the screen, within a lens pitch and over viewing angle, and light efficiency. Floor 3.
#pragma once
#include "analysis/eye_rays.h"
#include "analysis/parallel.h"
#include "analysis/result.h"

#include <vector>

namespace lfdsim {

/// Luminance seen by one eye over the panel's own along its normal, averaged over whole lenses: columns x rows parts of the array
/// as equal as lenses allow, row 0 at the top.
struct ScreenLuminance {
    int columns, rows;
    std::vector<double> values;
    double least() const, greatest() const, mean() const;
    /// The least of the parts whose middle lies in the middle 8/10 of width and height.
    double least_inside() const;
};
/// Takes screen_luminance_parts(...) parts.
ScreenLuminance screen_luminance(const EyeRays&, const Display&, const Vec3d& eye, Parts&);
int screen_luminance_parts(const Display&);

/// Luminance within one lens pitch, averaged over the lenses of the middle half of the screen: `side` x `side` values, row 0 at the
/// top, over lines of sight that cross the vertex plane there.
struct PitchLuminance {
    static constexpr int side = 32;
    std::vector<double> values;
    std::vector<double> profile(int axis) const;  // along x (0) or y (1), averaged over the other
};
constexpr int pitch_luminance_parts = 128;
PitchLuminance pitch_luminance(const EyeRays&, const Display&, const Vec3d& eye, Parts&);

/// Michelson contrast (max - min) / (max + min); 0 if all is dark.
double michelson(const std::vector<double>&);

std::int64_t uniformity_steps(const Subject&);
Result measure_uniformity(Subject&, Job&);

}  // namespace lfdsim
