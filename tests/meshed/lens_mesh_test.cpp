// A lens as triangles: its vertices lie on the surfaces, its bodies are closed, its area tends to the true one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <map>

#include "../optics/example.h"
#include "base/constants.h"
#include "files/description/display_file.h"
#include "geometry/vec.h"
#include "interchange/meshed/lens_mesh.h"

namespace lfdsim {
namespace {

using testing::HasSubstr;

Display shipped(const std::string& name) { return read_display(LFDSIM_SOURCE_DIR "/displays/" + name + ".toml"); }

/// A biconvex lens cemented to a meniscus, then air and a single asphere: two bodies, three glasses, unequal rims.
Display triplet() {
    return with_surfaces({{0.05, 0, {}, 4, 2, 1.6},
                          {-0.04, 0, {}, 4, 1, 1.7},
                          {-0.01, 0, {}, 3.5, 1.5, 1},
                          {0, 0, {}, 3, 1.5, 1.5},
                          {-0.1, -0.5, {1e-4}, 3.2}});
}

Display square_lens(double height = 0.5) {
    Display d = example();
    d.array.aperture = Aperture::cell;
    d.lens.as<PlanoConvex>().cylinder_height_mm = height;
    return d;
}

std::vector<std::pair<std::string, Display>> lenses() {
    Display facing = example();
    facing.lens.as<PlanoConvex>().facing = Facing::panel;
    Display half_ball = example();
    half_ball.lens.as<PlanoConvex>().sphere_radius_mm = half_ball.lens.as<PlanoConvex>().aperture_radius_mm.value();
    half_ball.lens.as<PlanoConvex>().cylinder_height_mm = 0;
    Display cut_square = with_surfaces({{0, 0, {}, 6.5, 2, 1.5}, {-0.08, 0, {}, 7}});
    cut_square.array.aperture = Aperture::cell;
    Display hexagon = square_lens();
    hexagon.array.lattice = LatticeKind::hexagon;
    Display brick = square_lens();
    brick.array.lattice = LatticeKind::brick;
    return {{"plano-convex", example()},
            {"hexagon", hexagon},
            {"brick", brick},
            {"facing the panel", facing},
            {"half ball", half_ball},
            {"square", square_lens()},
            {"square, no wall", square_lens(0)},
            {"square, corners cut", cut_square},
            {"asphere", shipped("desktop-asphere")},
            {"triplet", triplet()}};
}

Vec3d vertex(const LensMesh& mesh, std::size_t corner) {
    const float* p = &mesh.vertices_mm[3 * std::size_t(mesh.triangles[corner])];
    return {p[0], p[1], p[2]};
}
/// Twice the area, along the normal.
Vec3d area2(const LensMesh& mesh, std::size_t t) {
    return cross(minus(vertex(mesh, 3 * t + 1), vertex(mesh, 3 * t)), minus(vertex(mesh, 3 * t + 2), vertex(mesh, 3 * t)));
}
double area_mm2(const LensMesh& mesh, std::int32_t surface) {
    double sum = 0;
    for (std::size_t t = 0; t < mesh.count(); ++t)
        if (mesh.surface_of[t] == surface) sum += length(area2(mesh, t)) / 2;
    return sum;
}

TEST(LensMesh, VerticesAndNormalsAreThoseOfTheSurface) {
    for (const auto& [name, d] : lenses()) {
        const Geometry g = resolve(d);
        const LensMesh mesh = mesh_lens(d, g, 3386);
        ASSERT_EQ(mesh.vertices_mm.size(), mesh.normals.size());
        ASSERT_EQ(mesh.triangles.size(), 3 * mesh.count());
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
            ASSERT_LT(mesh.triangles[i], mesh.vertices_mm.size() / 3);
            const std::int32_t number = mesh.surface_of[i / 3];
            const float* n = &mesh.normals[3 * std::size_t(mesh.triangles[i])];
            ASSERT_NEAR(std::hypot(n[0], n[1], n[2]), 1, 1e-6) << name;
            if (number == LensMesh::wall) continue;
            const PlacedSurface& s = g.surfaces[std::size_t(number)];
            const Vec3d p = vertex(mesh, i);
            const double r = std::hypot(p[0], p[1]);
            ASSERT_LE(r, s.semi_aperture_mm * (1 + 1e-7)) << name;
            // at the rim of a half ball the sag is as steep as a wall: it is judged along the normal
            const auto sag = [&](double at) {
                return sag_mm(s.curvature_per_mm, s.conic, s.even_asphere, std::min(at, s.semi_aperture_mm));
            };
            const double height = p[2] + g.base_z_mm - s.z_mm - sag(r), step = 1e-5 * s.semi_aperture_mm;
            EXPECT_LT(std::abs(height * n[2]), 3e-6) << name << ", surface " << number << " at " << r;
            if (r > step && r < s.semi_aperture_mm * 0.999) {
                const double slope = (sag(r + step) - sag(r - step)) / (2 * step), per = 1 / std::hypot(slope, 1);
                const double sense = s.index_below == 1 ? -1 : 1;
                EXPECT_NEAR(n[2], sense * per, 1e-6) << name;
                EXPECT_NEAR(n[0], -sense * slope * per * p[0] / r, 1e-6) << name;
                EXPECT_NEAR(n[1], -sense * slope * per * p[1] / r, 1e-6) << name;
            }
        }
    }
}

// Each edge is passed once each way by the triangles of a body, and they look outwards: the volume that they enclose is positive.
TEST(LensMesh, EveryBodyIsClosedAndLooksOutwards) {
    for (const auto& [name, d] : lenses()) {
        const LensMesh mesh = mesh_lens(d, resolve(d), 1200);
        std::map<std::pair<Vec3d, Vec3d>, int> edges;
        double volume6 = 0;
        for (std::size_t t = 0; t < mesh.count(); ++t) {
            if (name == "triplet" && mesh.surface_of[t] == 1) continue;  // within the glass
            for (std::size_t k = 0; k < 3; ++k) ++edges[{vertex(mesh, 3 * t + k), vertex(mesh, 3 * t + (k + 1) % 3)}];
            const Vec3d a = area2(mesh, t), p = vertex(mesh, 3 * t);
            volume6 += dot(a, p);
            for (std::size_t k = 0; k < 3; ++k) {
                const float* n = &mesh.normals[3 * std::size_t(mesh.triangles[3 * t + k])];
                EXPECT_GT(a[0] * n[0] + a[1] * n[1] + a[2] * n[2], 0) << name << ", surface " << mesh.surface_of[t];
            }
        }
        for (const auto& [edge, times] : edges) {
            ASSERT_EQ(times, 1) << name;
            ASSERT_EQ(edges.count({edge.second, edge.first}), 1u) << name;
        }
        EXPECT_GT(volume6, 0) << name;
    }
}

// A strip's vertices lie on the cylinder's section, its body is closed, and its area is that of an arc extruded.
TEST(LensMesh, StripsAreSlats) {
    for (const Aperture aperture : {Aperture::circle, Aperture::cell}) {
        Display d = example();
        d.array.lattice = LatticeKind::strips;
        d.array.aperture = aperture;
        d.array.count.reset();
        const Geometry g = resolve(d);
        const double half = g.surfaces[1].semi_aperture_mm, R = 3;
        const LensMesh mesh = mesh_lens(d, g, 2000);
        EXPECT_NEAR(double(mesh.count()), 2000, 200);
        double longest = 0;
        std::map<std::pair<Vec3d, Vec3d>, int> edges;
        for (std::size_t t = 0; t < mesh.count(); ++t) {
            const Vec3d a = area2(mesh, t);
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t corner = 3 * t + k;
                ++edges[{vertex(mesh, corner), vertex(mesh, 3 * t + (k + 1) % 3)}];
                const Vec3d p = vertex(mesh, corner);
                const float* n = &mesh.normals[3 * std::size_t(mesh.triangles[corner])];
                EXPECT_GT(a[0] * n[0] + a[1] * n[1] + a[2] * n[2], 0);
                longest = std::max(longest, p[1]);
                if (mesh.surface_of[t] != 1) continue;
                const double sag = sag_mm(g.surfaces[1].curvature_per_mm, 0, {}, std::abs(p[0]));
                EXPECT_NEAR(p[2] + g.base_z_mm, g.surfaces[1].z_mm + sag, 3e-6);
                EXPECT_NEAR(n[0], p[0] / R, 1e-6);
                EXPECT_EQ(n[1], 0);
            }
        }
        for (const auto& [edge, times] : edges) ASSERT_EQ(edges.count({edge.second, edge.first}), std::size_t(times));
        EXPECT_NEAR(area_mm2(mesh, 1) / (2 * longest * 2 * R * std::asin(half / R)), 1, 1e-3);
    }
}

