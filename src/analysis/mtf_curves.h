// What a display resolves in one plane and direction, seen from one angle: the figures and curves of `analyze mtf`. Floor 3.
#pragma once
#include "analysis/line_spread.h"
#include "analysis/subject.h"

#include <array>
#include <string>
#include <vector>

namespace lfdsim {

struct MtfCurves {
    double depth_mm, angle_deg;
    bool horizontal;                         // the direction that is resolved
    double mm_per_deg;                       // in that plane, as the eye sees it
    double astray;                           // share of the light of which theory says nothing
    std::string missing;                     // why there is no modulation; else nothing
    std::vector<double> frequencies_per_mm;  // in that plane, in equal steps from 0
    std::vector<double> theory;              // of as many
    Modulation modulation;                   // the same, of lines of sight; empty if it is missing
    std::vector<double> pixels_anywhere;     // the same, were the panel's pixels shifted by any part of one
    double spread_mm;                        // the strip that 95 % of the light stays within; NaN: no light

    /// By pictures of slanted edges: red, green, blue; empty: no edge was seen, or an edge's light went farther than was looked.
    std::array<Modulation, 3> edges;
    int lenses = 0;  // that the edges crossed

    bool has_theory() const { return astray < 0.01; }
    /// The frequency at which modulation first falls below a level; NaN: it never does. The error holds what the phases in which
    /// this screen's pixels happen to meet its lenses make of it.
    Estimate below(double level) const;
    /// The same of a colour's edges. They are a sample of all the places where edges may be, so the error is at least what they
    /// differ by from lines of sight.
    Estimate edges_below(std::size_t channel, double level) const;
    double theory_below(double level) const;
};

/// All but the edges, in a plane at a depth before the vertex plane, of an eye at an angle.
MtfCurves mtf_curves(const Subject&, const SeenThroughLenses&, double depth_mm, double angle_deg, bool horizontal);

}  // namespace lfdsim
