// Measures on hexagons and strips against closed forms.
#include "analysis/crosstalk/crosstalk.h"
#include "analysis/fov/elemental_fov.h"
#include "base/constants.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lfdsim {
namespace {

/// Thin lenses that fill cells of pitch 2 mm before a panel of 240 mm, for an eye at 600 mm.
Display display(LatticeKind lattice, double gap_mm, double central_depth_mm, std::vector<Layer> layers = {}) {
    Display d;
    d.panel.pixels = {2390, 1200};
    d.panel.pixel_pitch_mm = 0.1;
    d.panel.layers = std::move(layers);
    d.lens.kind = IdealLens{{}, 1 / (1 / gap_mm + 1 / central_depth_mm)};
    d.array.lattice = lattice;
    d.array.pitch_mm = 2;
    d.array.gap_mm = gap_mm;
    d.array.aperture = Aperture::cell;
    d.camera.position_mm = {0, 0, 600};
    d.content.viewing_distance_mm = 600;
    return d;
}

TEST(Lattices, FieldOfViewIsThatOfTheExactRay) {
    Display steep = display(LatticeKind::strips, 2.6, 3000, {{1.5, 1.52}, {0.3, 1.6}}),
            gentle = display(LatticeKind::strips, 6, 200);
    steep.array.slant_deg = -27;
    gentle.array.slant_deg = 9.4623;
    const Display hexagons = display(LatticeKind::hexagon, 4, 150), covered = display(LatticeKind::hexagon, 3, 1e4, {{1.8, 1.5}});
    for (const Display& d : {steep, gentle, hexagons, covered}) {
        const Geometry g = resolve(d);
        const double exact = theory(d, g).along[0].fov_exact_deg;
        Job job;
        Parts parts(job, 2, own_range_parts, 1);
        const OwnRange found = where_own(OwnLens(d, false), arc(d, g, 600, 0), 0.05, 0, parts);
        EXPECT_NEAR(found.at[1] - found.at[0], exact, 0.5);
        EXPECT_LT(found.error[0], 0.06);
    }
}

// Images stay where the description has its lenses: their range moves by shift/g, however the lenses got there; images made for the
// lenses as built move with them.
TEST(Lattices, FieldOfViewIsOfTheImagesThatThePanelShows) {
    const Display described = display(LatticeKind::square, 4, 1e4);
    const auto middle_deg = [](const Display& d) {
        Job job;
        Parts parts(job, 2, own_range_parts, 1);
        const OwnRange found = where_own(OwnLens(d, false), arc(d, resolve(d), 600, 0), 0.05, 0, parts);
        return 0.5 * (found.at[0] + found.at[1]);
    };
    Display shifted = described, by_table = described;
    shifted.errors.shift_mm = {0.09, 0};
    const Lattice<double> lattice = resolve(described).lattice;
    std::vector<GivenLensError> all;
    for (std::int64_t j = 0; j < std::int64_t(lattice.count[1]); ++j)
        for (std::int64_t i = 0; i < std::int64_t(lattice.count[0]); ++i) {
            GivenLensError e;
            e.i = i, e.j = j;
            e.error.aside_mm = {0.09, 0};
            all.push_back(e);
        }
    by_table.errors.given = std::make_shared<const std::vector<GivenLensError>>(std::move(all));
    for (Display* d : {&shifted, &by_table}) {
        EXPECT_NEAR(middle_deg(*d), std::atan(0.09 / 4) / degree, 0.1);
        d->content.made_for = MadeFor::built;
        EXPECT_NEAR(middle_deg(*d), 0, 0.1);
    }
}

// An eye at the distance that images are made for sees one line of the panel through each strip, askew to the pixels by the slant.
// Pixels belong to the view that their centres are meant for, a pixel wide along the row: a pixel on the line is as far from it as
// the sum of two even spreads, a along the row and a tan(slant). It is at most a/2 with probability 1 - tan(slant)/4. Views of
// strips that lie flat are one above the other: rows and columns change places, and eyes side by side see the same.
TEST(Lattices, CrosstalkOfSlantedStripsIsTheViewsOverlap) {
    for (const double rotation : {0., -9.4623, 18.435, -30., 90., 80.5377}) {
        Display d = display(LatticeKind::strips, 5, 595);
        d.array.rotation_deg = rotation;
        Subject subject(d, {}, {});
        Job job;
        const Json all = measure_crosstalk(subject, job).figures, figures = all.at("between_views");
        const bool flat = rotation > 75;
        const double t = std::abs(std::tan((flat ? 90 - rotation : rotation) * degree)), overlap = 100 * t / (4 - t);
        EXPECT_NEAR(figures.at("woods_percent").get<double>(), overlap, 1) << rotation;
        EXPECT_NEAR(figures.at("theory_percent").get<double>(), overlap, 0.1) << rotation;
        if (flat) EXPECT_TRUE(all.at("between_eyes").at("left_eye_percent").is_null()) << rotation;
    }
}

}  // namespace
}  // namespace lfdsim
