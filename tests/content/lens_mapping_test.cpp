// One lens's table of where its light goes, against direct tracing, Snell's law written out, and the display's symmetries.
#include "content/lens_mapping.h"
#include "content/pickup.h"
#include "engine/lens_trace.h"
#include "model/glass.h"
#include "model/numbers.h"
#include "small_world.h"

#include <random>

namespace {

using namespace small_world;

struct Named {
    const char* name;
    Display display;
};

Display asphere() {  // desktop-asphere's lens over smaller pixels
    Display d = display();
    d.panel.pixel_pitch_mm = 0.1;
    d.array.pitch_mm = 12;
    d.array.count = {4, 3};
    d.array.gap_mm = 16.485;
    Surface flat, bent;
    flat.semi_aperture_mm = bent.semi_aperture_mm = 6;
    flat.distance_mm = 3.49;
    flat.index = 1.4918;
    bent.curvature_per_mm = -0.129517;
    bent.conic = -0.3635;
    bent.even_asphere = {4.972e-5, 1.2486e-6};
    d.lens.kind = SurfaceLens{{flat, bent}};
    return d;
}

Display sphere(Surround surround, Facing facing = Facing::viewer) {
    Display d = display();
    d.lens.kind = PlanoConvex{5.1, 1.9, 0.6, 1.52, facing};
    d.array.surround = surround;
    return d;
}

std::vector<Named> lenses() {
    std::vector<Named> all{{"asphere", asphere()},
                           {"sphere", sphere(Surround::opaque)},
                           {"facing the panel", sphere(Surround::opaque, Facing::panel)},
                           {"plate", sphere(Surround::plate)}};
    Display d = sphere(Surround::opaque);
    d.lens.stop_radius_mm = 1.1;
    all.push_back({"stopped", d});
    d = sphere(Surround::plate);
    d.array.aperture = Aperture::cell;
    d.lens.as<PlanoConvex>().aperture_radius_mm.reset();
    d.array.rotation_deg = 17;
    d.content.viewing_distance_mm = 300;
    all.push_back({"cells, turned, for 300 mm", d});
    d.array.lattice = LatticeKind::hexagon;
    all.push_back({"hexagons", d});
    d = asphere();
    d.panel.layers = {Layer{1.1, 1.52}, Layer{0.4, 1.47}};
    all.push_back({"under glass", d});
    return all;
}

/// The mean line by an even lattice of 400 x 400 points of the principal planes, less the nodal line.
std::array<double, 4> direct(const LensTrace& lens, const Geometry& g, Point u, double radius) {
    constexpr int across = 500;
    std::array<double, 4> sum{};
    double rays = 0;
    for (int j = 0; j < across; ++j)
        for (int i = 0; i < across; ++i) {
            const Point at{((2 * i + 1.) / across - 1) * radius, ((2 * j + 1.) / across - 1) * radius};
            const auto ray = lens.ray(u, lens.towards(u, at));
            if (!ray) continue;
            const double line[] = {ray->x, ray->y, ray->mx + u[0] / g.gap_mm, ray->my + u[1] / g.gap_mm};
            for (std::size_t k = 0; k < 4; ++k) sum[k] += line[k];
            ++rays;
        }
    for (double& value : sum) value /= rays;
    return sum;
}

// Everywhere under the lens the table gives the mean of many more rays: in slope to 3 % of the largest shift, or 1/50 of what a
// panel pixel subtends, in place to 1/500 of the pitch.
TEST(LensMapping, TableHoldsTheMeanOfAllRays) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> even(-1, 1);
    for (const auto& [name, d] : lenses()) {
        const Geometry g = resolve(d);
        const LensTrace lens(d, g);
        const LensMapping map(d, g, d.panel.wavelengths_nm[1], 0, 1);
        const double pixel = d.panel.pixel_pitch_mm;
        double worst_slope = 0, worst_place = 0, largest = 0;
        for (int n = 0; n < 12; ++n) {
            const Point u{even(random) * 0.5 * d.array.pitch_mm[0], even(random) * 0.5 * d.array.pitch_mm[0]};
            LineShift line;
            if (!map.shift(-1, u[0], u[1], line)) continue;
            const auto truth = direct(lens, g, u, 1.0 * d.array.pitch_mm[0]);
            if (std::isnan(truth[0])) continue;  // between nodes of which some have light
            worst_place = std::max({worst_place, std::abs(double(line.x) - truth[0]), std::abs(double(line.y) - truth[1])});
            worst_slope = std::max({worst_slope, std::abs(double(line.mx) - truth[2]), std::abs(double(line.my) - truth[3])});
            largest = std::max({largest, std::abs(truth[2]), std::abs(truth[3])});
        }
        EXPECT_LT(worst_slope * g.gap_mm, std::max(0.03 * largest * g.gap_mm, 0.02 * pixel)) << name;
        EXPECT_LT(worst_place, 0.002 * d.array.pitch_mm[0]) << name;
        EXPECT_GT(largest * g.gap_mm, 0.03 * pixel) << name << " has aberrations";
        std::printf("%-28s slope within %.4f, place within %.4f pixels; shifts up to %.2f pixels\n", name,
                    worst_slope * g.gap_mm / pixel, worst_place / pixel, largest * g.gap_mm / pixel);
    }
}

