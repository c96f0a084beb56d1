#include "view/answers/probe.h"

#include <gmock/gmock.h>
#include <cmath>
#include <numbers>

#include "analysis/core/eye_rays.h"
#include "engine/render.h"
#include "files/description/display_file.h"
#include "folder.h"

namespace lfdsim::view {
namespace {
using testing::HasSubstr;

Display small(const std::vector<std::string>& set) {
    std::vector<std::string> all{"camera.resolution=[160, 90]"};
    all.insert(all.end(), set.begin(), set.end());
    return parse_display(small_display, "small", all);
}

// The renderer itself as a judge: where one panel pixel alone shines, the probed place is bright, and dark where it alone is black.
TEST(Probe, NamesThePixelThatShinesThere) {
    const std::vector<std::string> cases[] = {
        {"diffuser=none"},
        {"diffuser=none", "camera.position_mm=[60, -30, 580]"},
        {"diffuser=none", "array.rotation_deg=20", "array.offset_mm=[3, -7]", "camera.position_mm=[-50, 20, 600]"},
        {"diffuser=none", "camera.up=[1, 1, 0]", "camera.target_mm=[5, 5, 0]", "array.surround=clear"},
    };
    for (const auto& set : cases) {
        const Display d = small(set);
        const Geometry g = resolve(d);
        Job job;
        int probed = 0;
        for (const auto& [column, row] :
             {std::pair{80, 45}, {60, 30}, {100, 31}, {52, 64}, {95, 70}, {79, 20}, {66, 47}, {90, 52}}) {
            const Probe found = probe(d, {(column + 0.5) / 160, (row + 0.5) / 90});
            Texels dark(210, 150), bright(210, 150);
            for (std::int64_t y = 0; y < 150; ++y)
                for (std::int64_t x = 0; x < 210; ++x) bright.row(y)[4 * x + 1] = 1;
            if (found.panel_pixel) {
                const auto [x, y] = *found.panel_pixel;
                dark.row(y)[4 * x + 1] = 1;
                bright.row(y)[4 * x + 1] = 0;
                ++probed;
            }
            const float with_it = render(d, g, dark, {}, job).image.at(column, row)[1];
            const float without = render(d, g, bright, {}, job).image.at(column, row)[1];
            EXPECT_EQ(with_it > 0, found.panel_pixel.has_value()) << column << " " << row << " " << found.says;
            EXPECT_EQ(without, 0) << column << " " << row << " " << found.says;
        }
        EXPECT_GE(probed, 4);
    }
}

TEST(Probe, CountsLensesFromTheUpperLeft) {
    const Display d = small({"camera.frame_width_mm=102", "camera.resolution=[17, 13]", "camera.position_mm=[0, 0, 100000]"});
    const Probe first = probe(d, {0.5 / 17, 0.5 / 13}), middle = probe(d, {0.5, 0.5}), last = probe(d, {16.5 / 17, 12.5 / 13});
    EXPECT_EQ(first.lens, (std::array<std::int64_t, 2>{0, 0}));
    EXPECT_EQ(middle.lens, (std::array<std::int64_t, 2>{8, 6}));
    EXPECT_EQ(last.lens, (std::array<std::int64_t, 2>{16, 12}));
    EXPECT_THAT(middle.says, HasSubstr("Lens 8, 6 shows panel pixel 105, 75, on its axis; with the diffuser, "));
    EXPECT_NEAR((*first.panel_mm)[0], -48, 1);
    EXPECT_NEAR((*first.panel_mm)[1], 36, 1);
}

TEST(Probe, SaysWhereNothingIsSeen) {
    const Display d = small({"camera.frame_width_mm=500"});
    EXPECT_FALSE(probe(d, {0, 0}).lens);
    EXPECT_THAT(probe(d, {0, 0}).says, HasSubstr("No lens transmits light of the panel here"));
    const Probe up = probe(small({"camera.target_mm=[0, 1000, 600]", "camera.up=[0, 0, 1]"}), {0.5, 0.5});
    EXPECT_TRUE(up.fan.empty());
    EXPECT_THAT(up.says, HasSubstr("does not reach the display"));
}

// In the plane x = 0 of the middle column's axes the drawn rays are the traced ones.
TEST(Probe, DrawsTheTracedRays) {
    for (const char* lens : {"array.surround=opaque", "diffuser=none", "array.aperture=cell"}) {
        const Display d = small({lens, "camera.position_mm=[0, 40, 600]"});
        const Geometry g = resolve(d);
        const EyeRays rays(d, g);
        int compared = 0;
        for (const double row : {20.5, 33.5, 44.5, 51.5, 63.5}) {
            const Probe found = probe(d, {0.5, row / 90});
            ASSERT_EQ(found.fan.size(), d.diffuser ? 5u : 1u);
            for (std::size_t k = 0; k < found.fan.size(); ++k) {
                const auto& line = found.fan[k];
                EXPECT_EQ(line.front(), (std::array<double, 2>{40, 600}));
                // the second point lies on the way down: the diffuser, or the lens
                const Vec3d to{0, line[1][0] - 40, line[1][1] - 600};
                const double length = std::hypot(to[1], to[2]), b = d.diffuser ? 1 - 0.5 * double(k) : 0;
                // drawn from the one turned most to the eye's lower side; a positive turn about x takes a falling ray towards +y
                const Sight sight = rays.look_along(d.camera.position_mm, {0, to[1] / length, to[2] / length}, 0, b);
                const bool arrives = line.back()[1] == 0;
                EXPECT_EQ(sight.through, arrives) << lens << " " << row << " " << k;
                if (!sight.through || !arrives) continue;
                EXPECT_NEAR(sight.x, 0, 1e-9);
                EXPECT_NEAR(sight.y, line.back()[0], 1e-6) << lens << " " << row << " " << k;
                ++compared;
            }
            if (d.diffuser) {
                EXPECT_NEAR(found.fan[0][1][1], *g.diffuser_z_mm, 1e-12);
            }
        }
        EXPECT_GE(compared, 3) << lens;
    }
}

}  // namespace
}  // namespace lfdsim::view
