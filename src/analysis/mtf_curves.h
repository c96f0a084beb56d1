// What a display resolves in one plane and direction, seen from one angle: the figures and curves of `analyze mtf`. Floor 3.
#pragma once
#include "analysis/edge_view.h"
#include "analysis/line_spread.h"
#include "analysis/subject.h"

#include <array>
#include <string>
#include <vector>

namespace lfdsim {

struct MtfCurves {
    double depth_mm, angle_deg;
    Direction direction;                     // that is resolved
    double mm_per_deg;                       // in that plane, as the eye sees it
    double astray;                           // share of the light that theory leaves out
    std::string missing;                     // why there is no modulation; else empty
    std::vector<double> frequencies_per_mm;  // in that plane, in equal steps from 0
    std::vector<double> theory;              // at these
    Modulation modulation;                   // at these, by lines of sight; empty if it is missing
    std::vector<double> pixels_anywhere;     // the same with the panel's pixels shifted by any part of one
    double spread_mm;                        // width of the strip that contains 95 % of the light; NaN: no light

    /// By pictures of slanted edges: red, green, blue; empty: no edge was seen, or too much light lies too far from it.
    std::array<Modulation, 3> edges;
    int lenses = 0;  // that the edges crossed

    bool has_theory() const { return astray < 0.01; }
    /// The frequency at which modulation first falls below a level; NaN: it never does. The error includes the effect of the phases
    /// in which this screen's pixels happen to meet its lenses.
    Estimate below(double level) const;
    /// The same of a colour's edges. They are a sample of all the places where edges may be, so the error is at least their
    /// difference from lines of sight.
    Estimate edges_below(std::size_t channel, double level) const;
    double theory_below(double level) const;
};

/// All but the edges, for a plane at a depth in front of the vertex plane and an eye at an angle.
MtfCurves mtf_curves(const Subject&, const SeenThroughLenses&, double depth_mm, double angle_deg, const Direction&);

}  // namespace lfdsim
