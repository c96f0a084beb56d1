// Scenes for other renderers as text and triangles: sizes, places, names from strangers, what is refused.
#include "base/constants.h"
#include "engine/scene/traced_display.h"
#include "examples.h"
#include "files/description/display_file.h"
#include "interchange/meshed/cell_sides.h"
#include "interchange/peers/cell.h"
#include "interchange/peers/peers.h"
#include "interchange/peers/ply.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstring>
#include <iterator>
#include <regex>
#include <sstream>

namespace lfdsim {
namespace {

using peers::MeshedArray;
using peers::Patch;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr Peer all_peers[] = {Peer::pov, Peer::cycles, Peer::mitsuba};

TEST(Scene, HasNoNumberThatIsNone) {
    for (const Peer peer : all_peers)
        for (const char* surround : {"opaque", "clear", "plate"}) {
            const std::string text = scene_text(peer, desktop({std::string("array.surround=\"") + surround + '"'}));
            for (const char* none : {"nan", "inf,", "inf>", "inf ", "null", "true", "false"})
                EXPECT_EQ(text.find(none), text.npos) << none << " in " << text;
        }
}

TEST(Scene, OfAHundredThousandLensesIsAsShort) {
    for (const Peer peer : all_peers) {
        const auto begun = std::chrono::steady_clock::now();
        const Display few = desktop(), many = desktop({"array.count=[400,250]", "camera.position_mm=[0.0,0.0,9000.0]"});
        const PeerScene a = peer_scene(peer, few, resolve(few), {}), b = peer_scene(peer, many, resolve(many), {});
        ASSERT_EQ(a.files.size(), b.files.size());
        for (std::size_t i = 0; i < a.files.size(); ++i)
            EXPECT_NEAR(double(b.files[i].bytes.size()), double(a.files[i].bytes.size()), 200) << a.files[i].name;
        EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(5));
    }
}

TEST(Scene, NamesFromOthersStayInTheirComment) {
    Display d = desktop();
    d.name = "x\n#declare Evil = 1;\r*/ \"\"\" ''' \\ \xc3\xa9 \x1b[31m";
    for (const Peer peer : all_peers) {
        std::istringstream lines(scene_text(peer, d));
        std::string line;
        std::getline(lines, line);
        EXPECT_THAT(line, HasSubstr("x?#declare Evil = 1;?*/"));
        for (const char c : line) EXPECT_TRUE(c >= 0x20 && c < 0x7f);
        while (std::getline(lines, line)) EXPECT_EQ(line.find("Evil"), line.npos);
    }
}

TEST(Scene, SaysWhatDeviatesInItsHead) {
    const Display exact = desktop({"render.fresnel=\"exact\"", "array.surround=\"plate\""});
    const PeerScene plate = peer_scene(Peer::pov, exact, resolve(exact), {});
    EXPECT_THAT(plate.deviations, ElementsAre(HasSubstr("render.fresnel")));
    EXPECT_THAT(plate.files.front().bytes, HasSubstr("// Deviates: render.fresnel"));
    EXPECT_EQ(plate.shown.render.fresnel, Fresnel::none);

    const Display opaque = desktop({"render.fresnel=\"exact\""});
    const PeerScene scene = peer_scene(Peer::pov, opaque, resolve(opaque), {});
    EXPECT_TRUE(scene.deviations.empty());
    EXPECT_EQ(scene.shown.render.fresnel, Fresnel::exact);
    EXPECT_THAT(scene.files.front().bytes, HasSubstr("fresnel on"));

    const Display schlick = desktop({"render.fresnel=\"schlick\""});
    EXPECT_EQ(peer_scene(Peer::pov, schlick, resolve(schlick), {}).shown.render.fresnel, Fresnel::none);
    EXPECT_EQ(peer_scene(Peer::cycles, schlick, resolve(schlick), {}).shown.render.fresnel, Fresnel::exact);
    EXPECT_EQ(peer_scene(Peer::mitsuba, schlick, resolve(schlick), {}).shown.render.fresnel, Fresnel::schlick);
}

TEST(Scene, SaysWhenPovRaysNumbersEnd) {
    const Display near = desktop({"camera.position_mm=[0.0,0.0,20000.0]"}),
                  far = desktop({"camera.position_mm=[0.0,0.0,999000.0]"}),
                  fine = desktop({"camera.position_mm=[0.0,0.0,999000.0]", "array.pitch_mm=0.1", "lens.aperture_radius_mm=0.04",
                                  "lens.sphere_radius_mm=0.06", "lens.cylinder_height_mm=0.02"});
    EXPECT_TRUE(peer_scene(Peer::pov, near, resolve(near), {}).deviations.empty());
    EXPECT_TRUE(peer_scene(Peer::pov, far, resolve(far), {}).deviations.empty());
    EXPECT_THAT(peer_scene(Peer::pov, fine, resolve(fine), {}).deviations, ElementsAre(HasSubstr("camera.position_mm")));
}

TEST(Scene, TracesNoRayFurtherThanTheModel) {
    EXPECT_THAT(scene_text(Peer::pov, desktop()), HasSubstr("max_trace_level 3 "));
    EXPECT_THAT(scene_text(Peer::pov, desktop({"array.surround=\"clear\""})), HasSubstr("max_trace_level 17 "));
    EXPECT_THAT(scene_text(Peer::cycles, desktop()), HasSubstr("\"hits\": 2,"));
    EXPECT_THAT(scene_text(Peer::mitsuba, desktop({"array.surround=\"plate\""})), HasSubstr("\"hits\": 16,"));
}

TEST(Scene, RefusesWhatItCannotShow) {
    const Display diffuse = read_display(LFDSIM_SOURCE_DIR "/displays/desktop-spherical.toml");
    EXPECT_THAT(refused_keys(Peer::pov, diffuse), ElementsAre("diffuser"));
    EXPECT_THAT(refused_keys(Peer::cycles, diffuse), ElementsAre());
    const Display gaussian = read_display(LFDSIM_SOURCE_DIR "/displays/desktop-spherical.toml", {"diffuser.profile=\"gaussian\""});
    EXPECT_THAT(refused_keys(Peer::cycles, gaussian), ElementsAre("diffuser.profile"));
    EXPECT_THAT(refused_keys(Peer::mitsuba, gaussian), ElementsAre());
    const Display ideal = read_display(LFDSIM_SOURCE_DIR "/displays/desktop-ideal.toml", {"diffuser=none"});
    for (const Peer peer : all_peers) {
        EXPECT_THAT(refused_keys(peer, ideal), ElementsAre("lens.type"));
        EXPECT_THAT(refused_keys(peer, desktop({"camera.pupil_diameter_mm=4.0"})), ElementsAre("camera.pupil_diameter_mm"));
        PeerOptions options;
        options.triangles = 99;
        EXPECT_THAT(refused_keys(peer, desktop(), options), ElementsAre("--triangles"));
        options.triangles = 4'000'001;
        EXPECT_THAT(refused_keys(peer, desktop(), options), ElementsAre("--triangles"));
        EXPECT_THROW(peer_scene(peer, desktop(), resolve(desktop()), options), InputError);
        for (const char* surround : {"clear", "plate"}) {  // triangles of square bodies: see docs/peers.md
            const Display square = desktop(
                {"array.aperture=\"cell\"", std::string("array.surround=\"") + surround + '"', "lens.sphere_radius_mm=9.0"});
            options.triangles = 1000;
            EXPECT_THAT(refused_keys(peer, square, options), ElementsAre("array.aperture"));
            EXPECT_EQ(refused_keys(peer, square).empty(), peer == Peer::pov);
        }
    }
    EXPECT_THAT(refused_keys(Peer::pov, desktop({"panel.emission_exponent=1.0", "camera.pixel_filter=\"box\""})),
                ElementsAre("camera.pixel_filter", "panel.emission_exponent"));
}

Display hexagons(const std::vector<std::string>& overrides = {}) {
    std::vector<std::string> all{"array.lattice=\"hexagon\"", "array.count=[5,4]"};
    all.insert(all.end(), overrides.begin(), overrides.end());
    return desktop(all);
}

Display on_plates(const std::vector<std::string>& overrides = {}) {
    std::vector<std::string> all{"panel.layer=[{thickness_mm=2.0,index=1.5},{thickness_mm=0.5,index=1.4}]"};
    all.insert(all.end(), overrides.begin(), overrides.end());
    return desktop(all);
}

TEST(Scene, OfStaggeredRowsHasTheirPlaces) {
    const Display d = hexagons();
    EXPECT_THAT(scene_text(Peer::pov, d), HasSubstr("(I - 2) * 12 + (mod(J + 2, 2) - 0.5) * 6"));
    EXPECT_THAT(scene_text(Peer::mitsuba, d), HasSubstr("\"staggered\":1"));
    EXPECT_THAT(scene_text(Peer::mitsuba, desktop()), HasSubstr("\"staggered\":0"));
    // As many as cover the panel, where no number is given
    const Display counted = desktop({"array.lattice=\"hexagon\"", "array.count=none"});
    const auto [columns, rows] = lens_count(counted.panel, counted.array);
    EXPECT_THAT(scene_text(Peer::pov, counted),
                HasSubstr("#for (J, 0, " + std::to_string(rows - 1) + ") #for (I, 0, " + std::to_string(columns - 1) + ")"));
}

TEST(Scene, OfStripsHasCylinders) {
    const Display d = desktop({"array.lattice=\"strips\"", "array.slant_deg=10.0", "array.count=none"});
    const std::string text = scene_text(Peer::pov, d);
    EXPECT_THAT(text, HasSubstr("cylinder"));
    EXPECT_EQ(text.find("sphere"), text.npos);
}

TEST(Scene, OfLayersCountsTheirHits) {
    EXPECT_THAT(scene_text(Peer::pov, on_plates()), HasSubstr("max_trace_level 5 "));
    EXPECT_THAT(scene_text(Peer::pov, on_plates({"array.surround=\"clear\""})), HasSubstr("max_trace_level 19 "));
    EXPECT_THAT(scene_text(Peer::cycles, on_plates()), HasSubstr("\"hits\": 4,"));
    // Glued on, the lens's face is the upper layer's.
    const std::vector<std::string> glue{"array.gap_mm=none", "array.base_z_mm=2.5"};
    EXPECT_THAT(scene_text(Peer::pov, on_plates(glue)), HasSubstr("max_trace_level 4 "));
    EXPECT_THAT(scene_text(Peer::mitsuba, on_plates(glue)), HasSubstr("\"hits\": 3,"));
    const Display clear = on_plates({"array.gap_mm=none", "array.base_z_mm=2.5", "array.surround=\"clear\""});
    EXPECT_THAT(scene_text(Peer::pov, clear), HasSubstr("max_trace_level 18 "));
}

TEST(Scene, SaysThatLayersAreTooThinForPovRay) {
    const Display thin = desktop({"panel.layer=[{thickness_mm=0.00005,index=1.5}]"});
    EXPECT_THAT(peer_scene(Peer::pov, thin, resolve(thin), {}).deviations, ElementsAre(HasSubstr("panel.layer.0.thickness_mm")));
    const Display thick = on_plates();
    EXPECT_TRUE(peer_scene(Peer::pov, thick, resolve(thick), {}).deviations.empty());
}

TEST(Scene, OfPinholesIsForPovRayAlone) {
    const std::vector<std::string> holes{"lens.type=\"pinhole\"", "lens.aperture_radius_mm=1.0", "lens.sphere_radius_mm=none",
                                         "lens.cylinder_height_mm=none", "lens.index=none"};
    const Display d = on_plates(holes);
    EXPECT_THAT(scene_text(Peer::pov, d), HasSubstr("max_trace_level 3 "));
    EXPECT_THAT(refused_keys(Peer::mitsuba, d), ElementsAre("lens.type"));
}

TEST(Scene, SaysThatLightIsCutOff) {
    const Display d = desktop();
    const PeerScene pov = peer_scene(Peer::pov, d, resolve(d), {}), cycles = peer_scene(Peer::cycles, d, resolve(d), {});
    Texels panel(2, 2);
    panel.data()[5] = 1;
    EXPECT_FALSE(panel_deviation(pov, panel));
    panel.data()[5] = 1.5;
    EXPECT_TRUE(panel_deviation(pov, panel));
    EXPECT_FALSE(panel_deviation(cycles, panel));
}

// The triangles of a cell.

double area_from_above(const Patch& patch) {
    double sum = 0;
    for (std::size_t t = 0; t < patch.count(); ++t) {
        const float* v[3];
        for (std::size_t i = 0; i < 3; ++i) v[i] = &patch.vertices_mm[3 * patch.triangles[3 * t + i]];
        sum += 0.5 * ((double(v[1][0]) - v[0][0]) * (double(v[2][1]) - v[0][1]) -
                      (double(v[2][0]) - v[0][0]) * (double(v[1][1]) - v[0][1]));
    }
    return sum;
}

const Patch* named(const std::vector<Patch>& list, std::string_view name) {
    for (const Patch& p : list)
        if (p.name == name) return &p;
    return nullptr;
}

TEST(Cell, OfAPlateIsCoveredOnce) {
    const Display d = desktop({"array.surround=\"plate\"", "lens.aperture_radius_mm=5.5"});
    const MeshedArray made = peers::mesh_array(d, resolve(d), 5000);
    const Patch *cap = named(made.cell, "surface-2"), *flat = named(made.cell, "flat-2");
    ASSERT_TRUE(cap && flat);
    // The cap's outline is a polygon in the circle; the flat part begins there and ends at the cell's border.
    EXPECT_NEAR(area_from_above(*cap) + area_from_above(*flat), 144, 1e-4);
    EXPECT_NEAR(area_from_above(*cap), M_PI * 5.5 * 5.5, 0.2);
    ASSERT_TRUE(named(made.sheet, "surface-1"));  // the flat face, common to all
    EXPECT_EQ(named(made.sheet, "surface-1")->count(), 1u);
    EXPECT_EQ(cap->index_front, 1);
    EXPECT_EQ(cap->index_back, 1.4918);
}

TEST(Cell, OfStaggeredRowsIsCoveredOnce) {
    const double cell = 12 * 12 * std::sqrt(0.75);
    for (const char* lattice : {"hexagon", "brick"}) {
        const Display d =
            hexagons({std::string("array.lattice=\"") + lattice + '"', "array.surround=\"plate\"", "lens.aperture_radius_mm=5.5"});
        const Geometry g = resolve(d);
        const MeshedArray made = peers::mesh_array(d, g, 5000);
        const Patch *cap = named(made.cell, "surface-2"), *flat = named(made.cell, "flat-2"),
                    *beside = named(made.sheet, "beside-2");
        ASSERT_TRUE(cap && flat && beside);
        const double one = d.array.lattice == LatticeKind::hexagon ? cell : 144;
        EXPECT_NEAR(area_from_above(*cap) + area_from_above(*flat), one, 1e-4) << lattice;
        // The cells and what lies beside them make up the whole sheet.
        const double half = sheet_half(g);
        EXPECT_NEAR(area_from_above(*beside) + 20 * one, 4 * half * half, 1e-6 * half * half) << lattice;
    }
}

// A pitch as built that is greater leaves corners beside a lens, which keeps its size; a smaller one cuts the lens.
TEST(Cell, OfAHexagonThatIsFilledEndsAtItsBorder) {
    const double r = 12 / std::sqrt(3);  // out to the corners of a cell as described
    std::ptrdiff_t flat_parts = 0;
    for (const double pitch : {10.8, 12., 13.2}) {
        const Display d = hexagons(
            {"array.aperture=\"cell\"", "lens.sphere_radius_mm=9.0", "errors.pitch_ppm=" + std::to_string(1e6 * (pitch / 12 - 1))});
        const MeshedArray made = peers::mesh_array(d, resolve(d), 50000);
        const Patch* cap = named(made.cell, "surface-2");
        ASSERT_TRUE(cap);
        // Six times a triangle and a sector of the disk about the lens
        const double out = pitch / 2, away = std::min(std::acos(out / r), pi / 6);
        const double area = 6 * (out * out * std::tan(away) + r * r * (pi / 6 - away));
        EXPECT_NEAR(area_from_above(*cap) / area, 1, 1e-4) << pitch;
        // In POV-Ray's scene the corners are black discs with a hole.
        const std::string text = scene_text(Peer::pov, d);
        const std::regex disc(R"(disc \{)");
        const auto discs = std::distance(std::sregex_iterator(text.begin(), text.end(), disc), std::sregex_iterator());
        EXPECT_EQ(discs > flat_parts, pitch != 12) << pitch;
        flat_parts = discs;
    }
}

TEST(Cell, OfAStripIsCoveredOnce) {
    const Display d =
        desktop({"array.lattice=\"strips\"", "array.count=none", "array.surround=\"plate\"", "lens.aperture_radius_mm=5.5"});
    const Geometry g = resolve(d);
    const MeshedArray made = peers::mesh_array(d, g, 1000);
    const Patch *cap = named(made.cell, "surface-2"), *flat = named(made.cell, "flat-2");
    ASSERT_TRUE(cap && flat);
    const double length = 2 * cell_half(g)[1];
    EXPECT_NEAR(area_from_above(*cap), 11 * length, 1e-6 * length);
    EXPECT_NEAR(area_from_above(*flat), length, 1e-6 * length);
    // A stop's slit
    const Display stopped =
        desktop({"array.lattice=\"strips\"", "array.count=none", "array.surround=\"plate\"", "lens.stop_radius_mm=2.0"});
    const Geometry of_stopped = resolve(stopped);
    const Patch black = *named(peers::mesh_array(stopped, of_stopped, 1000).cell, "black");
    EXPECT_NEAR(area_from_above(black) / (2 * cell_half(of_stopped)[1]), 12 - 4, 0.01);
}

TEST(Cell, HasFacesOfLayers) {
    const Display d = on_plates({"array.surround=\"plate\"", "array.gap_mm=none", "array.base_z_mm=2.5"});
    const MeshedArray made = peers::mesh_array(d, resolve(d), 1000);
    const Patch *face = named(made.sheet, "surface-1"), *lower = named(made.sheet, "layer-1");
    ASSERT_TRUE(face && lower);
    EXPECT_EQ(named(made.sheet, "layer-2"), nullptr);  // the lens's own face
    EXPECT_EQ(face->index_back, 1.4);
    EXPECT_TRUE(face->of_lens);
    EXPECT_EQ(lower->index_front, 1.4);
    EXPECT_EQ(lower->index_back, 1.5);
    EXPECT_FALSE(lower->of_lens);
    EXPECT_EQ(lower->vertices_mm[2], -0.5f);
    // Between bodies of glass that are glued on the layer borders on air.
    const Display clear =
        on_plates({"array.surround=\"clear\"", "array.gap_mm=none", "array.base_z_mm=2.5", "lens.aperture_radius_mm=5.5"});
    const MeshedArray bodies = peers::mesh_array(clear, resolve(clear), 5000);
    const Patch *under = named(bodies.cell, "surface-1"), *beside = named(bodies.cell, "layer-2");
    ASSERT_TRUE(under && beside && named(bodies.sheet, "layer-2-beside"));
    EXPECT_EQ(under->index_front, 1.4918);
    EXPECT_EQ(under->index_back, 1.4);
    EXPECT_EQ(beside->index_front, 1);
    EXPECT_NEAR(area_from_above(*under) + area_from_above(*beside), 144, 1e-4);
    // On the bare panel there is no face.
    const Display bare = desktop({"array.gap_mm=none", "array.base_z_mm=0.0"});
    EXPECT_EQ(named(peers::mesh_array(bare, resolve(bare), 1000).sheet, "surface-1"), nullptr);
}

TEST(Cell, OfAnOpaqueArrayIsBlackBesideTheLens) {
    const Display d = desktop({"lens.aperture_radius_mm=5.5"});
    const Geometry g = resolve(d);
    const MeshedArray made = peers::mesh_array(d, g, 5000);
    const Patch *cap = named(made.cell, "surface-2"), *black = named(made.cell, "black");
    ASSERT_TRUE(cap && black && black->black);
    // Two rings, at the rims of both surfaces, a little wider than the cell; walls are not seen from above.
    const double wider = 12.002 * 12.002;
    EXPECT_NEAR(area_from_above(*black), 2 * (wider - area_from_above(*cap)), 1e-3);
    ASSERT_TRUE(named(made.sheet, "black-beside"));
    EXPECT_GT(area_from_above(*named(made.sheet, "black-beside")), 1e6);
}

TEST(Cell, OfClearGlassIsClosed) {
    const Display d = desktop({"array.surround=\"clear\"", "array.pitch_mm=12.5"});
    const MeshedArray made = peers::mesh_array(d, resolve(d), 3386);
    ASSERT_EQ(made.cell.size(), 3u);
    EXPECT_TRUE(made.sheet.empty());
    double volume = 0;  // by the divergence theorem, glass behind every front
    for (const Patch& patch : made.cell) {
        EXPECT_EQ(patch.index_front, 1);
        EXPECT_EQ(patch.index_back, 1.4918);
        for (std::size_t t = 0; t < patch.count(); ++t) {
            const float *a = &patch.vertices_mm[3 * patch.triangles[3 * t]],
                        *b = &patch.vertices_mm[3 * patch.triangles[3 * t + 1]],
                        *c = &patch.vertices_mm[3 * patch.triangles[3 * t + 2]];
            volume += (a[0] * (double(b[1]) * c[2] - double(b[2]) * c[1]) + a[1] * (double(b[2]) * c[0] - double(b[0]) * c[2]) +
                       a[2] * (double(b[0]) * c[1] - double(b[1]) * c[0])) /
                      6;
        }
    }
    // a cylinder and the cap of a ball of R = 7.721 that is H high
    const double h = 7.721 - std::sqrt(7.721 * 7.721 - 36), exact = M_PI * (36 * 0.628 + h * h * (7.721 - h / 3));
    EXPECT_NEAR(volume / exact, 1, 0.01);
}

TEST(Cell, EveryMeshHoldsTogether) {
    for (const char* surround : {"opaque", "clear", "plate"})
        for (const char* facing : {"viewer", "panel"}) {
            const Display d = desktop({std::string("array.surround=\"") + surround + '"',
                                       std::string("lens.facing=\"") + facing + '"', "lens.stop_radius_mm=2.0"});
            const MeshedArray made = peers::mesh_array(d, resolve(d), 100);
            for (const auto* list : {&made.cell, &made.sheet})
                for (const Patch& patch : *list) {
                    ASSERT_EQ(patch.vertices_mm.size(), patch.normals.size());
                    for (const float x : patch.vertices_mm) ASSERT_TRUE(std::isfinite(x));
                    for (const float x : patch.normals) ASSERT_TRUE(std::isfinite(x));
                    for (const std::uint32_t v : patch.triangles) ASSERT_LT(3 * v, patch.vertices_mm.size());
                    for (std::size_t t = 0; !patch.black && t < patch.count(); ++t) {  // normals show where the triangle does
                        const std::uint32_t* v = &patch.triangles[3 * t];
                        const auto at = [&](int i, int k) { return double(patch.vertices_mm[3 * v[i] + k]); };
                        double n[3];
                        for (int k = 0; k < 3; ++k)
                            n[k] = (at(1, (k + 1) % 3) - at(0, (k + 1) % 3)) * (at(2, (k + 2) % 3) - at(0, (k + 2) % 3)) -
                                   (at(1, (k + 2) % 3) - at(0, (k + 2) % 3)) * (at(2, (k + 1) % 3) - at(0, (k + 1) % 3));
                        for (int i = 0; i < 3; ++i) {
                            const float* normal = &patch.normals[3 * v[i]];
                            ASSERT_GT(n[0] * normal[0] + n[1] * normal[1] + n[2] * normal[2], 0) << patch.name;
                        }
                    }
                }
        }
}

TEST(Ply, HoldsWhatItsHeadSays) {
    const Display d = desktop();
    for (const Patch& patch : peers::mesh_array(d, resolve(d), 1000).cell) {
        const std::string bytes = peers::ply(patch);
        const std::size_t head = bytes.find("end_header\n") + 11;
        EXPECT_EQ(bytes.size() - head, patch.vertices_mm.size() * 8 + patch.count() * 13);
        float first[6];
        std::memcpy(first, &bytes[head], sizeof first);
        EXPECT_EQ(first[2], patch.vertices_mm[2]);
        EXPECT_EQ(first[5], patch.normals[2]);
    }
}

}  // namespace
}  // namespace lfdsim
