// Lenses of triangles against the true surfaces: the same rays, and errors that fall with the triangles as theory says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstdio>

#include "../engine/pictures.h"
#include "files/description/display_file.h"
#include "geometry/lattice.h"
#include "geometry/lens_misalignment.h"
#include "interchange/meshed/mesh_surfaces.h"
#include "interchange/meshed/render_meshed.h"

namespace lfdsim {
namespace {

bool beyond_rows_in_air(const Display& d) { return is_staggered(d.array) || is_strips(d.array) || !d.panel.layers.empty(); }

using testing::HasSubstr;

Display ready_display(const std::string& name) { return read_display(LFDSIM_SOURCE_DIR "/displays/" + name + ".toml"); }

Rendering meshed(const Display& d, const Texels& panel, std::int64_t triangles, LensNormals normals,
                 const RenderOptions& options = {}) {
    Job job;
    const Geometry g = resolve(d);
    return render_meshed(d, g, panel, MeshedLens(d, g, triangles, normals), options, job);
}

/// Where a display's rays reach the panel, with its surfaces and with triangles.
struct Comparison {
    int both = 0, one = 0;      // rays that arrive both ways, or only one way
    double mean_pixels = 0;     // distance of the two panel points
    double within_a_pixel = 0;  // share, of rays that arrive either way, that meet the same panel pixel or one beside it
};

Comparison compare(const Display& d, std::int64_t triangles, LensNormals normals, int step) {
    const Geometry g = resolve(d);
    const MeshedLens lens(d, g, triangles, normals);
    const MeshedScene scene{make_traced_display<float>(d, g), &lens.surfaces()};
    const optics::RayOrigin view = make_ray_origin(d, g);
    Comparison found;
    int near = 0;
    for (int row = 1; row < view.height; row += step) {
        for (int column = 2; column < view.width; column += step) {
            const auto pixel = optics::pixel_rays<float>(view, column, row);
            optics::Sampler<float> sampler(d.render.sampling, optics::sampler_dimensions, view.seed,
                                           std::uint32_t(row * view.width + column));
            optics::Passage<float> passage{{}, {0, 0}, 1, pixel.alive};
            optics::sample_ray(scene, view, pixel, sampler, passage.ray);
            optics::to_first_vertex(scene, passage);
            const auto a = optics::trace_opaque<optics::Specialisations::opaque>(scene, pixel.extent, pixel.base, passage);
            const auto b = optics::trace_opaque<optics::Specialisations::meshed>(scene, pixel.extent, pixel.base, passage);
            found.one += a.alive != b.alive;
            if (!a.alive || !b.alive) continue;
            ++found.both;
            found.mean_pixels += std::hypot(a.column - b.column, a.row - b.row);
            near +=
                std::abs(std::floor(a.column) - std::floor(b.column)) <= 1 && std::abs(std::floor(a.row) - std::floor(b.row)) <= 1;
        }
    }
    found.mean_pixels /= found.both;
    found.within_a_pixel = double(near) / (found.both + found.one);
    return found;
}

/// The order q at which an error falls as N^-q, from the first and the last of a row of numbers of triangles.
double order(const std::vector<std::int64_t>& n, const std::vector<double>& error) {
    return std::log(error.front() / error.back()) / std::log(double(n.back()) / double(n.front()));
}

// A triangle h wide lies off its surface by O(h^2) and is tilted against it by O(h); interpolated normals are off by O(h^2). N
// triangles are O(N^-1/2) wide. Rims lack a share O(h^2).
class Convergence : public testing::TestWithParam<const char*> {};
std::string name_of(const testing::TestParamInfo<const char*>& display) {
    std::string name = display.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}
INSTANTIATE_TEST_SUITE_P(Shipped, Convergence, testing::Values("desktop-spherical", "desktop-asphere"), name_of);
INSTANTIATE_TEST_SUITE_P(ShippedAtLength, Convergence, testing::Values("desktop-stopped"), name_of);

TEST_P(Convergence, IsOfTheOrderThatTheTriangleSizePromises) {
    Display d = ready_display(GetParam());
    look_from(d, 8, 2000);
    const std::vector<std::int64_t> n{860, 3386, 16380, 65000, 260000};
    for (const LensNormals normals : {LensNormals::flat, LensNormals::smooth}) {
        const bool smooth = normals == LensNormals::smooth;
        std::vector<double> error, lost;
        for (const std::int64_t triangles : n) {
            const Comparison found = compare(d, triangles, normals, d.lens.stop_radius_mm ? 4 : 13);
            std::printf("%-18s %6s %7lld triangles: mean %.6f pixels, %.4f within one, %d of %d rays lost or won\n", GetParam(),
                        smooth ? "smooth" : "flat", (long long)triangles, found.mean_pixels, found.within_a_pixel, found.one,
                        found.both);
            ASSERT_GT(found.both, 10000);
            error.push_back(found.mean_pixels);
            lost.push_back(double(found.one) / found.both);
        }
        const double q = order(n, error);
        std::printf("%-18s %6s: error falls as N^-%.3f\n", GetParam(), smooth ? "smooth" : "flat", q);
        EXPECT_NEAR(q, smooth ? 1 : 0.5, 0.08);
        EXPECT_LT(lost.back(), 1e-3);
    }
}

// Many flat triangles show the picture of the true surfaces. One sample a pixel: each pixel's light is that of the panel pixel that
// its ray meets, and few rays are so near a border of two.
TEST(RenderMeshed, TendsToThePicture) {
    for (auto [name, d] : every_kind()) {
        if (d.lens.is_thin() || d.array.surround != Surround::opaque || beyond_rows_in_air(d) || is_irregular(d.errors)) continue;
        d.render.samples = 1;
        const Texels panel = noise_panel(d);
        const Image wanted = picture(d, panel), got = meshed(d, panel, 300000, LensNormals::smooth).image;
        int different = 0;
        for (std::size_t k = 0; k < wanted.rgb.size(); ++k) different += std::abs(wanted.rgb[k] - got.rgb[k]) > 1e-4f;
        EXPECT_LT(different, int(wanted.rgb.size() / 200)) << name;
        const Image few = meshed(d, panel, 30, LensNormals::flat).image;
        EXPECT_NE(few.rgb, wanted.rgb) << name;
    }
}

// At slants at which rays cross several cells on their way to a cap, and caps are met from behind. No ray is lost, and errors fall
// as before, however steep the caps magnify them.
TEST(RenderMeshed, TendsToTheTrueLensFarOffTheAxis) {
    for (const double angle : {45.0, 60.0, 75.0}) {
        for (const Facing facing : {Facing::viewer, Facing::panel}) {
            Display d = example();
            d.lens.as<PlanoConvex>().sphere_radius_mm = 2.1;
            d.lens.as<PlanoConvex>().facing = facing;
            d.panel.pixels = {640, 448};  // rays that slant so still meet it
            look_from(d, angle, 400);
            const std::vector<std::int64_t> n{20000, 80000, 320000};
            std::vector<double> error;
            for (const std::int64_t triangles : n) {
                const Comparison found = compare(d, triangles, LensNormals::smooth, 1);
                EXPECT_GT(found.both, 50) << angle;
                EXPECT_LE(found.one, triangles < 80000 ? 3 : 0) << angle << ", " << triangles;
                error.push_back(found.mean_pixels);
            }
            EXPECT_NEAR(order(n, error), 1, 0.15) << angle;
        }
    }
}

// A bowl within the lens, deep and open to the viewer: a slanting line may come up through its wall before it comes down on its
// floor, which alone counts.
TEST(MeshSurfaces, OnlyWaysDownCount) {
    const Display d = with_surfaces({{0.25, 0, {}, 3.9, 4, 1.5}, {0, 0, {}, 3.9}});
    const Geometry g = resolve(d);
    const MeshedLens lens(d, g, 300000, LensNormals::smooth);
    const auto scene = make_traced_display<double>(d, g);
    Random random(5);
    int from_behind = 0;
    for (int n = 0; n < 20000; ++n) {
        const double r = 3.85 * std::sqrt(random(0, 1)), turn = random(0, 360) * degree, slant = random(0, 80) * degree;
        const double x = r * std::cos(turn), y = r * std::sin(turn), z = 4 - std::sqrt(16 - r * r);
        const optics::Vec3<double> to{std::sin(slant), 0, -std::cos(slant)}, up{-x / 4, -y / 4, (4 - z) / 4};
        if (optics::dot(to, up) > -0.3) continue;
        const double t = -z / to.z;  // on to the plane of the vertex
        const optics::Ray<double> ray{{x + to.x * t, y + to.y * t, 0}, to};
        const auto wanted = optics::meet(scene.surface[1].shape, scene.surface[1], ray);
        const auto got = lens.surfaces().meet(1, {{float(ray.at.x), float(ray.at.y), 0}, {float(to.x), float(to.y), float(to.z)}});
        ASSERT_TRUE(wanted.ok && got.ok) << x << " " << y << " " << slant;
        ASSERT_NEAR(got.at.x, x, 3e-4);
        ASSERT_NEAR(got.at.y, y, 3e-4);
        ASSERT_NEAR(got.at.z, z, 3e-4);
        ASSERT_NEAR(got.cos, wanted.cos, 3e-4);
        const double back = 2 * 4 * optics::dot(to, up);  // to the ball's other side: -2 R cos before here
        const double high = z + to.z * back, other = std::hypot(x + to.x * back, y);
        from_behind += high < 4 && other < 3.85;
    }
    EXPECT_GT(from_behind, 100);
}

TEST(RenderMeshed, WhiteIsWhiteOrBlack) {
    for (auto [name, d] : every_kind()) {
        if (d.lens.is_thin() || d.array.surround != Surround::opaque || beyond_rows_in_air(d) || is_irregular(d.errors)) continue;
        d.render.fresnel = Fresnel::none;
        d.panel.emission_exponent = 0;
        d.panel.aperture_ratio = 1;
        d.panel.subpixels = SubpixelLayout::none;
        d.panel.subpixel_cell.reset();
        d.panel.custom.clear();
        d.diffuser.reset();
        d.camera.pixel_filter = PixelFilter::center;
        const Texels white = uniform_panel(d, 1);
        for (const double angle : {0.0, 30.0, 60.0}) {
            look_from(d, angle, 400);
            int lit = 0;
            for (const float light : meshed(d, white, 2000, LensNormals::flat).image.rgb) {
                ASSERT_TRUE(light == 0 || light == 1) << name << " " << angle << ": " << light;
                lit += light == 1;
            }
            EXPECT_GT(lit, 0) << name << " " << angle;
        }
    }
}

TEST(RenderMeshed, SameBitsOnAnyNumberOfThreadsAndInEveryCrop) {
    Display d = example();
    d.diffuser = Diffuser{40, {5, 5}, Profile::box};
    look_from(d, 20, 400);
    const Texels panel = noise_panel(d);
    for (const LensNormals normals : {LensNormals::flat, LensNormals::smooth}) {
        const Image one = meshed(d, panel, 860, normals, {1, "", {}}).image;
        for (const int threads : {2, 5}) EXPECT_EQ(meshed(d, panel, 860, normals, {threads, "", {}}).image.rgb, one.rgb) << threads;
        const Rect crop{13, 7, 110, 60};
        const Image part = meshed(d, panel, 860, normals, {2, "", crop}).image;
        for (int y = crop.y0; y < crop.y1; ++y)
            ASSERT_TRUE(std::equal(part.at(0, y - crop.y0), part.at(0, y - crop.y0) + 3 * part.width, one.at(crop.x0, y))) << y;
    }
}

TEST(RenderMeshed, SaysWhatItDidAndWhatItCannotDo) {
    Display d = example();
    d.diffuser = Diffuser{40, {5, 5}, Profile::box};
    d.render.estimator = Estimator::filtered;
    d.render.samples = 3;
    const Texels panel = noise_panel(d);
    const Rendering r = meshed(d, panel, 860, LensNormals::flat, {2, "", Rect{0, 0, 40, 20}});
    EXPECT_TRUE(r.complete);
    EXPECT_EQ(r.estimator, Estimator::point);
    EXPECT_EQ(r.kernel, "meshed");
    EXPECT_EQ(r.threads, 2);
    EXPECT_EQ(r.samples, 40 * 20 * 3);
    const Geometry g = resolve(d);
    EXPECT_NEAR(double(MeshedLens(d, g, 860, LensNormals::flat).triangles()), 860, 86);
    for (const Surround surround : {Surround::clear, Surround::plate}) {
        d.array.surround = surround;
        try {
            MeshedLens(d, resolve(d), 860, LensNormals::flat);
            ADD_FAILURE() << "accepted";
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), AllOf(HasSubstr("array.surround"), HasSubstr("opaque")));
        }
    }
}

