// The subject of a measure: a display, what it shows, and options. Floor 3, public as a part of measure.h.
#pragma once
#include "base/constants.h"
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

/// Options of all measures.
struct AnalysisOptions {
    std::vector<double> angles_deg;  // of the views, ascending; empty: see fov.h
    std::vector<double> depths_mm;   // of the content from the vertex plane towards the viewer, ascending; empty: see dof_depths.h
    std::optional<double> viewing_distance_mm =
        {};  // of eyes from the panel; default: the camera's distance from the panel's centre
    double eye_distance_mm = usual_eye_separation_mm;  // between a viewer's two eyes
    double wavelength_nm = 550;                        // of the diffraction limits
    int threads = 0;                                   // 0: one for each processor
    std::string device = {};                           // of renderings, as RenderOptions::device
};

/// The limits of options that a user sets. Angles and depths may be negative.
struct AnalysisLimits {
    static constexpr double angle_deg = 80, depth_mm = 1e6, viewing_distance_mm = 1e6, eye_distance_mm = 1000, wavelength_nm = 1e5;
    static constexpr std::size_t values = 10001;  // of angles or of depths
};

/// Thrown if the caller cancels the work; nothing of the current measure is kept.
struct Stopped {};

/// Renders a picture without showing its progress. Throws Stopped.
Image whole_picture(const Display&, const Geometry&, const SummedPanel&, const RenderOptions&, const Job&);

class ShownPanel;  // elemental_panel.h

/// A display under measurement, with its geometry and theory, and with what several measures need, which is computed once.
class Subject {
  public:
    /// Throws InputError if the display is not valid. The scene may be absent, for measures that need none.
    Subject(Display, std::optional<ContentScene>, AnalysisOptions);

    const Display& display() const { return display_; }
    const Geometry& geometry() const { return geometry_; }
    const Theory& theory() const { return theory_; }
    const AnalysisOptions& options() const { return options_; }
    /// Returns theory along one axis of the array, 0: x', 1: y'.
    const AxisTheory& theory(int axis) const { return theory_.along[std::size_t(axis)]; }
    int threads() const { return options_.threads; }
    /// Returns how views are rendered; the caller may add a crop.
    RenderOptions rendering() const;
    /// Returns the distance of eyes from the panel, mm: the option's, or the camera's.
    double viewing_distance_mm() const;
    bool has_scene() const { return scene_.has_value(); }
    /// Returns the scene. Throws InputError if there is none.
    const ContentScene& scene() const;

    /// Returns the scene's elemental images, at the depth that the description states, as the panel shows them. They are computed
    /// at the first call and kept. Throws Stopped.
    const SummedPanel& panel(const Job&);

    /// Returns the mean light of the screen, over its pixels and all three channels, that the camera on axis sees of a white
    /// panel; more than 0. It is over all channels since lenses in focus on subpixels show only some of them. Simulated pictures
    /// are divided by it, so that light lost in lenses and gaps does not count as unlikeness. Throws Stopped; InputError if no
    /// light is seen.
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
