// Rays forward through one lens, against the backward tracer, closed forms and widths from another program.
#include "analysis/spots/ray_fan.h"

#include "base/constants.h"
#include "engine/scene/traced_display.h"
#include "lenses.h"
#include "optics/trace.h"

#include <gtest/gtest.h>
#include <cmath>
#include <random>

namespace lfdsim {
namespace {

using namespace lens_examples;

constexpr double from_75[] = {-75, 0, 75};

/// The display's own tracer, in double precision and with this lens alone.
class Backward {
  public:
    Backward(const Display& d, const Geometry& g)
        : scene_(make_traced_display<double>(d, g)),
          pixel_(d.panel.pixel_pitch_mm),
          start_(g.entrance_z_mm - g.rear_principal_mm) {}

    /// Where it brings a ray that comes back to the panel.
    std::optional<Point> panel(const LensRay& ray) const {
        const double length = std::hypot(ray.mx, ray.my, 1);
        const optics::Ray<double> start{{ray.x + ray.mx * start_, ray.y + ray.my * start_, 0},
                                        {-ray.mx / length, -ray.my / length, -1 / length}};
        return optics::with_facts(scene_, [&]<optics::Facts facts>() { return end<facts>(start); });
    }

  private:
    template <optics::Facts facts>
    std::optional<Point> end(const optics::Ray<double>& start) const {
        const auto point =
            optics::trace_array<facts>(scene_, optics::Extent<double>{0, 0, 0, 0}, optics::PanelBase<double>{}, start, true);
        if (!point.alive) return {};
        return Point{point.column * pixel_, -point.row * pixel_};
    }
    optics::TracedDisplay<double> scene_;
    double pixel_, start_;
};

// A thousandth of the rays may be lost at the very rims, where rounding decides; plates are open beside the caps too.
TEST(LensTrace, RaysGoBackTheWayTheyCame) {
    for (const auto& [name, d] : all_lenses()) {
        const Geometry g = resolve(d);
        const LensTrace lens(d, g);
        const Backward backward(d, g);
        std::mt19937_64 random(7);
        std::uniform_real_distribution<double> within(0, 1);
        int through = 0, returned = 0;
        for (int n = 0; n < 40; ++n) {
            const Point panel{(within(random) - 0.5) * d.array.pitch_mm[0], (within(random) - 0.5) * d.array.pitch_mm[0]};
            const auto box = lens.directions(panel);
            ASSERT_TRUE(box) << name;
            for (int k = 0; k < 100; ++k) {
                const auto ray = lens.ray(
                    panel, {box->x0 + (box->x1 - box->x0) * within(random), box->y0 + (box->y1 - box->y0) * within(random)});
                if (!ray) continue;
                ++through;
                const auto end = backward.panel(*ray);
                if (!end) continue;
                ++returned;
                EXPECT_NEAR((*end)[0], panel[0], 1e-9) << name;
                EXPECT_NEAR((*end)[1], panel[1], 1e-9) << name;
            }
        }
        EXPECT_GT(through, 1000) << name;
        EXPECT_GE(returned, 0.999 * through) << name;
    }
}

// The other sense: a ray that the tracer brings down to the panel gets up again. Its direction there by the tracer for a panel
// moved by a small step: the same lens a little higher.
TEST(LensTrace, WhatComesDownGoesUp) {
    for (const auto& [name, d] : all_lenses()) {
        if (d.array.surround != Surround::opaque) continue;  // light through walls is another matter
        constexpr double step = 1e-3;
        Display raised = d;
        const Geometry g = resolve(d);
        raised.array.gap_mm.reset();
        raised.array.base_z_mm = g.base_z_mm + step;
        const LensTrace lens(d, g);
        const Backward backward(d, g), from_higher(raised, resolve(raised));
        std::mt19937_64 random(8);
        std::uniform_real_distribution<double> place(-0.5 * d.array.pitch_mm[0], 0.5 * d.array.pitch_mm[0]), slope(-0.3, 0.3);
        int down = 0, up = 0;
        for (int n = 0; n < 4000; ++n) {
            const LensRay ray{place(random), place(random), slope(random), slope(random)};
            const auto a = backward.panel(ray), b = from_higher.panel(ray);
            if (!a || !b) continue;
            ++down;
            const double mx = ((*a)[0] - (*b)[0]) / step, my = ((*a)[1] - (*b)[1]) / step, length = std::hypot(mx, my, 1);
            const auto again = lens.ray(*a, {mx / length, my / length});
            if (!again) continue;
            ++up;
            EXPECT_NEAR(again->x, ray.x, 1e-6) << name;
            EXPECT_NEAR(again->my, ray.my, 1e-6) << name;
        }
        EXPECT_GT(down, 100) << name;
        EXPECT_GE(up, 0.998 * down) << name;
    }
}

// Widths by another program, for planes 75 mm before, at and beyond a depth from the vertex plane, which is the principal plane
// here.
TEST(LensTrace, WidthsOfTheReadyDisplays) {
    struct Case {
        const char* name;
        double depth, widths[3];
    };
    for (const Case& c : {Case{"desktop-stopped", 145, {1.108, 0.187, 1.483}}, Case{"desktop-asphere", 329.9, {2.60, 0.41, 3.21}},
                          Case{"desktop-spherical", 329.9, {85.8, 114.3, 142.8}}}) {
        const Display d = shipped(c.name);
        const Fans f = fans(LensTrace(d, resolve(d)), {0, 0}, 1001);
        for (int k = 0; k < 3; ++k) {
            EXPECT_NEAR(width_at(f.meridional, c.depth + from_75[k]).mm / c.widths[k], 1, 0.01) << c.name << " " << k;
            EXPECT_NEAR(width_at(f.sagittal, c.depth + from_75[k]).mm / c.widths[k], 1, 0.01) << c.name << " " << k;
        }
    }
}

TEST(LensTrace, IdealLensHasTheParaxialSpot) {
    for (const Display& d : {ideal(12, 16.485, 15.7, 88), ideal(1, 2, 2.5, 40), ideal(30, 40, 40, 30)}) {
        const Geometry g = resolve(d);
        const LensTrace lens(d, g);
        const double p = d.array.pitch_mm[0], L = theory(d, g).central_depth_mm;
        for (const Point panel : {Point{0, 0}, Point{0.25 * p, 0}, Point{0, 0.5 * p}}) {
            const Fans f = fans(lens, panel, 101);
            for (const double z : {-50., 10., 0.5 * std::min(L, 1e3), 300.}) {
                const double width = std::isinf(L) ? p : p * std::abs(z / L - 1);
                EXPECT_NEAR(width_at(f.meridional, z).mm, width, 1e-9 * (p + std::abs(z))) << z;
                EXPECT_NEAR(width_at(f.sagittal, z).mm, width, 1e-9 * (p + std::abs(z))) << z;
            }
        }
    }
}

// Light of a Lambertian point through a round hole at the tangent r/g: pi sin^2; and the mean square of tan over equal areas of
// sin.
TEST(LensTrace, BundlesAreOfEqualLight) {
    Display d = ideal(12, 10, 9, 88);
    d.array.aperture = Aperture::circle;
    d.lens.as<IdealLens>().aperture_radius_mm = 6;
    const Bundle light = bundle(LensTrace(d, resolve(d)), {0, 0}, 300);
    const double tan2 = 0.36, sin2 = tan2 / (1 + tan2);
    EXPECT_NEAR(light.light / (pi * sin2), 1, 2e-3);
    double sum = 0;
    for (const LensRay& r : light.rays) sum += r.x * r.x + r.y * r.y;
    EXPECT_NEAR(sum / double(light.rays.size()) / (100 * (-1 - std::log(1 - sin2) / sin2)), 1, 2e-3);
}

// However small the stop: fans end at its rim, in the plane of the apex, which is the principal plane.
TEST(LensTrace, FindsTheLightOfSmallStops) {
    for (const double radius : {3., 0.1, 1e-3, 1e-5}) {
        Display d = shipped("desktop-stopped");
        d.lens.stop_radius_mm = radius;
        const LensTrace lens(d, resolve(d));
        EXPECT_NEAR(width_at(fans(lens, {0, 0}, 101).meridional, 0).mm / (2 * radius), 1, 1e-6) << radius;
        EXPECT_NEAR(width_at(fans(lens, {4, -3}, 101).meridional, 0).mm / (2 * radius), 1, 1e-6) << radius;
    }
}

// Far, strongly bent or with holes of neighbours beside: a search that follows the wrong trail ends dark.
TEST(LensTrace, FindsTheLightOfFarAndStrangeLenses) {
    Display facing = shipped("desktop-stopped");
    facing.lens.as<PlanoConvex>().facing = Facing::panel;
    facing.lens.as<PlanoConvex>().sphere_radius_mm = 644;
    facing.lens.stop_radius_mm = 0.007;
    facing.array.gap_mm = 195;
    Display thick = facing;  // a ball that most rays miss
    thick.lens.stop_radius_mm.reset();
    thick.lens.as<PlanoConvex>().sphere_radius_mm = 6;
    thick.lens.as<PlanoConvex>().aperture_radius_mm = 2;
    thick.lens.as<PlanoConvex>().index = 2.7;
    thick.array.gap_mm = 300;
    Display two = with_lens({{0.12, -2.5, {}, 1.38, 2.3, 1.28}, {-0.0043, -2.7, {}, 4.7, 0, 1}}, 490);
    two.lens.stop_radius_mm = 0.0024;
    for (const Display& d : {facing, thick, two}) {
        const LensTrace lens(d, resolve(d));
        EXPECT_FALSE(bundle(lens, {0, 0}, 20).rays.empty());
        EXPECT_GT(fans(lens, {0, 0}, 20).meridional.size(), 10u);
    }
}

TEST(LensTrace, DiffuserTurnsEachRay) {
    const std::vector<FanRay> fan{{-1, 0.1}, {0, 0}, {2, -0.2}};
    const double z = 30, angle = 0.02;
    const std::vector<FanRay> spread = diffused(fan, z, angle);
    EXPECT_NEAR(width_at(spread, z).mm, width_at(fan, z).mm, 1e-12);
    for (const double at : {-20., 100.}) {
        double low = 1e9, high = -1e9;
        for (const FanRay& l : fan)
            for (const double turn : {-angle, 0., angle}) {
                const double x = l.at + l.slope * z + (at - z) * std::tan(std::atan(l.slope) + turn);
                low = std::min(low, x);
                high = std::max(high, x);
            }
        EXPECT_NEAR(width_at(spread, at).mm, high - low, 1e-10);
    }
}

TEST(LensTrace, DiffuserAlongAnAxisOfTheTurnedArray) {
    Display d = shipped("desktop-asphere");
    d.diffuser->angle_deg = {4, 2};
    d.array.rotation_deg = 90;  // the array's x is the display's y
    EXPECT_NEAR(diffuser_angle(d, resolve(d), {1, 0}), 1 * degree, 1e-12);
    EXPECT_NEAR(diffuser_angle(d, resolve(d), {0, 1}), 2 * degree, 1e-12);
    EXPECT_NEAR(diffuser_angle(d, resolve(d), {std::sqrt(0.5), std::sqrt(0.5)}), 3 * std::sqrt(0.5) * degree, 1e-12);
    d.diffuser->profile = Profile::gaussian;
    EXPECT_NEAR(diffuser_angle(d, resolve(d), {std::sqrt(0.5), std::sqrt(0.5)}), std::sqrt(2.5) * degree, 1e-12);
    d.diffuser.reset();
    EXPECT_EQ(diffuser_angle(d, resolve(d), {1, 0}), 0);
}

}  // namespace
}  // namespace lfdsim
