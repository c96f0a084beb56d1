// The rays of the drawings against the tracer, and each against its way back.
#include "report/drawings/side_rays.h"

#include <gtest/gtest.h>

#include "engine/scene/traced_display.h"
#include "files/description/display_file.h"
#include "optics/trace.h"

namespace lfdsim {
namespace {

Display shipped(const std::string& name) { return read_display(LFDSIM_SOURCE_DIR "/displays/" + name + ".toml"); }

/// Where the tracer sees the panel, mm above the lens's axis; NaN: it does not.
double traced(const Display& d, const SideRay& ray) {
    using namespace optics;
    const Geometry g = resolve(d);
    Display alone = d;
    alone.array.count = {1, 1};
    alone.diffuser.reset();
    const optics::TracedDisplay<double> scene = make_traced_display<double>(alone, g);
    const double first = g.entrance_z_mm;
    const PanelBase<double> base{0, 0, 0, 0};
    const Extent<double> extent{0, 0, 0, 0};
    const Ray<double> start{{0, ray.y_at(first), 0}, {0, ray.dy, ray.dz}};
    PanelPoint<double> point{};
    if (d.lens.type() == LensType::ideal)
        point = trace_array<Specialisations::ideal>(scene, extent, base, start, true);
    else
        point = trace_array<Specialisations::opaque>(scene, extent, base, start, true);
    return point.alive ? -point.row * d.panel.pixel_pitch_mm : NAN;
}

TEST(SideRays, MeetThePanelWhereTheTracerDoes) {
    for (const char* name : {"desktop-asphere", "desktop-stopped", "desktop-spherical", "desktop-ideal"}) {
        const Display d = shipped(name);
        const Geometry g = resolve(d);
        int through = 0;
        for (int at = -20; at <= 20; ++at)
            for (int tilt = -6; tilt <= 6; ++tilt) {
                const double y = 0.0503 * at * d.array.pitch_mm[0] / 2, z = g.top_z_mm + 5;
                const SideRay ray = side_ray(y + 0.41 * tilt, z, y, g.vertex_plane_mm);
                const SidePath path = through_lens(d, g, ray);
                const double wanted = traced(d, ray);
                ASSERT_EQ(path.through, !std::isnan(wanted)) << name << ", " << y << ", " << tilt;
                if (!path.through) continue;
                EXPECT_NEAR(path.last.y_at(0), wanted, 1e-9) << name;
                ++through;
            }
        EXPECT_GT(through, 20) << name;
    }
}

TEST(SideRays, GoBackTheWayTheyCame) {
    for (const char* name : {"desktop-asphere", "desktop-stopped", "desktop-spherical", "desktop-ideal"}) {
        const Display d = shipped(name);
        const Geometry g = resolve(d);
        int through = 0;
        for (int at = -8; at <= 8; ++at) {
            const SidePath up = through_lens(d, g, side_ray(0.7, 0, 0.05 * at * g.clear_aperture_mm[0], g.front_principal_mm));
            if (!up.through) continue;
            SideRay back = up.last;
            back.y = up.last.y_at(g.top_z_mm + 10);
            back.z = g.top_z_mm + 10;
            back.dy = -back.dy;
            back.dz = -back.dz;
            const SidePath down = through_lens(d, g, back);
            ASSERT_TRUE(down.through) << name;
            EXPECT_NEAR(down.last.y_at(0), 0.7, 1e-9) << name;
            ++through;
        }
        EXPECT_GT(through, 10) << name;
    }
}

TEST(SideRays, EndAtTheStop) {
    const Display d = shipped("desktop-stopped");
    const Geometry g = resolve(d);
    const double y = *d.lens.stop_radius_mm + 0.5;
    const SidePath path = through_lens(d, g, {y, g.top_z_mm + 5, 0, -1});
    EXPECT_FALSE(path.through);
    ASSERT_EQ(path.points.size(), 2u);
    EXPECT_NEAR(path.points[1][0], y, 1e-12);
    EXPECT_NEAR(path.points[1][1], g.stop_z_mm, 1e-12);
}

}  // namespace
}  // namespace lfdsim