// Cap, disk and wall of a plano-convex lens by closed forms; a polygon of m corners lacks 1 - sin(2 pi / m) m / 2 pi of a disk.
TEST(LensMesh, AreaAndVolumeTendToTheClosedForms) {
    const Display d = example();
    const Geometry g = resolve(d);
    const double R = 3, r = 2, h = 0.5, cap = R - std::sqrt(R * R - r * r);
    double before = 0;
    for (const std::int64_t n : {1000, 4000, 16000, 64000}) {
        const LensMesh mesh = mesh_lens(d, g, n);
        const double lack = area_mm2(mesh, 1) / (2 * pi * R * cap) - 1;
        EXPECT_LT(lack, 0);  // inscribed
        EXPECT_GT(lack, -3.0 / double(n));
        if (before < 0) {
            EXPECT_NEAR(std::log(before / lack) / std::log(4), 1, 0.15) << n;  // as 1/N
        }
        before = lack;
        EXPECT_NEAR(area_mm2(mesh, 0) / (pi * r * r), 1, 20.0 / double(n));
        EXPECT_NEAR(area_mm2(mesh, LensMesh::wall) / (2 * pi * r * h), 1, 10.0 / double(n));
    }
    const Display square = square_lens();
    EXPECT_NEAR(area_mm2(mesh_lens(square, resolve(square), 3386), 0), 16, 1e-5);  // the whole cell: p^2
}

