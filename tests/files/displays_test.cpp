// The ready descriptions in displays/ are valid and what their names say.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "base/constants.h"
#include "files/description/display_file.h"
#include "geometry/geometry.h"

namespace lfdsim {
namespace {

const std::filesystem::path folder = LFDSIM_SOURCE_DIR "/displays";

TEST(Displays, AllAreValidAndNamedAsTheirFiles) {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        ASSERT_EQ(entry.path().extension(), ".toml");
        const Display d = read_display(entry.path());
        EXPECT_EQ(d.name, entry.path().stem());
        const Geometry g = resolve(d);
        const Theory t = theory(d, g);
        if (!d.name.starts_with("desktop-")) continue;
        EXPECT_NEAR(t.along[0].fov_deg, 40.0, 0.05) << d.name;
        EXPECT_NEAR(t.along[0].views, 88, 0.01) << d.name;
        // the content stands inside the published depth of field
        EXPECT_LT(std::abs(g.content_depth_mm - t.central_depth_mm) + g.content_height_mm.value() / 2, t.depth_of_field_mm / 2 + 8)
            << d.name;
        ++count;
    }
    EXPECT_GE(count, 8);
}

TEST(Displays, OfOtherLatticesAreWhatTheirCommentsSay) {
    const auto read = [](const char* name) { return read_display(folder / (std::string(name) + ".toml")); };
    const Display tablet = read("tablet-lenticular"), hexagon = read("hexagon"), barrier = read("barrier");
    const Geometry g = resolve(tablet);
    EXPECT_TRUE(g.glued);
    EXPECT_NEAR(g.gap_mm, 1.343, 1e-3);
    EXPECT_NEAR(g.focal_length_mm, g.gap_mm, 1e-3);
    const Theory t = theory(tablet, g);
    EXPECT_NEAR(t.along[0].elemental_pitch_mm / g.lattice.cos_turn / tablet.panel.pixel_pitch_mm, 8, 1e-3);
    EXPECT_NEAR(t.along[0].fov_deg, 27, 0.1);
    EXPECT_NEAR(std::tan(*tablet.array.slant_deg * degree), 1. / 3, 1e-5);
    EXPECT_NEAR(theory(hexagon, resolve(hexagon)).along[0].fov_deg, 25, 0.01);
    EXPECT_NEAR(theory(hexagon, resolve(hexagon)).central_depth_mm, 120, 0.1);
    ASSERT_TRUE(hexagon.diffuser);
    EXPECT_NEAR(hexagon.diffuser->angle_deg[0] * degree, std::atan(hexagon.panel.pixel_pitch_mm / 4.0596), 1e-4);
    const Theory slits = theory(barrier, resolve(barrier));
    EXPECT_NEAR(slits.along[0].elemental_pitch_mm / barrier.panel.pixel_pitch_mm, 2, 1e-3);
    EXPECT_NEAR(barrier.panel.pixel_pitch_mm / slits.gap_mm * 350, 62, 0.1);
}

TEST(Displays, DiffusersOfTheThreeCloseTheirGaps) {
    for (const char* name : {"desktop-stopped", "desktop-ideal", "desktop-asphere"}) {
        const Display d = read_display(folder / (std::string(name) + ".toml"));
        const Theory t = theory(d, resolve(d));
        ASSERT_TRUE(d.diffuser) << name;
        EXPECT_NEAR(d.diffuser->distance_mm, t.central_depth_mm, 0.5) << name;
        EXPECT_NEAR(d.diffuser->angle_deg[0], t.along[0].gap_closing_diffuser_deg, 0.01) << name;
        EXPECT_EQ(d.diffuser->angle_deg[0], d.diffuser->angle_deg[1]) << name;
    }
}

TEST(Displays, SphericalStandsInForTheAsphere) {
    const Display a = read_display(folder / "desktop-asphere.toml"), s = read_display(folder / "desktop-spherical.toml");
    const Geometry ga = resolve(a), gs = resolve(s);
    EXPECT_NEAR(ga.focal_length_mm, gs.focal_length_mm, 1e-3);
    EXPECT_NEAR(ga.top_z_mm - ga.base_z_mm, gs.top_z_mm - gs.base_z_mm, 1e-3);
    EXPECT_EQ(ga.clear_aperture_mm[0], gs.clear_aperture_mm[0]);
}

}  // namespace
}  // namespace lfdsim
