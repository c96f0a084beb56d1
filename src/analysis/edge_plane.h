// One plane of slanted edges that a display shows, measured from several angles. Floor 3.
#pragma once
#include "analysis/edge_view.h"
#include "analysis/slanted_edge.h"
#include "analysis/subject.h"

#include <array>
#include <vector>

namespace lfdsim {

struct MtfCurves {
    double depth_mm, angle_deg;
    bool horizontal;                         // the direction that is resolved: the edges are near the vertical
    double mm_per_deg;                       // in the edges' plane, as the eye sees it
    std::vector<double> frequencies_per_mm;  // in the edges' plane, from 0
    std::vector<double> theory;              // of as many
    double astray;                           // share of the light of which theory says nothing
    double uneven;                           // by how much modulation may be wrong as phases of pixels are not met evenly
    std::array<std::vector<double>, 3> mtf;  // red, green, blue; empty: no edge was seen
    std::array<std::array<std::vector<double>, 3>, independent_sets>
        without;      // the same of all sets of the pictures' parts but one
    double lost = 0;  // share of the light that lands farther from an edge than was looked
    int lenses = 0;   // that the edges crossed

    bool has_theory() const { return astray < 0.01; }
    bool too_much_lost() const { return lost > 0.2; }
    bool seen() const { return !mtf[1].empty(); }
    /// The frequency at which a colour's modulation falls below a level; NaN: it never does, or too much of the light is lost.
    Estimate below(std::size_t channel, double level) const;
    double theory_below(double level) const;
};

class EdgePlane {
  public:
    /// Edges at a depth before the vertex plane. `white`: the panel that shows white all over.
    EdgePlane(const Subject&, double depth_mm, bool horizontal, const Pyramid& white, const Job&);

    /// From angles rising from 0, to the right. Throws Stopped.
    std::vector<MtfCurves> measure(const std::vector<double>& angles_deg);

  private:
    Eye eye(double angle_deg) const;
    double pitch_mm() const;
    bool set_bars(double blur_mm, double angle_deg);
    void set_pictures(const std::vector<double>& angles_deg);
    void show(int picture);
    double pixel_mm(double most_per_mm) const;
    bool look(EdgeSpread&, Eye, double pixel, MtfCurves&) const;
    bool strays(double angle_deg);
    MtfCurves blank(double angle_deg, double blur_mm) const;

    const Subject& s_;
    const Pyramid& white_;
    const Job& job_;
    double depth_mm_;
    Bars bars_;
    std::unique_ptr<ShownPanel> panel_;  // that shows the bars
    int pictures_ = 1;                   // the bars are moved by this share of their width from one to the next
};

}  // namespace lfdsim
