// The axes of a camera. Floor 0.
#pragma once
#include "base/vec.h"
#include "display/display.h"

namespace lfdsim {

/// Orthogonal unit vectors: along the line of sight, and to the right and upwards in the picture.
struct CameraAxes {
    Vec3d forward, right, up;
    double distance_mm;  // from the camera to its target
};

inline CameraAxes camera_axes(const Camera& camera) {
    const Vec3d sight = minus(camera.target_mm, camera.position_mm), forward = normalised(sight);
    const Vec3d right = normalised(cross(forward, camera.up));
    return {forward, right, cross(right, forward), length(sight)};
}

}  // namespace lfdsim
