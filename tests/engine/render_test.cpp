// render(): its means against plain sums and a quadrature, and what it does with bad requests and an impatient caller.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <limits>

#include "pictures.h"

namespace lfdsim {
namespace {

using testing::HasSubstr;

// More samples than are summed in one go (256): the mean of what each sample's trace says, summed here in double.
TEST(Means, OfManySamplesAreTheirAverage) {
    Display d = example();
    d.diffuser = Diffuser{40, {10, 10}, Profile::box};
    const Geometry g = resolve(d);
    const Texels panel = noise_panel(d);
    const auto scene = make_traced_display<float>(d, g);
    const auto view = make_ray_origin(d, g);
    for (int samples : {1, 255, 256, 257, 300, 1000}) {
        d.render.samples = samples;
        const Image image = picture(d, panel, {1, "", Rect{70, 50, 90, 60}});
        for (int y = 50; y < 60; ++y) {
            for (int x = 70; x < 90; ++x) {
                optics::Sampler<float> sampler(Sampling::sobol, optics::sampler_dimensions, view.seed,
                                               std::uint32_t(y * view.width + x));
                double sum[3] = {};
                for (int n = 0; n < samples; ++n, sampler.next(sobol_directions())) {
                    const auto hit =
                        optics::trace<optics::Specialisations::paper>(scene, view, optics::pixel_rays<float>(view, x, y), sampler);
                    for (int c = 0; c < 3 && hit.lit; ++c) sum[c] += double(hit.weight) * double(panel.data()[hit.pixel * 4 + c]);
                }
                // 256 roundings of 6e-8 of a sum below 1 each, at random: at most 256 x 6e-8 relative
                for (int c = 0; c < 3; ++c)
                    ASSERT_NEAR(image.at(x - 70, y - 50)[c], sum[c] / samples, 1.6e-5 * sum[c] / samples + 1e-9);
            }
        }
    }
}

// An ideal lens behind a box diffuser: the integral over both angles by a fine midpoint rule in plain geometry. The panel is a
// ramp, a smooth function of the place but for its pixels of 0.25 mm, 1/160 of the light each.
TEST(Means, TendToTheIntegral) {
    Display d = ideal_example();
    d.diffuser = Diffuser{30, {12, 7}, Profile::box};
    look_from(d, 10, 400);
    d.render.samples = 1 << 14;
    d.render.fresnel = Fresnel::none;
    Texels panel(160, 112);
    for (int row = 0; row < 112; ++row) {
        for (int column = 0; column < 160; ++column) {
            const float light[3] = {float(column) / 160, float(row) / 112, float((column / 16 + row / 16) % 2)};
            std::copy(light, light + 3, panel.row(row) + column * 4);
        }
    }
    const Geometry g = resolve(d);
    for (const auto [px, py] : {std::array{80, 56}, std::array{61, 40}, std::array{100, 70}}) {
        const double pixel = g.frame_width_mm / 160, sine = std::sin(10 * degree), cosine = std::cos(10 * degree);
        // the ray, with the camera's axes right = (cos, 0, -sin), up = y
        const double sx = (px + 0.5 - 80) * pixel, sy = (56 - py - 0.5) * pixel;
        const double from[3] = {400 * sine, 0, 400 * cosine}, to[3] = {-400 * sine + sx * cosine, sy, -400 * cosine - sx * sine};
        const double length = std::hypot(to[0], to[1], to[2]), z_d = *g.diffuser_z_mm, lens_z = g.vertex_plane_mm;
        const double t = (z_d - from[2]) / to[2], x = from[0] + to[0] * t, y = from[1] + to[1] * t;
        constexpr int steps = 700;
        double sum[3] = {};
        for (int i = 0; i < steps; ++i) {
            const double a = ((i + 0.5) / steps - 0.5) * 12 * degree, ca = std::cos(a), sa = std::sin(a);
            const double ux = (ca * to[0] + sa * to[2]) / length, uz = (ca * to[2] - sa * to[0]) / length;
            for (int j = 0; j < steps; ++j) {
                const double b = ((j + 0.5) / steps - 0.5) * 7 * degree, cb = std::cos(b), sb = std::sin(b);
                const double vy = cb * to[1] / length - sb * uz, vz = sb * to[1] / length + cb * uz;
                const double mx = ux / vz, my = vy / vz, lx = x + mx * (lens_z - z_d), ly = y + my * (lens_z - z_d);
                const double qx = lx - (std::floor(lx / 4) + 0.5) * 4, qy = ly - (std::floor(ly / 4 + 0.5)) * 4;  // 10 and 7 lenses
                const int column = int(std::floor((lx - lens_z * (mx + qx / 6) + 20) / 0.25));
                const int row = int(std::floor((14 - ly + lens_z * (my + qy / 6)) / 0.25));
                if (std::abs(lx) > 20 || std::abs(ly) > 14 || column < 0 || row < 0 || column >= 160 || row >= 112) continue;
                for (int c = 0; c < 3; ++c) sum[c] += double(panel.row(row)[column * 4 + c]);
            }
        }
        for (Sampling sampling : {Sampling::sobol, Sampling::random}) {
            d.render.sampling = sampling;
            const Image image = picture(d, panel, {1, "", Rect{px, py, px + 1, py + 1}});
            // random: standard deviation of light in [0, 1] at most 0.5, 6 of them over sqrt(2^14); sobol: some dozen jumps
            // along each axis, each of 2^7 strata that it crosses uncertain by one sample in 2^14
            const double bound = sampling == Sampling::random ? 6 * 0.5 / 128 : 2e-3;
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(image.at(0, 0)[c], sum[c] / (steps * steps), bound) << px << " colour " << c;
        }
    }
}

// A thin lens focused on the display's plane through the target: a vanishing pupil gives the pinhole's picture, a real one the same
// light where the display shows one light within the blur. Its rays move by less than 1e-9 mm: at most one pixel in a thousand may
// change.
TEST(ThinLens, TendsToThePinhole) {
    Display d = ideal_example();
    look_from(d, 12, 400);
    const Texels panel = noise_panel(d);
    const Image pinhole = picture(d, panel);
    d.camera.pupil_diameter_mm = 1e-6;
    const Image small = picture(d, panel);
    int different = 0;
    for (std::size_t k = 0; k < small.rgb.size(); ++k) different += std::abs(small.rgb[k] - pinhole.rgb[k]) > 1e-6f;
    EXPECT_LE(different, int(small.rgb.size() / 1000));
    d.camera.pupil_diameter_mm = 20;
    const Image wide = picture(d, panel);
    different = 0;
    for (std::size_t k = 0; k < wide.rgb.size(); ++k) different += std::abs(wide.rgb[k] - pinhole.rgb[k]) > 1e-6f;
    EXPECT_GT(different, int(wide.rgb.size() / 2));
}

/// The message of the InputError that the request gives.
std::string refusal(const RenderOptions& options, std::int64_t columns = 160) {
    const Display d = example();
    Job job;
    try {
        render(d, resolve(d), Texels(columns, 112), options, job);
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

TEST(BadRequest, SaysWhatIsAllowed) {
    EXPECT_THAT(refusal({1, "sse9", {}}), AllOf(HasSubstr("--kernel"), HasSubstr("'sse9'"), HasSubstr("baseline, scalar")));
    for (int threads : {-1, 1025, 1 << 30}) {
        EXPECT_THAT(refusal({threads, "", {}}),
                    AllOf(HasSubstr("--threads"), HasSubstr(std::to_string(threads)), HasSubstr("1 to 1024")));
    }
    for (Rect crop : {Rect{0, 0, 161, 1}, Rect{0, 0, 1, 113}, Rect{-1, 0, 1, 1}, Rect{0, -1, 1, 1}, Rect{5, 5, 5, 6},
                      Rect{5, 6, 6, 6}, Rect{9, 0, 3, 5}}) {
        EXPECT_THAT(refusal({1, "", crop}), AllOf(HasSubstr("--crop"), HasSubstr("160 x 112"), HasSubstr("X1 <= 160")));
    }
    EXPECT_THAT(refusal({}, 161), AllOf(HasSubstr("161 x 112"), HasSubstr("160 x 112")));
    EXPECT_EQ(refusal({}), "accepted");
}

TEST(Kernels, EnvironmentChoosesUnlessTheCallerDoes) {
    const Display d = example();
    const Texels panel = noise_panel(d);
    auto run = [&](const std::string& wanted) {
        Job job;
        return render(d, resolve(d), panel, {1, wanted, Rect{0, 0, 8, 8}}, job).kernel;
    };
    std::string best;
    for (const KernelInfo& kernel : kernels()) {
        if (kernel.available && best.empty()) best = kernel.name;
    }
    ASSERT_EQ(unsetenv("LFDSIM_KERNEL"), 0);
    EXPECT_EQ(run(""), best);
    ASSERT_EQ(setenv("LFDSIM_KERNEL", "scalar", 1), 0);
    EXPECT_EQ(run(""), "scalar");
    EXPECT_EQ(run("baseline"), "baseline");
    ASSERT_EQ(setenv("LFDSIM_KERNEL", "abacus", 1), 0);
    EXPECT_THAT(refusal({1, "", {}}), AllOf(HasSubstr("LFDSIM_KERNEL"), HasSubstr("abacus"), HasSubstr("scalar")));
    ASSERT_EQ(setenv("LFDSIM_KERNEL", "", 1), 0);  // empty is as good as absent
    EXPECT_EQ(run(""), best);
    ASSERT_EQ(unsetenv("LFDSIM_KERNEL"), 0);
}

/// Cancels once some pixels are done; counts them.
struct Impatient : Job {
    std::int64_t patience;
    std::int64_t units = 0;
    std::atomic<std::int64_t> done{0};
    explicit Impatient(std::int64_t pixels) : patience(pixels) {}
    void stage(std::string_view, std::int64_t n) override { units = n; }
    void advance(std::int64_t n) override { done += n; }
    bool cancelled() const override { return done >= patience; }
};

TEST(Cancelling, KeepsWhatIsComplete) {
    const Display d = example();
    const Texels panel = noise_panel(d);
    const Image whole = picture(d, panel);
    for (std::int64_t patience : {std::int64_t(0), std::int64_t(1), std::int64_t(5000), std::int64_t(160 * 112 + 1)}) {
        Impatient job(patience);
        const Rendering r = render(d, resolve(d), panel, {1, "", {}}, job);
        EXPECT_EQ(job.units, 160 * 112);
        EXPECT_EQ(r.complete, patience > 160 * 112);
        EXPECT_EQ(r.samples, job.done);  // one ray a pixel: nothing to sample
        std::int64_t pixels = 0;         // those that are the whole picture's, not black
        for (std::size_t k = 0; k < whole.rgb.size(); ++k) {
            ASSERT_TRUE(r.image.rgb[k] == whole.rgb[k] || r.image.rgb[k] == 0);
            pixels += k % 3 == 0 && r.image.rgb[k] == whole.rgb[k];
        }
        EXPECT_GE(pixels, job.done);
    }
}

/// Cancels at the question with this number.
struct CancelsAt : Job {
    explicit CancelsAt(int question) : at(question) {}
    bool cancelled() const override { return ++asked >= at; }
    const int at;
    mutable std::atomic<int> asked{0};
};

// Whatever the number of samples, cancelling takes effect within a tile; pixels are then finished or black.
TEST(Cancelling, TakesEffectWithinATile) {
    Display d = example();
    d.diffuser = Diffuser{40, {3, 3}, Profile::box};
    const Texels panel = noise_panel(d);
    const auto stops = [&](const std::string& kernel, const Rect& crop) {
        SCOPED_TRACE(kernel + " " + std::to_string(int(d.render.estimator)));
        const RenderOptions options{1, kernel, crop, {}, "cpu"};
        CancelsAt never(std::numeric_limits<int>::max());
        const Image whole = render(d, resolve(d), panel, options, never).image;
        bool partly = false;
        for (int k = 1; k <= 5; ++k) {
            const int question = never.asked * k / 5;
            CancelsAt job(question);
            const Rendering r = render(d, resolve(d), panel, options, job);
            ASSERT_FALSE(r.complete) << question;
            std::size_t finished = 0;
            for (std::size_t i = 0; i < whole.rgb.size(); ++i) {
                ASSERT_TRUE(r.image.rgb[i] == whole.rgb[i] || r.image.rgb[i] == 0) << question;
                finished += r.image.rgb[i] == whole.rgb[i] && whole.rgb[i] != 0;
            }
            partly = partly || (finished > 0 && finished < whole.rgb.size() * 9 / 10);
        }
        EXPECT_TRUE(partly);
    };
    const Rect tile{64, 48, 128, 64};
    d.render.estimator = Estimator::point;
    d.render.samples = 600;
    for (const std::string kernel : {"scalar", "baseline", ""}) stops(kernel, tile);
    d.render.samples = 576;
    d.render.estimator = Estimator::filtered;
    stops("", tile);
    d.render.estimator = Estimator::lens_by_lens;
    stops("", tile);
    d.render.estimator = Estimator::filtered;
    d.diffuser->profile = Profile::gaussian;
    stops("", {60, 48, 132, 70});
}

// A single pixel of the most samples takes seconds.
TEST(Cancelling, TakesEffectWithinAPixel) {
    Display d = example();
    d.diffuser = Diffuser{40, {3, 3}, Profile::box};
    d.render.estimator = Estimator::point;
    d.render.samples = 1 << 24;
    for (const std::string kernel : {"scalar", ""}) {
        CancelsAt job(3);
        const Rendering r = render(d, resolve(d), noise_panel(d), {1, kernel, Rect{70, 50, 71, 51}, {}, "cpu"}, job);
        EXPECT_FALSE(r.complete) << kernel;
        EXPECT_EQ(r.image.rgb, std::vector<float>(3, 0)) << kernel;
    }
}

TEST(Rendering, SaysWhatItDid) {
    Display d = example();
    d.diffuser = Diffuser{40, {3, 3}, Profile::box};
    Job job;
    const Rendering r = render(d, resolve(d), noise_panel(d), {2, "baseline", Rect{10, 10, 40, 30}}, job);
    EXPECT_TRUE(r.complete);
    EXPECT_EQ(r.kernel, "baseline");
    EXPECT_EQ(r.threads, 2);
    EXPECT_EQ(r.samples, 30 * 20 * 8);
    EXPECT_GT(r.seconds, 0);
}

}  // namespace
}  // namespace lfdsim
