// Figures from which the field of view is determined: likeness of views and photographs, and the geometric edges. Floor 3.
#pragma once
#include "analysis/fov/elemental_fov.h"
#include "analysis/fov/thresholds.h"
#include "content/content.h"
#include "engine/estimator/summed_panel.h"

namespace lfdsim {

/// Returns the edge by theory on the arc along one axis, degrees.
double theory_edge_deg(const Subject&, int axis);

/// Returns the width, degrees to either side of its edge, over which the field of view fades: by the lens aperture, the diffuser,
/// and the screen's size where images are made for another distance.
double fades_over_deg(const Subject&, int axis);

/// Returns fov_depth_mm(), or a smaller depth such that every eye is at least twice the scene's half diagonal away from its
/// centre.
double fov_scene_depth_mm(const Subject&, const std::vector<double>& angles_deg);

/// The scene, its elemental images and the white field, which all views share.
struct ShownEdge {
    ContentScene scene;
    const SummedPanel& panel;
    double white;  // Subject::white_field()
};

/// Curves over the angles along one axis: SSIM of screen and content, and the photograph's share in the view (covariance over
/// variance).
struct AngleCurves {
    Curve screen, content, share;
};

/// Compares views along one axis with photographs. Throws Stopped.
AngleCurves angle_curves(const Subject&, const ShownEdge&, int axis, const std::vector<double>& angles_deg, Job&);

/// The geometric edges along each imaging axis: on the arc, degrees, as light leaves the lenses and with the diffuser; and in the
/// plane at the eye's distance, mm.
struct GeometricFov {
    std::array<OwnRange, 2> lenses, diffused, eyebox;
    std::int64_t whole_images = 0;  // lenses whose whole elemental image lies on the panel
};
/// Returns about how long geometric_fov() takes, in pictures of the camera's size.
std::int64_t geometric_fov_steps(const Subject&);
/// Finds the edges by tracing lines of sight. Throws Stopped.
GeometricFov geometric_fov(const Subject&, Job&);

}  // namespace lfdsim
