// One lens's table of where its light goes, against direct tracing, Snell's law written out, and the display's symmetries.
#include "content/pickup/lens_mapping.h"
#include "base/constants.h"
#include "content/pickup/pickup.h"
#include "display/glass.h"
#include "engine/views/lens_trace.h"
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

/// Where the rays of a panel point pass the central depth plane, less the nodal line's place, in slope: by an even lattice of
/// 128 x 128 points of the principal planes.
std::vector<Point> places(const LensTrace& lens, const Geometry& g, Point u, double radius) {
    constexpr int across = 128;
    const double vergence = 1 / g.focal_length_mm - 1 / g.gap_mm;
    std::vector<Point> all;
    for (int j = 0; j < across; ++j)
        for (int i = 0; i < across; ++i) {
            const Point at{((2 * i + 1.) / across - 1) * radius, ((2 * j + 1.) / across - 1) * radius};
            if (const auto ray = lens.ray(u, lens.towards(u, at)))
                all.push_back({ray->mx + u[0] / g.gap_mm + ray->x * vergence, ray->my + u[1] / g.gap_mm + ray->y * vergence});
        }
    return all;
}

/// How many rays pass close to a place: 1 for one there, 0 for one at the radius.
double light_near(const std::vector<Point>& rays, Point at, double radius) {
    double sum = 0;
    for (const Point& ray : rays) {
        const double d2 = ((ray[0] - at[0]) * (ray[0] - at[0]) + (ray[1] - at[1]) * (ray[1] - at[1])) / (radius * radius);
        if (d2 < 1) sum += (1 - d2) * (1 - d2) * (1 - d2);
    }
    return sum;
}

// Everywhere under the lens, no line has more light about it than the table's: none of those that pass the central depth plane
// anywhere where rays do, 1 % excepted. And the table goes without jumps.
TEST(LensMapping, MostLightTravelsOnTheTablesLine) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> even(-1, 1);
    for (const auto& [name, d] : lenses()) {
        const Geometry g = resolve(d);
        const LensTrace lens(d, g);
        const LensMapping map(d, g, d.panel.wavelengths_nm[1], 0, 1);
        const double pixel = d.panel.pixel_pitch_mm / g.gap_mm, vergence = 1 / g.focal_length_mm - 1 / g.gap_mm;
        double least_share = 1, largest = 0, gain = 1;
        for (int n = 0; n < 5; ++n) {
            const Point u{even(random) * 0.5 * d.array.pitch_mm[0], even(random) * 0.5 * d.array.pitch_mm[0]};
            const std::vector<Point> rays = places(lens, g, u, d.array.pitch_mm[0]);
            LineShift line;
            if (rays.size() < 100 || !map.shift(-1, u[0], u[1], line)) continue;
            const Point found{double(line.mx) + double(line.x) * vergence, double(line.my) + double(line.y) * vergence};
            Point mean{};
            for (const Point& ray : rays)
                for (std::size_t k = 0; k < 2; ++k) mean[k] += ray[k] / double(rays.size());
            double square = 0;
            for (const Point& ray : rays)
                square += std::pow(std::hypot(ray[0] - mean[0], ray[1] - mean[1]), 2) / double(rays.size());
            const double window = std::max(2.5 * pixel, std::sqrt(square) / 2), of_table = light_near(rays, found, window);
            double most = of_table;
            for (std::size_t k = 0; k < rays.size(); k += 97) most = std::max(most, light_near(rays, rays[k], window));
            least_share = std::min(least_share, of_table / most);
            largest = std::max(largest, std::hypot(found[0], found[1]));
            gain = std::max(gain, of_table / light_near(rays, {0, 0}, window));
        }
        EXPECT_GT(least_share, 0.99) << name;
        EXPECT_GT(largest, 0.01 * pixel) << name << " has aberrations";
        std::printf("%-28s %.4f of the most light; up to %.2f times the nodal line's; shifts up to %.2f pixels\n", name,
                    least_share, gain, largest / pixel);
    }
}

// A cylinder's rays in the plane across it, by Snell's law alone: a flat base at z = base, sag R - sqrt(R^2 - x^2) from the top of
// the ridge. Rays by equal steps across the principal plane, as the mapping counts them.
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
        std::vector<std::array<double, 2>> lines;  // x, m less the nodal line's
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
            lines.push_back({x + m * (g.rear_principal_mm - z), m + u / g.gap_mm});
        }
        // The line on which most of them travel, by trying all places of the central depth plane.
        const double vergence = 1 / g.focal_length_mm - 1 / g.gap_mm, window = 2.5 * d.panel.pixel_pitch_mm / g.gap_mm;
        const auto near = [&](double at, std::array<double, 2>* mean) {
            double sum = 0, weights = 0;
            if (mean) *mean = {};
            for (const auto& [x, m] : lines) {
                const double off = 1 - std::pow((m + x * vergence - at) / window, 2);
                if (off <= 0) continue;
                sum += off * off * off;
                weights += off * off;
                if (mean) (*mean)[0] += off * off * x, (*mean)[1] += off * off * m;
            }
            if (mean) (*mean)[0] /= weights, (*mean)[1] /= weights;
            return sum;
        };
        double most = 0, best = 0;
        for (double at = -0.1; at < 0.1; at += 2e-4)
            if (const double light = near(at, nullptr); light > most) most = light, best = at;
        std::array<double, 2> mean;
        near(best, &mean);
        LineShift line;
        ASSERT_TRUE(map.shift(-1, u, 0, line)) << u;
        EXPECT_NEAR(double(line.x) * vergence + double(line.mx), mean[0] * vergence + mean[1], 3e-4) << u;
        EXPECT_NEAR(line.x, mean[0], 2e-2) << u;
        largest = std::max(largest, std::abs(mean[1]));
    }
    EXPECT_GT(largest, 0.005);
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
    EXPECT_GT(std::abs(line[0].mx - line[1].mx), 1e-5);
    EXPECT_GT(std::abs(line[2].mx - line[1].mx), 1e-5);
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
