// Scenes of arrays with errors: what is refused, where lenses stand, what lies level.
#include "examples.h"
#include "geometry/lens_misalignment.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lfdsim {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(SceneOfErrors, OfSingleLensesAreForPovRayAlone) {
    const std::vector<std::string> kinds{"errors.decenter_sd_mm=0.02", "errors.height_sd_mm=0.02", "errors.tilt_sd_deg=0.1",
                                         "errors.curvature_sd=0.01", "errors.bow_mm=0.05"};
    for (const std::string& kind : kinds) {
        const Display d = desktop({kind});
        EXPECT_THAT(refused_keys(Peer::pov, d), ElementsAre()) << kind;
        EXPECT_THAT(refused_keys(Peer::cycles, d), ElementsAre("errors")) << kind;
        EXPECT_THAT(refused_keys(Peer::mitsuba, d), ElementsAre("errors")) << kind;
        PeerOptions meshed;
        meshed.triangles = 1000;
        EXPECT_THAT(refused_keys(Peer::pov, d, meshed), ElementsAre("--triangles")) << kind;
    }
}

TEST(SceneOfErrors, ThatLeaveNoPlaceForABlackSheetAreRefused) {
    EXPECT_THAT(refused_keys(Peer::pov, desktop({"errors.height_sd_mm=0.5", "array.count=[30,30]"})), ElementsAre("errors"));
    EXPECT_THAT(refused_keys(Peer::pov, desktop({"errors.bow_mm=3.0", "array.count=[6,4]"})), ElementsAre("errors"));
    EXPECT_THAT(refused_keys(Peer::pov, desktop({"errors.bow_mm=3.0", "array.count=[6,4]", "array.surround=\"plate\""})),
                ElementsAre());
    EXPECT_THAT(refused_keys(Peer::pov, desktop({"errors.height_sd_mm=0.01", "lens.stop_radius_mm=2.0"})),
                ElementsAre("lens.stop_radius_mm"));
    EXPECT_THAT(refused_keys(Peer::pov, desktop({"errors.decenter_sd_mm=0.01", "lens.stop_radius_mm=2.0"})), ElementsAre());
}

TEST(SceneOfErrors, OfTooManyLensesAreRefused) {
    EXPECT_THAT(refused_keys(Peer::pov, desktop({"errors.decenter_sd_mm=0.01", "array.count=[201,100]"})), ElementsAre("errors"));
    EXPECT_THAT(refused_keys(Peer::pov, desktop({"errors.rotation_deg=0.5", "array.count=[201,100]"})), ElementsAre());
}

TEST(SceneOfErrors, PutEachLensInItsPlace) {
    const Display d = desktop({"array.count=[2,1]", "errors.bow_mm=0.0", "errors.decenter_sd_mm=0.02", "errors.seed=3"});
    const Geometry g = resolve(d);
    const std::string text = scene_text(Peer::pov, d);
    for (std::size_t k = 0; k < 2; ++k) {
        const LensError e = lens_errors(d, g.lattice)[k];
        EXPECT_THAT(text, HasSubstr(fmt::format("translate <{},{},0>", (double(k) - 0.5) * 12 + e.aside_mm[0], e.aside_mm[1])));
    }
    for (const char* none : {"nan", "inf,", "inf>", "inf "}) EXPECT_EQ(text.find(none), text.npos);
    EXPECT_THAT(text, HasSubstr("max_trace_level 19 "));
}

TEST(SceneOfErrors, SayWhereLensesOverlap) {
    const Display apart = desktop({"errors.decenter_sd_mm=0.01", "array.pitch_mm=12.5"}),
                  filled = desktop({"errors.decenter_sd_mm=0.01", "array.aperture=\"cell\"", "lens.sphere_radius_mm=9.0"});
    EXPECT_TRUE(peer_scene(Peer::pov, apart, resolve(apart), {}).deviations.empty());
    EXPECT_THAT(peer_scene(Peer::pov, filled, resolve(filled), {}).deviations,
                testing::Contains(HasSubstr("where lenses overlap")));
}

TEST(SceneOfErrors, OfAWedgeLeaveThePanelsLayersLevel) {
    const Display d = desktop({"panel.layer=[{thickness_mm=2.0,index=1.5}]", "errors.wedge_deg=[1.0,-2.0]"});
    for (const Peer peer : {Peer::cycles, Peer::mitsuba}) {
        const std::string text = scene_text(peer, d);
        EXPECT_THAT(text, HasSubstr("\"layer-1.ply\",\"black\":0,\"front\":1.0,\"back\":1.5,\"leans\":0"));
        EXPECT_THAT(text, HasSubstr("\"surface-1.ply\",\"black\":0,\"front\":1.4918,\"back\":1.0,\"leans\":1"));
        EXPECT_THAT(text, HasSubstr("\"turn\":[[0.9993908"));
    }
}

}  // namespace
}  // namespace lfdsim