TEST(LensMesh, NumberOfTriangles) {
    for (const auto& [name, d] : lenses()) {
        const Geometry g = resolve(d);
        for (const std::int64_t n : {8, 100, 500, 860, 2000, 3386, 16380, 65000, 300000}) {
            const double count = double(mesh_lens(d, g, n).count());
            if (n >= 500) {
                EXPECT_NEAR(count / double(n), 1, 0.1) << name << ": " << count << " for " << n;
            }
            EXPECT_GT(count, 2) << name;
        }
    }
    const Display d = example();
    const LensMesh most = mesh_lens(d, resolve(d), most_lens_triangles);
    EXPECT_NEAR(double(most.count()) / double(most_lens_triangles), 1, 0.01);
}

// About as wide as long: the longest edge of a curved surface's triangle against its height over that edge. An equilateral triangle
// has 1.15, half a square 2.
TEST(LensMesh, TrianglesAreNotSlivers) {
    for (const auto& [name, d] : lenses()) {
        const Geometry g = resolve(d);
        const LensMesh mesh = mesh_lens(d, g, 3386);
        for (std::size_t t = 0; t < mesh.count(); ++t) {
            if (mesh.surface_of[t] == LensMesh::wall || g.surfaces[std::size_t(mesh.surface_of[t])].curvature_per_mm == 0) continue;
            double longest = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3d e = minus(vertex(mesh, 3 * t + (k + 1) % 3), vertex(mesh, 3 * t + k));
                longest = std::max(longest, length(e));
            }
            const Vec3d a = area2(mesh, t);
            EXPECT_LT(longest * longest / length(a), 4) << name;
        }
    }
}

TEST(LensMesh, RefusesWhatItCannotMake) {
    const auto refusal = [](const Display& d, std::int64_t n) -> std::string {
        try {
            mesh_lens(d, resolve(d), n);
        } catch (const InputError& error) {
            return error.what();
        }
        return "accepted";
    };
    EXPECT_THAT(refusal(shipped("desktop-ideal"), 1000), AllOf(HasSubstr("lens.type"), HasSubstr("ideal")));
    for (const std::int64_t n :
         {std::int64_t(-1), std::int64_t(0), std::int64_t(7), std::int64_t(4'000'001), std::int64_t(1) << 62})
        EXPECT_THAT(refusal(example(), n), AllOf(HasSubstr(std::to_string(n)), HasSubstr("8 to 4000000")));
}

}  // namespace
}  // namespace lfdsim
