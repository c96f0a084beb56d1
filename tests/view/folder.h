// A served folder of its own for each test, with a small display in it.
#pragma once
#include <gtest/gtest.h>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

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
    void SetUp() override {
        std::string name = (std::filesystem::temp_directory_path() / "lfdsim-view-XXXXXX").string();
        ASSERT_NE(mkdtemp(name.data()), nullptr);
        folder = name;
        std::ofstream(folder / "small.toml") << small_display;
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    std::filesystem::path folder;
};

}  // namespace lfdsim::view