// A cylinder's rays in the plane across it, by Snell's law alone: a flat base at z = gap_base, sag R - sqrt(R^2 - x^2) from the
// top of the ridge. Rays by equal steps across the principal plane, as the mapping counts them.
TEST(LensMapping, StripsAgreeWithSnellsLawAcrossThem) {
    const double R = 2.6, h = 0.6, n = 1.52, half = 2, base = 4;
    Display d = sphere(Surround::plate);
    d.lens.as<PlanoConvex>().aperture_radius_mm.reset();
    d.lens.as<PlanoConvex>().sphere_radius_mm = R;
    d.array.lattice = LatticeKind::strips;
    d.array.aperture = Aperture::cell;
    d.array.count.reset();
    d.array.slant_deg = 14;
    d.array.gap_mm.reset();
    d.array.base_z_mm = base;
    const Geometry g = resolve(d);
    const LensMapping map(d, g, 550, 0, 1);
    EXPECT_EQ(map.nodes()[1], 1);
    const double edge = R - std::sqrt(R * R - half * half), top = base + h + edge;  // of the ridge
    // h is the height of the sheet under the rim; paraxially the principal plane of the ridge is its vertex, and the gap is
    // reduced.
    ASSERT_NEAR(g.rear_principal_mm, top, 1e-9);
    ASSERT_NEAR(g.gap_mm, base + (h + edge) / n, 1e-9);
    double largest = 0;
    for (const double u : {-2., -1.3, -0.4, 0., 0.7, 1.6, 2.}) {
        constexpr int rays = 100000;
        double sum_x = 0, sum_m = 0, count = 0;
        for (int i = 0; i < rays; ++i) {
            const double at = ((2 * i + 1.) / rays - 1) * 1.4 * half;  // of the paraxial ray in the principal plane
            const double slope = (at - u) / g.gap_mm, s = slope / std::sqrt(1 + slope * slope);  // in air, where n = 1
            const double x0 = u + base * slope, in = s / n, t = in / std::sqrt(1 - in * in);     // within the sheet
            // Where x = x0 + t (z - base) meets x^2 + (z - centre)^2 = R^2, above.
            const double centre = top - R, z_of = base - centre, a = 1 + t * t, b = x0 * t + z_of,
                         c = x0 * x0 + z_of * z_of - R * R;
            const double root = b * b - a * c;
            if (root < 0) continue;
            const double rise = (-b + std::sqrt(root)) / a, x = x0 + t * rise, z = base + rise;
            if (std::abs(x) > half) continue;
            const double normal = std::asin(x / R), incidence = std::atan(t) - normal, sine = n * std::sin(incidence);
            if (std::abs(sine) >= 1) continue;
            const double m = std::tan(std::asin(sine) + normal);
            sum_x += x + m * (g.rear_principal_mm - z);
            sum_m += m + u / g.gap_mm;
            ++count;
        }
        LineShift line;
        ASSERT_TRUE(map.shift(-1, u, 0, line)) << u;
        EXPECT_NEAR(line.x, sum_x / count, 1e-3) << u;
        EXPECT_NEAR(line.mx, sum_m / count, 2e-4) << u;
        largest = std::max(largest, std::abs(sum_m / count));
    }
    EXPECT_GT(largest, 0.01);
}

// Each colour's mapping is that of a lens whose constant index is the glass's there, its gap and planes those of green light.
TEST(LensMapping, ColoursHaveTheirOwnIndex) {
    Display d = sphere(Surround::opaque), constant = d;
    PlanoConvex& lens = d.lens.as<PlanoConvex>();
    lens.index.reset();
    lens.glass = Glass{"", Formula::conrady, {1.5, 0.01, 0.0035}};
    for (Display* const each : {&d, &constant}) each->array.gap_mm.reset(), each->array.base_z_mm = 8;
    d.content.pickup = PickupKind::traced;
    const Geometry g = resolve(d);
    const std::vector<LensMapping> maps = lens_mappings(d, g, 1);
    ASSERT_EQ(maps.size(), 3u);
    std::array<LineShift, 3> line;
    for (std::size_t c = 0; c < 3; ++c) {
        constant.lens.as<PlanoConvex>().index = index_of(*lens.glass, d.panel.wavelengths_nm[c]);
        const LensMapping same(constant, g, 550, 0, 1);
        LineShift expected;
        for (const double x : {0., 0.3, 0.8, 1.7}) {
            ASSERT_TRUE(maps[c].shift(-1, x, 0.3, line[c]) && same.shift(-1, x, 0.3, expected));
            EXPECT_FLOAT_EQ(line[c].x, expected.x);
            EXPECT_FLOAT_EQ(line[c].mx, expected.mx);
            EXPECT_FLOAT_EQ(line[c].my, expected.my);
        }
    }
    EXPECT_GT(std::abs(line[0].mx - line[1].mx), 5e-5);
    EXPECT_LT((line[0].mx - line[1].mx) * (line[2].mx - line[1].mx), 0) << "green lies between red and blue";
}

// Points that no light of gets through are dark, all others are lit.
TEST(LensMapping, TellsWhichPointsAreDark) {
    Display d = sphere(Surround::opaque);
    d.lens.stop_radius_mm = 0.5;
    d.array.gap_mm = 5;
    const Geometry g = resolve(d);
    const LensTrace lens(d, g);
    const LensMapping map(d, g, 550, 0, 1);
    int dark = 0, lit = 0;
    for (double x = 0; x < 2.05; x += 0.02) {
        LineShift line;
        const bool is_lit = map.shift(-1, x, x, line), has_rays = lens.directions({x, x}).has_value();
        const double step = 2 * map.reach_mm()[0] / (map.nodes()[0] - 1);
        const bool near_border = lens.directions({x + 2 * step, x + 2 * step}).has_value() !=
                                 lens.directions({std::max(x - 2 * step, 0.), std::max(x - 2 * step, 0.)}).has_value();
        if (near_border) continue;
        EXPECT_EQ(is_lit, has_rays) << x;
        ++(is_lit ? lit : dark);
    }
    EXPECT_GT(lit, 20);
    EXPECT_GE(dark, 0);
}

}  // namespace
