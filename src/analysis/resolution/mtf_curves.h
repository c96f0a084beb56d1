// What a display resolves in one plane and direction, seen from one angle: the figures and curves of `analyze mtf`. Floor 3.
#pragma once
#include "analysis/core/subject.h"
#include "analysis/resolution/edge_view.h"
#include "analysis/resolution/line_spread.h"
#include "base/constants.h"

#include <array>
#include <string>
#include <vector>

namespace lfdsim {

/// The MTF of one channel by lines of sight and by theory, at the frequencies of all.
struct ChannelMtf {
    Modulation modulation;                // empty if it is missing
    std::vector<double> pixels_anywhere;  // as in MtfCurves
    std::vector<double> theory;
    Estimate middle_mm;  // mean distance from the point looked at to the one shown; differs by colour: fringes
    double theory_middle_mm;
};

/// The frequency per mm at which modulation first falls below a level, with an error that reaches from where the curve less its own
/// error does so to where the curve plus its error does: far apart where it grazes the level. NaN where the latter never does, as
/// far as was measured.
struct LimitingFrequency {
    Estimate found;
    double least = nan;  // where the curve less its error falls below the level
};

struct MtfCurves {
    double depth_mm, angle_deg;
    Direction direction;                     // that is resolved
    double mm_per_deg;                       // in that plane, as the eye sees it
    double astray;                           // share of the light that theory leaves out
    std::string missing;                     // why there is no modulation; else empty
    std::vector<double> frequencies_per_mm;  // in that plane, in equal steps from 0
    std::vector<double> theory;              // at these
    Modulation modulation;                   // at these, by lines of sight, of the luminance; empty if it is missing
    std::vector<double> pixels_anywhere;     // the same with the panel's pixels shifted by any part of one
    double spread_mm;                        // width of the strip that contains 95 % of the light; NaN: no light
    std::vector<ChannelMtf> channels;        // red, green and blue; empty: all are as the luminance

    /// The modulation by pictures of slanted edges: red, green, blue; empty: no edge was seen, or too much light lies too far
    /// from it.
    std::array<Modulation, 3> edges;
    int lenses = 0;  // that the edges crossed

    bool has_theory() const { return astray < 0.01; }
    /// The error includes the effect of the phases in which this screen's pixels happen to meet its lenses.
    LimitingFrequency below(double level) const;
    LimitingFrequency below(double level, std::size_t channel) const;
    /// The limiting frequency of a colour's edges. They are a sample of all the places where edges may be, so the error is at
    /// least their difference from lines of sight.
    LimitingFrequency edges_below(std::size_t channel, double level) const;
    double theory_below(double level) const;
    double theory_below(double level, std::size_t channel) const;
};

/// The lines of sight of an eye through the lenses, for the luminance and for each channel.
struct SeenInColours {
    SeenThroughLenses luminance;
    std::vector<SeenThroughLenses> channels;  // red, green and blue; empty: all are as the luminance
};
SeenInColours seen_in_colours(const Subject&, const Vec3d& eye_mm);

/// Returns all curves except those of edges, for a plane at a depth, mm in front of the vertex plane, and an eye at an angle,
/// degrees.
MtfCurves mtf_curves(const Subject&, const SeenInColours&, double depth_mm, double angle_deg, const Direction&);

}  // namespace lfdsim
