// What is measured: a display, what it shows, and how finely. Floor 3, public as a part of measure.h.
#pragma once
#include "base/job.h"
#include "content/content.h"
#include "display/display.h"
#include "engine/render.h"
#include "geometry/geometry.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lfdsim {

struct AnalysisOptions {
    std::vector<double> angles_deg;  // of the views, rising; empty: see fov.h
    std::vector<double> depths_mm;   // of the content in front of the vertex plane, rising; empty: see dof_depths.h
    std::optional<double> viewing_distance_mm =
        {};                       // of eyes from the panel; default: the camera's distance from the panel's centre
    double eye_distance_mm = 65;  // between a viewer's two eyes
    double wavelength_nm = 550;
    int threads = 0;          // 0: all
    std::string device = {};  // of renderings, as RenderOptions has it
};

/// Thrown where the caller cancels the work; nothing of the current measure is kept.
struct Stopped {};

class ShownPanel;  // elemental_panel.h

class Subject {
  public:
    /// A valid display; the scene may be absent, for measures that need none.
    Subject(Display, std::optional<ContentScene>, AnalysisOptions);

    const Display& display() const { return display_; }
    const Geometry& geometry() const { return geometry_; }
    const Theory& theory() const { return theory_; }
    const AnalysisOptions& options() const { return options_; }
    /// Theory along one axis of the array.
    const AxisTheory& theory(int axis) const { return theory_.along[std::size_t(axis)]; }
    int threads() const { return options_.threads; }
    /// How its views are rendered; a crop may be added.
    RenderOptions rendering() const;
    double viewing_distance_mm() const;
    bool has_scene() const { return scene_.has_value(); }
    /// Throws InputError where there is none.
    const ContentScene& scene() const;

    /// The elemental images of the scene where the description puts it, as the panel shows them: computed at the first call, and
    /// kept. Throws Stopped.
    const SummedPanel& panel(const Job&);

    /// Mean light that the camera, on axis, sees of the array's rectangle when the panel is white, over all three channels: lenses
    /// in focus on subpixels show some of them alone. Simulated pictures are divided by it, so that light lost in lenses and gaps
    /// does not count as unlikeness. More than 0. Throws Stopped.
    double white_field(const Job&);

  private:
    Display display_;
    Geometry geometry_;
    Theory theory_;
    std::optional<ContentScene> scene_;
    AnalysisOptions options_;
    std::shared_ptr<const ShownPanel> shown_;
    std::optional<double> white_field_;
};

}  // namespace lfdsim
