// A small display and models written on the spot, for the tests of content.
#pragma once
#include "../sanitizers.h"
#include "content/content.h"
#include "display/display.h"
#include "geometry/geometry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace small_world {

using namespace lfdsim;
namespace fs = std::filesystem;

/// 12 x 8 ideal lenses of 4 mm pitch and 20 x 20 pixels each, 10 mm before the panel; elemental images straight behind them.
inline Display display() {
    Display d;
    d.panel.pixels = {240, 160};
    d.panel.pixel_pitch_mm = 0.2;
    d.lens.kind = IdealLens{2, 9.5};
    d.array.count = {12, 8};
    d.array.pitch_mm = 4;
    d.array.gap_mm = 10;
    d.content.depth_mm = 0;
    d.content.height_mm = 20;
    d.content.viewing_distance_mm = std::numeric_limits<double>::infinity();
    d.camera.position_mm = {0, 0, 500};
    d.camera.frame_width_mm = 48;
    d.camera.resolution = {240, 160};
    return d;
}

/// A folder of this test's own, removed at the end.
class Folder {
  public:
    Folder() {
        std::string name = (fs::temp_directory_path() / "lfdsim-content-XXXXXX").string();
        if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
        path_ = name;
    }
    ~Folder() { fs::remove_all(path_); }
    Folder(const Folder&) = delete;

    fs::path write(const std::string& name, const std::string& bytes) const {
        fs::create_directories((path_ / name).parent_path());
        std::ofstream(path_ / name, std::ios::binary) << bytes;
        return path_ / name;
    }
    const fs::path& path() const { return path_; }

  private:
    fs::path path_;
};

/// A rectangle across the z axis that faces +z, in one of the colours "red", "green", "blue", "white".
struct Patch {
    double x0, x1, y0, y1, z;
    std::string colour;
};

inline fs::path write_patches(const Folder& folder, const std::vector<Patch>& patches) {
    folder.write("patches.mtl", "newmtl red\nKd 1 0 0\nnewmtl green\nKd 0 1 0\nnewmtl blue\nKd 0 0 1\nnewmtl white\nKd 1 1 1\n");
    std::ostringstream obj;
    obj << "mtllib patches.mtl\no patches\n";
    int vertex = 1;
    for (const Patch& p : patches) {
        for (const auto& [x, y] : {std::pair(p.x0, p.y0), {p.x1, p.y0}, {p.x1, p.y1}, {p.x0, p.y1}})
            obj << "v " << x << " " << y << " " << p.z << "\n";
        obj << "usemtl " << p.colour << "\nf";
        for (int k = 0; k < 4; ++k) obj << " " << vertex++;
        obj << "\n";
    }
    return folder.write("patches.obj", obj.str());
}

/// The reader's memory is not limited under AddressSanitizer.
inline constexpr bool memory_is_limited = !address_sanitizer;

/// What a white surface that faces +z reflects: ambient 0.2 and 0.8 times the cosine to the light from (0.3, 0.5, 0.81).
inline constexpr double facing_light = 0.2 + 0.8 * 0.81 / 0.9980480950;

}  // namespace small_world
