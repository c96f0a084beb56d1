// The axes of a camera. Floor 0.
#pragma once
#include "display/display.h"
#include "geometry/vec.h"

namespace lfdsim {

/// A camera's axes in the display's frame.
struct CameraAxes {
    Vec3d forward, right, up;  // orthogonal unit vectors: along the line of sight, to the right and upwards in the picture
    double distance_mm;        // from the camera to its target
};

/// Returns the axes of a valid camera: right = forward x up of the description, and the picture's up = right x forward
/// (docs/model.md, "Camera").
inline CameraAxes camera_axes(const Camera& camera) {
    const Vec3d sight = minus(camera.target_mm, camera.position_mm), forward = normalised(sight);
    const Vec3d right = normalised(cross(forward, camera.up));
    return {forward, right, cross(right, forward), length(sight)};
}

}  // namespace lfdsim
