// What the field of view is read from: views of the scene beside photographs of it, and where lenses show their own images.
// Floor 3.
#pragma once
#include "analysis/fov/elemental_fov.h"
#include "analysis/fov/thresholds.h"
#include "content/content.h"
#include "engine/estimator/summed_panel.h"

namespace lfdsim {

/// Returns where theory puts the edge on the arc along one axis, degrees.
double theory_edge_deg(const Subject&, int axis);

/// Returns over how many degrees on either side of its edge the field of view fades: by the lens aperture and the diffuser, and
/// where images are made for another distance by the lenses across.
double fades_over_deg(const Subject&, int axis);

/// Returns fov_depth_mm(), or a lesser depth such that no eye on its way stands in the scene or nearer to it than it is deep.
double fov_scene_depth_mm(const Subject&, const std::vector<double>& angles_deg);

/// The scene, its elemental images and the white field, which all views share.
struct ShownEdge {
    ContentScene scene;
    const SummedPanel& panel;
    double white;
};

/// AngleCurves are, over the angles along one axis, SSIM of screen and content, and the photograph's share in the view.
struct AngleCurves {
    Curve screen, content, share;
};

/// Compares views along one axis with photographs. Throws Stopped.
AngleCurves angle_curves(const Subject&, const ShownEdge&, int axis, const std::vector<double>& angles_deg, Job&);

/// The geometry of rays gives these edges along each imaging axis: on the arc, degrees, as light leaves the lenses and with the
/// diffuser; and in the plane at the eye's distance, mm.
struct GeometricFov {
    std::array<OwnRange, 2> lenses, diffused, eyebox;
    std::int64_t whole_images = 0;  // lenses whose elemental image lies on the panel as a whole
};
std::int64_t geometric_fov_steps(const Subject&);
/// Throws Stopped.
GeometricFov geometric_fov(const Subject&, Job&);

}  // namespace lfdsim
