// What a region's picture is made of: filtered light where it agrees with points, else points.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "pictures.h"

namespace lfdsim {
namespace {

/// Displays whose default pictures are filtered light, points, and some of both.
std::vector<Display> displays() {
    std::vector<Display> all;
    for (const auto& [name, display] : diffused())
        for (const double frame_mm : {8., 40.}) {
            all.push_back(display);
            all.back().render.samples.reset();
            all.back().camera.resolution = {48, 32};
            all.back().camera.frame_width_mm = frame_mm;
        }
    all[0].camera.resolution = {300, 264};  // two regions, and parts of others
    all[2].render.samples = 4;
    return all;
}

TEST(Choice, KeepsItsBits) {
    Bits bits;
    double error = 0, points_share = 0;
    for (const Display& d : displays()) {
        for (const std::optional<double> target : {std::optional<double>(), std::optional(0.05)}) {
            if (target && d.camera.resolution[0] > 48) continue;
            Job job;
            RenderOptions options{1, "", {}};
            options.target_error = target;
            const Rendering made = render(d, resolve(d), patterned_panel(d), options, job);
            bits.add(made.image);
            error += made.measured_error.value_or(0);
            points_share += made.points_share;
        }
    }
    EXPECT_EQ(fmt::format("{:016x} {:.9g} {:.9g}", bits.hash(), points_share, error), "4c7fcc989b6d2bd4 50 0.614940018");
}

}  // namespace
}  // namespace lfdsim