TEST(RenderMeshed, RefusesWhatItDoesNotCover) {
    const auto refusal = [](const Display& d) -> std::string {
        try {
            MeshedLens(d, resolve(d), 860, LensNormals::flat);
        } catch (const InputError& error) {
            return error.what();
        }
        return "accepted";
    };
    Display hexagons = example(), layers = example(), glued = example();
    hexagons.array.lattice = LatticeKind::hexagon;
    EXPECT_THAT(refusal(hexagons), AllOf(HasSubstr("array.lattice"), HasSubstr("--lens-mesh")));
    layers.panel.layers = {{0.1, 1.5}};
    EXPECT_THAT(refusal(layers), HasSubstr("panel.layer"));
    glued.array.gap_mm.reset();
    glued.array.base_z_mm = 0;
    EXPECT_THAT(refusal(glued), HasSubstr("array.base_z_mm"));
}

struct Stopped : Job {
    explicit Stopped(int question) : at(question) {}
    bool cancelled() const override { return ++asked >= at; }
    const int at;
    mutable std::atomic<int> asked{0};
};

TEST(RenderMeshed, CanBeStopped) {
    Display d = example();
    d.diffuser = Diffuser{40, {3, 3}, Profile::box};
    d.render.samples = 1 << 24;
    const Geometry g = resolve(d);
    for (const int question : {1, 3}) {  // before the first tile, and within a pixel
        Stopped job(question);
        const Rendering r = render_meshed(d, g, noise_panel(d), MeshedLens(d, g, 860, LensNormals::flat), {1, "", {}}, job);
        EXPECT_FALSE(r.complete);
    }
}

}  // namespace
}  // namespace lfdsim
