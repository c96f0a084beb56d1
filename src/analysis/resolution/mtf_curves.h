// Resolution in one plane and direction, seen from one angle: the figures and curves of `analyze mtf`. Floor 3.
#pragma once
#include "analysis/core/subject.h"
#include "analysis/resolution/edge_view.h"
#include "analysis/resolution/line_spread.h"
#include "base/constants.h"

#include <array>
#include <string>
#include <vector>

namespace lfdsim {

/// The MTF of one channel by lines of sight and by theory, at MtfCurves::frequencies_per_mm.
struct ChannelMtf {
    Modulation modulation;                // by lines of sight; empty if it is missing
    std::vector<double> pixels_anywhere;  // as MtfCurves::pixels_anywhere
    std::vector<double> theory;
    // Mean distance from the point looked at to the one shown, whose difference between colours is their fringe
    Estimate middle_mm;
    double middle_anywhere_mm;  // with the panel's pixels shifted by any part of one
    double theory_middle_mm;
};

/// The frequency per mm at which modulation first falls below a level. Its error reaches from where the curve less its own error
/// does so to where the curve plus its error does: far, if the curve touches the level. NaN if the latter never does within the
/// frequencies measured.
struct LimitingFrequency {
    Estimate found;
    double least = nan;  // where the curve less its error falls below the level
};

/// The curves of one plane, direction and angle.
struct MtfCurves {
    double depth_mm, angle_deg;              // of the plane from the vertex plane; of the eye to the right
    Direction direction;                     // the direction that is resolved
    double mm_per_deg;                       // length in that plane, along the direction, of a degree as the eye sees it
    double astray;                           // share of the light on other lenses' elemental images, which theory leaves out
    std::string missing;                     // why there is no modulation; empty if there is
    std::vector<double> frequencies_per_mm;  // in that plane, in equal steps from 0
    std::vector<double> theory;              // modulation by theory at these frequencies
    Modulation modulation;                   // by lines of sight at these frequencies, of the luminance; empty if it is missing
    std::vector<double> pixels_anywhere;     // modulation with the panel's pixels shifted by any part of one
    double spread_mm;                        // width of the strip that contains 95 % of the light; NaN: no light
    std::vector<ChannelMtf> channels;        // red, green and blue; empty: all are as the luminance

    /// The modulation of red, green and blue by pictures of slanted edges; empty if no edge was seen, or if too much light lies
    /// too far from it.
    std::array<Modulation, 3> edges;
    int lenses = 0;  // crossed by the edges of all pictures

    /// Returns whether theory holds: less than 1 % of the light is astray.
    bool has_theory() const { return astray < 0.01; }
    /// Return where the MTF of the luminance, or of a channel, falls below a level. The error includes the effect of the phases
    /// in which this screen's pixels happen to meet its lenses.
    LimitingFrequency below(double level) const;
    LimitingFrequency below(double level, std::size_t channel) const;
    /// Returns where the MTF of a channel's edges falls below a level. Edges are a sample of all possible edge positions, so the
    /// error is at least their difference from lines of sight.
    LimitingFrequency edges_below(std::size_t channel, double level) const;
    /// Return where theory's MTF falls below a level; NaN if it does not, or if there is no theory.
    double theory_below(double level) const;
    double theory_below(double level, std::size_t channel) const;
};

/// The lines of sight of an eye through the lenses, for the luminance and for each channel.
struct SeenInColours {
    SeenThroughLenses luminance;
    std::vector<SeenThroughLenses> channels;  // red, green and blue; empty: all are as the luminance
};
/// Traces the lines of an eye, mm, display frame.
SeenInColours seen_in_colours(const Subject&, const Vec3d& eye_mm);

/// Returns all curves except those of edges, for a plane at a depth, mm in front of the vertex plane, and an eye at an angle,
/// degrees.
MtfCurves mtf_curves(const Subject&, const SeenInColours&, double depth_mm, double angle_deg, const Direction&);

}  // namespace lfdsim
