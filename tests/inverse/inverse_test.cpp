// Content by inversion: its matrix is the renderer, its adjoint the matrix's, and its solver finds the minimum.
#include "inverse/inverse.h"

#include <gmock/gmock.h>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <random>

#include "../engine/pictures.h"
#include "../sanitizers.h"
#include "files/description/display_file.h"
#include "image/formats/image_file.h"
#include "inverse/box_solver.h"
#include "inverse/eye_views.h"
#include "inverse/fitted_views.h"

namespace lfdsim {
namespace {

/// The displays that ship, each with a small panel and few pixels of its camera.
std::vector<std::pair<std::string, Display>> shipped_displays() {
    std::vector<std::pair<std::string, Display>> all;
    for (const char* name :
         {"barrier", "desktop-asphere", "desktop-asphere-bare", "desktop-asphere-colour", "desktop-clear", "desktop-doublet",
          "desktop-ideal", "desktop-plate", "desktop-spherical", "desktop-stopped", "hexagon", "tablet-lenticular"}) {
        Display d = read_display(std::string(LFDSIM_SOURCE_DIR "/displays/") + name + ".toml", {});
        for (std::int64_t& n : d.panel.pixels) n = std::min<std::int64_t>(n, 480);  // their middle
        d.camera.resolution = {24, 16};
        d.camera.frame_width_mm = resolve(d).frame_width_mm / 8;
        d.camera.fov_deg.reset();
        d.camera.pixel_filter = PixelFilter::box;
        d.render.estimator = Estimator::point;
        d.render.samples = 36;
        all.emplace_back(name, d);
    }
    Display gaps = all[1].second;  // whole pixels with gaps between them
    gaps.panel.aperture_ratio = 0.6;
    all.emplace_back("with gaps", gaps);
    return all;
}

PanelVector random_vector(std::size_t size, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    PanelVector x(size);
    for (float& one : x) one = float(random() >> 40) / float(1 << 24);
    return x;
}

/// A view whose rows are not scaled: it sees of a white panel what its rows do.
View plain_view(const Display& d) {
    const Geometry g = resolve(d);
    View view{ViewRows(d, g), 1, Image(int(d.camera.resolution[0]), int(d.camera.resolution[1])), {}};
    Texels white = uniform_panel(d, 1);
    view.white = picture(d, white);
    view.expected.assign(view.white.rgb.size() / 3, 1);
    return view;
}

TEST(ViewRows, AreThoseOfTheRenderer) {
    for (const auto& [name, d] : shipped_displays()) {
        const Texels panel = noise_panel(d);
        const PanelVector x(panel.data(), panel.data() + panel.columns() * panel.rows() * 4);
        const Image rendered = picture(d, panel);
        const ViewRows rows(d, resolve(d));
        const Rows all = rows.of(0, rows.height());
        const bool pixels = entries_are_pixels(d);
        for (std::size_t p = 0; p < rendered.rgb.size() / 3; ++p)
            for (std::size_t c = 0; c < 3; ++c) {
                double sum = 0;
                for (const PanelRay& ray : all.row(p))
                    if (pixels || (ray.place & 3) == c)
                        sum += double(ray.share) * double(x[pixels ? ray.place * 4ull + c : ray.place]);
                ASSERT_NEAR(sum, rendered.rgb[3 * p + c], 1e-6) << name << ", element " << p << ", channel " << c;
            }
    }
}

// <M x, y> = <x, M'y>: the half gradient at x less that at 0 is M'VU M x, which is symmetric.
TEST(FittedViews, HalfGradientIsTheAdjoint) {
    for (const auto& [name, d] : shipped_displays()) {
        std::vector<View> views;
        views.push_back(plain_view(d));
        const Job job;
        FittedViews fitted(std::move(views), entries_are_pixels(d), false, {0, 1, 1}, job);
        const std::size_t size = std::size_t(d.panel.pixels[0] * d.panel.pixels[1]) * 4;
        fitted.bound(size);
        const PanelVector x = random_vector(size, 1), y = random_vector(size, 2);
        PanelVector of_x, of_y, of_0;
        fitted.half_gradient(x, of_x);
        fitted.half_gradient(y, of_y);
        fitted.half_gradient(PanelVector(size, 0), of_0);
        double xy = 0, yx = 0;
        for (std::size_t j = 0; j < size; ++j) {
            xy += double(y[j]) * double(of_x[j] - of_0[j]);
            yx += double(x[j]) * double(of_y[j] - of_0[j]);
        }
        EXPECT_GT(xy, 0) << name;
        EXPECT_NEAR(xy, yx, 1e-6 * xy) << name;
        // |M x|^2 = <x, M'M x>
        const double half_squares = fitted.half_gradient(x, of_x);
        double xx = 0;
        for (std::size_t j = 0; j < size; ++j) xx += double(x[j]) * double(of_x[j]);
        EXPECT_NEAR(xx, 2 * half_squares, 1e-6 * xx) << name;
    }
}

// Rows that are kept and rows that are made again have the same bits.
TEST(FittedViews, KeptRowsChangeNoBit) {
    for (const auto& [name, d] : shipped_displays()) {
        std::vector<View> views;
        views.push_back(plain_view(d));
        const Job job;
        FittedViews fitted(std::move(views), entries_are_pixels(d), true, {0.1, 0.9, 0.8}, job);
        const std::size_t size = std::size_t(d.panel.pixels[0] * d.panel.pixels[1]) * 4;
        fitted.bound(size);
        PanelVector made, kept;
        const double first = fitted.half_gradient(random_vector(size, 3), made);
        EXPECT_GT(fitted.keep_rows(1e9), 0);
        EXPECT_EQ(fitted.half_gradient(random_vector(size, 3), kept), first) << name;
        EXPECT_EQ(made, kept) << name;
    }
}

/// The minimum of |M x - t|^2 + p |x - c|^2 in the box by another method, in double precision: coordinates in turn, each at its own
/// minimum.
std::vector<double> by_coordinates(const std::vector<std::vector<double>>& m, const std::vector<double>& t,
                                   const std::vector<float>& centre, double prior) {
    const std::size_t unknowns = centre.size();
    std::vector<double> x(centre.begin(), centre.end());
    for (int sweep = 0; sweep < 20000; ++sweep) {
        double change = 0;
        for (std::size_t j = 0; j < unknowns; ++j) {
            double slope = prior * (x[j] - double(centre[j])), bend = prior;
            for (std::size_t r = 0; r < m.size(); ++r) {
                double seen = -t[r];
                for (std::size_t k = 0; k < unknowns; ++k) seen += m[r][k] * x[k];
                slope += m[r][j] * seen;
                bend += m[r][j] * m[r][j];
            }
            const double next = std::clamp(x[j] - slope / bend, 0., 1.);
            change = std::max(change, std::abs(next - x[j]));
            x[j] = next;
        }
        if (change < 1e-10) break;
    }
    return x;
}

TEST(BoxSolver, FindsTheMinimumOfASmallPanel) {
    constexpr std::size_t unknowns = 12 * 8, rows = 300;
    std::mt19937_64 random(5);
    const auto uniform = [&] { return double(random() >> 11) * 0x1p-53; };
    std::vector<std::vector<double>> m(rows, std::vector<double>(unknowns, 0));
    std::vector<double> t(rows);
    for (std::size_t r = 0; r < rows; ++r) {
        for (int k = 0; k < 4; ++k) m[r][std::size_t(uniform() * double(unknowns))] += 0.25;
        t[r] = 1.6 * uniform() - 0.3;  // beyond what light can be, so that the box matters
    }
    std::vector<float> centre(unknowns, 0.4f), bound(unknowns, 0), gradient(unknowns);
    for (std::size_t r = 0; r < rows; ++r)
        for (std::size_t j = 0; j < unknowns; ++j) bound[j] += float(m[r][j]);  // M'(M 1), each row's sum is 1
    const double prior = 0.01;
    BoxSolver solver(centre, centre, bound, prior);
    for (int step = 0; step < 3000; ++step) {
        std::fill(gradient.begin(), gradient.end(), 0.f);
        for (std::size_t r = 0; r < rows; ++r) {
            double error = -t[r];
            for (std::size_t j = 0; j < unknowns; ++j) error += m[r][j] * double(solver.point()[j]);
            for (std::size_t j = 0; j < unknowns; ++j) gradient[j] += float(m[r][j] * error);
        }
        solver.step(gradient);
    }
    const std::vector<double> wanted = by_coordinates(m, t, centre, prior);
    int at_ends = 0;
    for (std::size_t j = 0; j < unknowns; ++j) {
        EXPECT_NEAR(double(solver.x()[j]), wanted[j], 1e-4) << j;
        at_ends += wanted[j] == 0 || wanted[j] == 1;
    }
    EXPECT_GT(at_ends, 5);
}

constexpr const char* small_display = R"(schema = 1
panel = {pixels = [180, 120], pixel_pitch_mm = 0.5}
lens = {type = "plano_convex", sphere_radius_mm = 5, aperture_radius_mm = 2.9, cylinder_height_mm = 1, index = 1.49}
array = {count = [15, 10], pitch_mm = 6, gap_mm = 11}
diffuser = {distance_mm = 60, angle_deg = [3, 3]}
camera = {position_mm = [0, 0, 600]}
content = {viewing_distance_mm = 600, pickup = "inverse"}
)";

InvertedPanel inverted(const Display& d, int threads) {
    Job job;
    const Geometry g = resolve(d);
    const ContentScene scene(built_in_model(), d, g);
    const std::vector<EyeBox> boxes{{{-60, 0, 600}, {60, 0, 600}}};
    return invert(d, g, scene, boxes, threads, job);
}

// Eyes beyond the middle between two periods of the views want of pixels what eyes at the box's other end do not.
TEST(EyePlaces, AroundABoxEndWhereTheViewsRepeat) {
    for (const auto& [name, d] : shipped_displays()) {
        const Geometry g = resolve(d);
        const double z = g.rear_principal_mm + 700, period = d.array.pitch_mm.least() * (700 + g.gap_mm) / g.gap_mm;
        for (const double share : {0.1, 0.7, 0.97, 1.5}) {  // of the period, that the box is wide
            const std::vector<EyeBox> box{{{-0.5 * share * period, -1, z}, {0.5 * share * period, 1, z}}};
            double most = 0;
            for (const Vec3d& eye : places_around(box, d, g, 3, 200)) most = std::max(most, std::abs(eye[0]));
            const double reach = 3 * view_step_mm(d, g, z), width = share * period;
            EXPECT_LE(most, 0.5 * std::max(period, width) * 1.2 + 1e-9) << name;  // hexagons' rows are closer than their columns
            if (!is_strips(d.array) && share < 1) {
                EXPECT_GT(most, 0.5 * width + 0.8 * std::min(reach, 0.5 * (0.86 * period - width))) << name;
            }
        }
    }
}

// A grid of views of a plane with stripes as wide as an element: each element is the mean of its lines, not a wider one, and
// elements that no camera sees are unknown.
TEST(EyeViews, OfAGridAreMeansOfLines) {
    const Display d = parse_display(small_display, "small");
    const Geometry g = resolve(d);
    ViewGrid grid;
    grid.columns = 3;
    grid.camera_mm = camera_places({-30, 0, 30}, {0});
    grid.distance_mm = 600 - g.vertex_plane_mm;
    grid.width_mm = 120;
    grid.height_mm = 80;
    std::vector<Image> views(3, Image(480, 320));
    Display seen = seen_by_camera_at(d, g, {10, 0, 600}, {60, 40});
    const double element_mm = seen.camera.frame_width_mm.value() / 60;
    for (Image& view : views)
        for (std::size_t k = 0; k < view.rgb.size(); ++k) {
            const double x = (double(k / 3 % 480) + 0.5) / 4 - 60;
            view.rgb[k] = std::lround(std::floor((x - 0.5 * element_mm) / element_mm)) & 1 ? 1.f : 0.f;
        }
    const LightField field(grid, views);
    FieldRays rays;
    Job job;
    const std::vector<EyeBox> box{{{-30, 0, 600}, {30, 0, 600}}};
    const ContentOf content = pictures_of(field, g.vertex_plane_mm, box, rays);
    const Image image = content(seen, resolve(seen), 16, job);
    double least = 1, most = 0;
    for (int column = 20; column < 40; ++column) {
        least = std::min(least, double(image.at(column, 20)[0]));
        most = std::max(most, double(image.at(column, 20)[0]));
    }
    EXPECT_LT(least, 0.3);
    EXPECT_GT(most, 0.7);
    EXPECT_EQ(rays.unseen, 0);
    seen.camera.position_mm[0] = 80;  // beside the cameras
    EXPECT_TRUE(std::isnan(content(seen, resolve(seen), 16, job).at(30, 20)[0]));
    EXPECT_EQ(rays.unseen, 0);  // this eye is not in the box
}

TEST(Inverse, GainsAtEyesThatWereNotFittedWithTheSameBitsOnAnyNumberOfThreads) {
    Display d = parse_display(small_display, "small");
    d.content.inverse.rays = 16;
    d.content.inverse.iterations = 6;
    const InvertedPanel one = inverted(d, 1);
    EXPECT_GT(one.report.held_out.psnr_db, one.report.held_out_traced.psnr_db + 1);
    EXPECT_GT(one.report.held_out.ssim, one.report.held_out_traced.ssim);
    EXPECT_EQ(one.report.result, PickupKind::inverse);
    EXPECT_TRUE(one.picture.complete);
    d.content.inverse.memory_mb = 2;  // most rows are made again in each step
    for (const int threads : {2, 5}) EXPECT_EQ(inverted(d, threads).picture.image.rgb, one.picture.image.rgb) << threads;
}

TEST(Inverse, OfTheResultGainsNoMore) {
    Display d = parse_display(small_display, "small");
    d.content.inverse.rays = 16;
    d.content.inverse.iterations = 30;
    const InvertedPanel first = inverted(d, 2);
    const std::string file = testing::TempDir() + "start.npy";
    write_image(file, first.picture.image);
    d.content.inverse.start = file;
    const InvertedPanel again = inverted(d, 2);
    EXPECT_NEAR(again.report.held_out.psnr_db, first.report.held_out.psnr_db, 0.02);
}

TEST(Inverse, FitsGivenPictures) {
    Display d = parse_display(small_display, "small");
    d.camera.resolution = {90, 60};
    d.camera.pixel_filter = PixelFilter::box;
    EyePictures wanted;
    for (const double x : {-30., 0., 30.}) {
        wanted.eyes_mm.push_back({x, 0, 600});
        Image picture(90, 60);
        for (std::size_t k = 0; k < picture.rgb.size(); ++k) picture.rgb[k] = x < 0 ? 0.2f : x > 0 ? 0.6f : 0.4f;
        wanted.pictures.push_back(picture);
    }
    Job job;
    const InvertedPanel panel = invert(d, resolve(d), wanted, 2, job);
    Texels shown = make_texels(panel.picture.image), white = uniform_panel(d, 1);
    for (std::size_t k = 0; k < 3; ++k) {
        Display seen = d;
        seen.camera.position_mm = wanted.eyes_mm[k];
        const float light = picture(seen, shown).at(45, 30)[1] / picture(seen, white).at(45, 30)[1];
        EXPECT_NEAR(light, 0.2 + 0.2 * double(k), 0.05) << k;
    }
    EXPECT_THAT(panel.report.warnings, testing::IsEmpty());
    wanted.pictures.pop_back();
    EXPECT_THROW(invert(d, resolve(d), wanted, 2, job), InputError);
    wanted.eyes_mm.pop_back();
    d.content.inverse.rays = 1;
    EXPECT_THAT(
        invert(d, resolve(d), wanted, 2, job).report.warnings,
        testing::ElementsAre(testing::HasSubstr("pulled to the mean of the pictures (prior 0.3); leave out content.inverse.rays")));
}

/// A job that is cancelled after so many stages.
class StopsAfter : public Job {
  public:
    explicit StopsAfter(int stages) : left_(stages) {}
    void stage(std::string_view, std::int64_t) override { --left_; }
    bool cancelled() const override { return left_ < 0; }

  private:
    std::atomic<int> left_;
};

TEST(Inverse, StoppedKeepsTheBestPanel) {
    Display d = parse_display(small_display, "small");
    d.content.inverse.rays = 16;
    const Geometry g = resolve(d);
    const ContentScene scene(built_in_model(), d, g);
    const std::vector<EyeBox> boxes{{{-60, 0, 600}, {60, 0, 600}}};
    for (const int stages : {2, 7}) {  // among the photographs; after some steps
        StopsAfter job(stages);
        const InvertedPanel panel = invert(d, g, scene, boxes, 2, job);
        EXPECT_FALSE(panel.picture.complete);
        EXPECT_EQ(panel.picture.image.width, 180);
        EXPECT_EQ(panel.report.held_out.psnr_db > panel.report.held_out_traced.psnr_db, stages == 7);
    }
}

}  // namespace
}  // namespace lfdsim
