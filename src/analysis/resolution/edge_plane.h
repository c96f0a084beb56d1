// A plane of slanted edges that a display shows, seen from several angles. Floor 3.
#pragma once
#include "analysis/core/elemental_panel.h"
#include "analysis/core/subject.h"
#include "analysis/resolution/edge_view.h"
#include "analysis/resolution/mtf_curves.h"
#include "analysis/resolution/slanted_edge.h"

#include <memory>
#include <span>

namespace lfdsim {

class EdgePlane {
  public:
    /// Edges at a depth in front of the vertex plane. `white`: the panel that shows white all over.
    EdgePlane(const Subject&, double depth_mm, const Direction&, const SummedPanel& white, const Job&);

    /// Adds the edges to the curves of this plane and direction, from several angles, except where modulation is missing. Throws
    /// Stopped.
    void measure(std::span<MtfCurves>);

  private:
    EdgeEye eye(double angle_deg) const;
    double pitch_mm() const;
    void set_bars(double blur_mm, double angle_deg);
    void set_pictures(std::span<MtfCurves* const>);
    void show(int picture);
    double pixel_mm(double most_per_mm) const;
    bool look(EdgeSpread&, EdgeEye, double pixel, MtfCurves&) const;

    const Subject& s_;
    const SummedPanel& white_;
    const Job& job_;
    double pitch_mm_;  // the lenses' in the measured direction
    Bars bars_;
    std::unique_ptr<ShownPanel> panel_;  // that shows the bars
    int pictures_ = 1;                   // the bars move by 1/pictures_ of their width from one to the next
};

}  // namespace lfdsim
