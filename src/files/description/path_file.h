// Camera paths (JSON) in: docs/path.md. Floor 2.
#pragma once
#include "base/input_error.h"
#include "display/display.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lfdsim {

/// A position of the camera at one time, in the display's frame.
struct CameraPose {
    double time_s = 0;
    Vec3d position_mm{};
    std::optional<Vec3d> target_mm;  // absent: that of the description
};

/// The position of a camera over time, interpolated linearly from pose to pose.
struct CameraPath {
    double frames_per_second = 30;
    std::vector<CameraPose> poses;  // at least one; times rise strictly from 0

    /// Returns the number of frames: frame k = 0, 1, ... is at the time k / frames_per_second, up to the last pose.
    std::int64_t frames() const;
    /// Returns the time of a frame, at most that of the last pose.
    double time_s(std::int64_t frame) const;
    /// Returns the camera of a description, moved to its pose in a frame.
    Camera camera(std::int64_t frame, Camera described) const;
};

inline constexpr std::int64_t most_path_frames = 100'000;

/// Reads a path: at most 1 MiB of JSON and most_path_frames frames. Throws InputError that names the file and the place in it
/// ("poses[3].time_s"). Whether a display's camera can stand there is not checked.
CameraPath read_path(const std::filesystem::path&);

/// Reads a camera path from text; `name` is the file's name in messages.
CameraPath parse_path(std::string_view text, std::string_view name);

}  // namespace lfdsim
