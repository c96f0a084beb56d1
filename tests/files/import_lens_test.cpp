// Lenses of lens design programs in displays: published focal lengths, places, orders, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>

#include "base/constants.h"
#include "display/colour.h"
#include "files/description/display_file.h"
#include "files/lenses/import_lens.h"
#include "geometry/prescription.h"
#include "published_lenses.h"

namespace lfdsim {
namespace {

using testing::Contains;
using testing::HasSubstr;

// What the Heliar's E-LLF6 is: no glass that ships.
const GlassChoice ellf6{"E-LLF6", {}, Glass{"", Formula::nd_vd, {1.53172, 48.84}}};

Imported imported(const std::string& zmx, ImportRequest request = {}) {
    if (zmx.find(ellf6.name) != zmx.npos) request.glasses.push_back(ellf6);
    return import_lens(parse_zmx(zmx, "lens.zmx"), request);
}

std::string import_refused(const std::string& zmx, const ImportRequest& request = {}) {
    try {
        import_lens(parse_zmx(zmx, "lens.zmx"), request);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

std::string changed(std::string text, const std::string& old, const std::string& replacement) {
    const std::size_t at = text.find(old);
    EXPECT_NE(at, text.npos) << old;
    return text.replace(at, old.size(), replacement);
}

// Where a ray that comes down parallel to the axis, at height x, meets the panel: Snell's law at the surfaces' true sags.
double landing(const Geometry& g, double x) {
    double z = g.top_z_mm + 1, dx = 0, dz = -1;
    for (std::size_t i = g.surfaces.size(); i-- > 0;) {
        const PlacedSurface& s = g.surfaces[i];
        const auto height = [&](double at) { return s.z_mm + sag_mm(s.curvature_per_mm, s.conic, s.even_asphere, std::abs(at)); };
        double t = (s.z_mm - z) / dz;
        for (int k = 0; k < 50; ++k) t += (height(x + t * dx) - (z + t * dz)) / dz;
        x += t * dx, z += t * dz;
        const double step = 1e-6, slope = (height(x + step) - height(x - step)) / (2 * step);
        const double length = std::hypot(slope, 1.0), nx = -slope / length, nz = 1 / length;  // against the ray
        const double eta = s.index_above / s.index_below, c = -(nx * dx + nz * dz);
        const double k = eta * c - std::sqrt(1 - eta * eta * (1 - c * c));
        dx = eta * dx + k * nx, dz = eta * dz + k * nz;
    }
    return x - z / dz * dx;
}

TEST(ImportLens, HasThePublishedFocalLengths) {
    const struct {
        std::string zmx;
        double focal_length_mm;
    } lenses[] = {{published::tessar, 101.6},
                  {published::heliar, 10},
                  {published::triplet, 50},
                  {published::achromat, 100.1},
                  {published::hyperboloid, 10}};
    for (const auto& lens : lenses)
        for (const bool flip : {false, true})
            for (const double size : {1.0, 0.05}) {
                ImportRequest request;
                request.flip = flip;
                request.scale = size;
                const Display d = imported(lens.zmx, request).display;
                const double f = size * lens.focal_length_mm;
                EXPECT_NEAR(resolve(d, d_line_nm).focal_length_mm, f, 1e-3 * f);
                // a real ray near the axis of light from infinity crosses it in the focal plane
                if (flip) continue;
                const Geometry g = resolve(d, d_line_nm);
                const double near = 1e-3 * f, down = landing(g, near) / near;  // 0 on the panel, if that is the focal plane
                EXPECT_NEAR(down * f, g.focal_length_mm - g.gap_mm, 2e-5 * f + std::abs(g.gap_mm - f) * 1e-2);
            }
}

// At any height: the surface is exact.
TEST(ImportLens, BringsAParallelBeamToOnePointByAHyperboloid) {
    ImportRequest request;
    request.scale = 0.1;
    const Geometry g = resolve(imported(published::hyperboloid, request).display);
    EXPECT_NEAR(g.surfaces.front().z_mm, 1, 1e-12);  // the panel is in the file's image plane
    for (const double x : {0.01, 0.1, 0.2, 0.3, 0.39}) EXPECT_NEAR(landing(g, x), 0, 1e-9);
}

TEST(ImportLens, TurnsTheLensRoundAndOver) {
    const std::vector<Surface> normal = imported(published::achromat).display.lens.as<SurfaceLens>().surfaces;
    ImportRequest request;
    request.flip = true;
    const Imported over = imported(published::achromat, request);
    const std::vector<Surface> flipped = over.display.lens.as<SurfaceLens>().surfaces;
    ASSERT_EQ(normal.size(), 3u);
    ASSERT_EQ(flipped.size(), 3u);
    EXPECT_NEAR(normal[0].curvature_per_mm, 1 / 128.2, 1e-12);  // bulges to the panel
    EXPECT_NEAR(normal[2].curvature_per_mm, -1 / 62.8, 1e-12);
    EXPECT_NEAR(normal[0].distance_mm, 2.5, 1e-12);
    EXPECT_NEAR(normal[1].distance_mm, 4, 1e-12);
    EXPECT_EQ(normal[0].glass->coefficients, (std::vector<double>{1.6727, 32.21}));
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(flipped[i].curvature_per_mm, -normal[2 - i].curvature_per_mm);
    EXPECT_EQ(flipped[0].glass, normal[1].glass);
    EXPECT_EQ(flipped[0].distance_mm, normal[1].distance_mm);
    const Geometry g = resolve(over.display);
    EXPECT_EQ(g.gap_mm, g.focal_length_mm);  // the object is at infinity
    EXPECT_THAT(over.notes, Contains(HasSubstr("object is at infinity")));
}

TEST(ImportLens, PutsThePanelWhereTheImageIs) {
    const Geometry g = resolve(imported(published::achromat).display);
    EXPECT_NEAR(g.surfaces.front().z_mm, 97.1, 1e-9);
    ImportRequest request;
    request.gap_mm = 80;
    request.pitch_mm = 30;
    const Display d = imported(published::achromat, request).display;
    EXPECT_EQ(resolve(d).gap_mm, 80);
    EXPECT_EQ(d.array.pitch_mm[0], 30);
}

// A stop between the lenses is a surface without glass; a plane that does nothing is left out, and its space remains.
TEST(ImportLens, KeepsStopsAndLeavesOutMerePlanes) {
    const Imported tessar = imported(published::tessar);
    const std::vector<Surface>& surfaces = tessar.display.lens.as<SurfaceLens>().surfaces;
    ASSERT_EQ(surfaces.size(), 8u);
    EXPECT_EQ(surfaces[3].curvature_per_mm, 0);
    EXPECT_FALSE(surfaces[3].index || surfaces[3].glass);
    EXPECT_THAT(tessar.surfaces[3], HasSubstr("surface 5, the stop"));
    const Imported without = imported(
        changed(changed(changed(published::tessar, "  STOP\n", ""), "SURF 1\n", "SURF 1\n  STOP\n"), "YFLN 0 10 20.5", "YFLN 5"));
    const std::vector<Surface>& rest = without.display.lens.as<SurfaceLens>().surfaces;
    ASSERT_EQ(rest.size(), 7u);
    EXPECT_DOUBLE_EQ(rest[2].distance_mm, surfaces[2].distance_mm + surfaces[3].distance_mm);
    EXPECT_THAT(without.notes, Contains(HasSubstr("neither refract nor stop light: surfaces 5")));
}

// The rim's ray of the beam along the axis is f/2N from the axis on the first surface; a chief ray of the field adds its own
// height. On the stop it has none.
TEST(ImportLens, GivesSurfacesTheApertureOfTheBeam) {
    const auto lens = [](const std::string& field) {
        return "FNUM 5 0\nFTYP 0\nYFLN 0 " + field +
               "\nUNIT MM\nSURF 0\n  CURV 0\n  DISZ INFINITY\nSURF 1\n  STOP\n  CURV 0\n  DISZ 7\nSURF 2\n  CURV 0.02\n  DISZ 5\n"
               "  GLAS M 1 0 1.5 0\nSURF 3\n  CURV 0\n  DISZ 96\nSURF 4\n  CURV 0\n  DISZ 0\n";
    };
    const double rim = 100 / (2 * 5.0);
    for (const double field : {0.0, 6.0}) {
        const Display d = imported(lens(std::to_string(field))).display;
        const std::vector<Surface>& surfaces = d.lens.as<SurfaceLens>().surfaces;  // the panel's side first
        const double slope = std::tan(field * std::acos(-1.0) / 180), bent = (slope - 0.02 * 0.5 * 7 * slope) / 1.5;
        EXPECT_DOUBLE_EQ(surfaces[2].semi_aperture_mm, rim);
        EXPECT_NEAR(surfaces[1].semi_aperture_mm, rim + 7 * slope, 1e-12);
        EXPECT_NEAR(surfaces[0].semi_aperture_mm, rim * (1 - 5 * 0.02 * 0.5 / 1.5) + 7 * slope + 5 * bent, 1e-12);
        EXPECT_DOUBLE_EQ(d.array.pitch_mm[0], 2 * std::max(surfaces[1].semi_aperture_mm, surfaces[0].semi_aperture_mm));
    }
}

// A beam from an object at 40 mm to a stop of radius 2 behind the lens, stated in each way that files have. The lens is a
// plano-convex one; rays are traced here from the object.
TEST(ImportLens, GivesSurfacesTheApertureOfABeamFromAnObjectNearby) {
    struct Ray {
        double first, second, stop, slope;  // heights on the surfaces, slope at the image
    };
    const auto traced = [](double y, double slope) {
        const double first = y + 40 * slope, within = (slope - 0.02 * 0.5 * first) / 1.5, second = first + 5 * within;
        return Ray{first, second, second + 6 * 1.5 * within, 1.5 * within};
    };
    // The marginal ray has the height 2 on the stop. Chief rays have 0 there: of object points at 3 mm from the axis, the slope
    // before the lens is -3 stop(1, 0)/stop(0, 1), and the entrance pupil is where they cross the axis.
    const double steep = traced(0, 1).stop, marginal_slope = 2 / steep, chief_slope = -3 * traced(1, 0).stop / steep;
    const Ray marginal = traced(0, marginal_slope), chief = traced(3, chief_slope);
    const double pupil_diameter = 2 * marginal_slope * (3 / -chief_slope);
    const auto lens = [](const std::string& beam, const std::string& of_stop = "") {
        return beam +
               "UNIT MM\nSURF 0\n  CURV 0\n  DISZ 40\nSURF 1\n  CURV 0.02\n  DISZ 5\n  GLAS M 1 0 1.5 0\nSURF 2\n  CURV 0\n" +
               "  DISZ 6\nSURF 3\n  STOP\n  CURV 0\n  DISZ 90\n" + of_stop + "SURF 4\n  CURV 0\n  DISZ 0\n";
    };
    const std::string heights = "FTYP 1 0 2 1\nXFLN 0 1.8 0\nYFLN 0 -2.4 9\n";
    const std::string angle = fmt::format("FTYP 0\nYFLN {}\n", std::atan(chief_slope) / degree);
    const std::string pupil = fmt::format("ENPD {}\n", pupil_diameter);
    for (const std::string& zmx : {lens(pupil + heights), lens(pupil + angle), lens(heights, "  DIAM 2\n"),
                                   lens(angle, "  CLAP 0 2 0\n"), lens(fmt::format("FNUM {} 0\n", 100 / pupil_diameter) + heights),
                                   lens(fmt::format("FNUM {} 1\n", 1 / (2 * std::abs(marginal.slope))) + heights)}) {
        const Display d = imported(zmx).display;
        const std::vector<Surface>& surfaces = d.lens.as<SurfaceLens>().surfaces;  // the panel's side first
        EXPECT_NEAR(surfaces[0].semi_aperture_mm, 2, 1e-12) << zmx;
        EXPECT_NEAR(surfaces[1].semi_aperture_mm, std::abs(marginal.second) + std::abs(chief.second), 1e-12) << zmx;
        EXPECT_NEAR(surfaces[2].semi_aperture_mm, std::abs(marginal.first) + std::abs(chief.first), 1e-12) << zmx;
    }
    // A beam of which something is missing, which is said
    EXPECT_THAT(import_refused(lens(heights)), HasSubstr("surfaces 1, 2, 3, and of a beam from which they would follow no entrance "
                                                         "pupil, f-number or size of the stop is known"));
    for (const std::string& zmx : {lens(pupil), lens(pupil + "FTYP 2\nYFLN 3\n"), lens(pupil + "FTYP 1 1\nYFLN 3\n"),
                                   changed(lens(pupil + heights), "DISZ 40", "DISZ INFINITY")})
        EXPECT_THAT(import_refused(zmx),
                    HasSubstr("no field as angles, or as heights of an object at a finite distance, is known"));
    EXPECT_THAT(import_refused(changed(lens(pupil + heights), "  STOP\n", "")), HasSubstr("no stop is known"));
}

TEST(ImportLens, IsReadBackAsItWasWritten) {
    for (const std::string& zmx :
         {published::tessar, published::heliar, published::triplet, published::achromat, published::hyperboloid})
        for (const double distance : {100.0, 600.0}) {
            ImportRequest request;
            request.scale = 0.05;
            request.distance_mm = distance;
            Imported made = imported(zmx, request);
            made.display.name = "a \"name\"\nof two lines";
            const std::string text = write_imported(made, {}, "lfdsim import 'x\n[panel].zmx'");
            EXPECT_EQ(parse_display(text, "text"), made.display) << text;
            for (const std::string& note : made.notes) EXPECT_THAT(text, HasSubstr("# - " + note.substr(0, 40)));
        }
}

TEST(ImportLens, SaysWhatCannotBe) {
    using namespace published;
    EXPECT_THAT(import_refused(heliar), HasSubstr("lens.zmx:12: surface 2: no catalogue has a glass \"E-LLF6\""));
    EXPECT_THAT(import_refused(heliar), HasSubstr("--glass E-LLF6=OTHER"));
    ImportRequest other;
    other.glasses.push_back(ellf6);
    EXPECT_THAT(import_refused(tessar, other), HasSubstr("--glass: the lens has no glass E-LLF6"));
    EXPECT_THAT(import_refused(changed(tessar, "DISZ INFINITY", "DISZ INFINITY\n  GLAS F2")), HasSubstr("surface 0: has no air"));
    EXPECT_THAT(import_refused(changed(tessar, "DISZ 3.4025", "DISZ 3.4025\n  GLAS F2")),
                HasSubstr("surface 8: has no air behind it"));
    EXPECT_THAT(import_refused(changed(tessar, "DISZ 0.0709", "DISZ -0.0709")), HasSubstr("surface 4: the next surface is -1.8"));
    EXPECT_THAT(import_refused(changed(tessar, "DISZ 0.0709", "DISZ INFINITY")), HasSubstr("lens.zmx"));
    EXPECT_THAT(import_refused(changed(tessar, "CURV 0.824878", "CURV 1e300")), HasSubstr("lens.zmx"));
    EXPECT_THAT(import_refused(changed(tessar, "CURV 0.824878", "CURV 5\n  DIAM 1")),
                HasSubstr("surface 4: lens.surface.4.semi_aperture_mm"));
    EXPECT_THAT(import_refused(changed(achromat, "1.6727", "50")), HasSubstr("surface 2: lens.surface.0.glass"));
    EXPECT_THAT(import_refused(changed(achromat, "9.71", "-1")), HasSubstr("--gap-mm, --pitch-mm and --scale change that"));
    EXPECT_THAT(import_refused("SURF 0\n  CURV 0\n  DISZ 1\nSURF 1\n  CURV 1\n  DISZ 1\nSURF 2\n  CURV 0\n  DISZ 0\n"),
                HasSubstr("there is no lens"));
    EXPECT_THAT(import_refused(changed(tessar, "FNUM 4.5 0\n", "")),
                HasSubstr("no semi-aperture is given for surfaces 1, 2, 3, 4"));
    ImportRequest request;
    request.semi_aperture_mm = 5;
    EXPECT_EQ(import_refused(changed(tessar, "FNUM 4.5 0\n", ""), request), "");
    request.pitch_mm = 9;
    EXPECT_THAT(import_refused(achromat, request), HasSubstr("wider than array.pitch_mm = 9 mm"));
}

TEST(ImportLens, RefusesMoreSurfacesThanALensHas) {
    std::string zmx = "UNIT MM\nSURF 0\n  CURV 0\n  DISZ INFINITY\n";
    for (int i = 1; i <= 18; ++i)
        zmx += "SURF " + std::to_string(i) + "\n  CURV 0\n  DISZ 1\n  DIAM 2\n" + (i % 2 ? "  GLAS N-BK7\n" : "");
    EXPECT_THAT(import_refused(zmx + "SURF 19\n  CURV 0\n  DISZ 0\n"), HasSubstr("the lens has 18 surfaces, allowed are 16"));
}

}  // namespace
}  // namespace lfdsim
