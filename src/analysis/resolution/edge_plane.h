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

/// Slanted edges in one plane, and their MTF from pictures at several angles.
class EdgePlane {
  public:
    /// Edges at a depth, mm from the vertex plane, across a direction. `white`: the panel that shows white all over. Keeps
    /// references to all arguments.
    EdgePlane(const Subject&, double depth_mm, const Direction&, const SummedPanel& white, const Job&);

    /// Adds the edges' MTF to the curves of this plane and direction, given at several angles, except to those that have no
    /// modulation by lines of sight. Throws Stopped.
    void measure(std::span<MtfCurves>);

  private:
    EdgeEye eye(double angle_deg) const;
    double pitch_mm() const;
    void set_bars(double blur_mm, double angle_deg);
    void set_pictures(std::span<MtfCurves* const>);
    /// Makes the panel that shows the bars moved on by `picture` steps.
    void show(int picture);
    double pixel_mm(double most_per_mm) const;
    bool look(EdgeSpread&, EdgeEye, double pixel, MtfCurves&) const;

    const Subject& s_;
    const SummedPanel& white_;
    const Job& job_;
    double pitch_mm_;  // lens pitch in the measured direction
    Bars bars_;
    std::unique_ptr<ShownPanel> panel_;  // the panel that shows the bars
    int pictures_ = 1;                   // bars move by width_mm/pictures_ from one picture to the next
};

}  // namespace lfdsim
