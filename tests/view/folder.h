// A served folder of its own for each test, with a small display in it.
#pragma once
#include <gtest/gtest.h>
#include <filesystem>
#include <string>

#include "../image/helpers.h"

namespace lfdsim::view {

inline const std::string small_display = R"(schema = 1
name = "small"
[panel]
pixels = [210, 150]
pixel_pitch_mm = 0.5
[lens]
type = "plano_convex"
sphere_radius_mm = 5
aperture_radius_mm = 2.9
cylinder_height_mm = 1
index = 1.49
[array]
count = [17, 13]
pitch_mm = 6
gap_mm = 11
[diffuser]
distance_mm = 60
angle_deg = [3, 3]
[camera]
position_mm = [0, 0, 600]
[content]
viewing_distance_mm = 600
)";

class FolderTest : public testing::Test {
  protected:
    void SetUp() override { lfdsim::test::save(folder / "small.toml", small_display); }

  private:
    const lfdsim::test::TemporaryFolder temporary_;

  protected:
    const std::filesystem::path folder = temporary_.path();
};

}  // namespace lfdsim::view
