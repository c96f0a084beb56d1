// Pictures by a wide machine, here the host: the same bits as by the CPU's kernels, whatever is handed to it in one go.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstring>
#include <thread>

#include "../sanitizers.h"
#include "engine/devices/gpu.h"
#include "engine/estimator/gaussian_parts.h"
#include "engine/estimator/panel_planes.h"
#include "engine/scene/work.h"
#include "engine/views/compare_view.h"
#include "engine/views/pipelined.h"
#include "engine/wide/likeness.h"
#include "engine/wide/render.h"
#include "host_queue.h"
#include "optics/trace.h"
#include "pictures.h"

namespace lfdsim {
namespace {

void expect_same(const Image& a, const Image& b, const std::string& what) {
    ASSERT_EQ(a.rgb.size(), b.rgb.size());
    int differ = 0;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) differ += std::memcmp(&a.rgb[i], &b.rgb[i], sizeof(float)) != 0;
    EXPECT_EQ(differ, 0) << what << ": numbers that differ, of " << a.rgb.size();
}

Display diffused_example() {
    Display d = example();
    d.diffuser = Diffuser{40, {5.7, 5.7}, Profile::box};
    return d;
}

Rendering by_host(const Display& d, const Texels& panel, const RenderOptions& options, HostQueue& queue) {
    Job job;
    const SummedPanel summed(panel);
    const Geometry geometry = resolve(d);
    const auto& planes = planes_of(summed, panel_reading(d));
    Work work(d, geometry, planes, options, job);
    work.make_pictures(options.target_error.has_value());
    const wide::DevicePanel there(queue, planes[0]);
    const Done done = wide::render(queue, there, work.tile, work.target_error, work.result.error.rgb.data(), job);
    EXPECT_TRUE(done.complete);
    work.result.samples = done.samples;
    return std::move(work.result);
}

Rendering by_cpu(const Display& d, const Texels& panel, RenderOptions options) {
    options.device = "cpu";
    Job job;
    return render(d, resolve(d), panel, options, job);
}

TEST(Wide, PointsHaveTheSameBits) {
    std::vector<optics::Facts> used;
    for (auto& [name, d] : every_kind()) {
        const Texels panel = noise_panel(d);
        for (const std::int64_t samples : {1, 2, 7, 300}) {
            d.render.samples = samples;
            const RenderOptions options{0, "", samples == 300 ? Rect{13, 7, 30, 20} : Rect{3, 0, 110, 61}};
            HostQueue queue;
            const Rendering wide = by_host(d, panel, options, queue), cpu = by_cpu(d, panel, options);
            expect_same(wide.image, cpu.image, name);
            EXPECT_EQ(wide.samples, cpu.samples);
            used.insert(used.end(), queue.specialisations.begin(), queue.specialisations.end());
        }
    }
    using Rows = optics::Specialisations;
    for (const optics::Facts& plain : {Rows::paper_plain, Rows::paper_plain_schlick})
        EXPECT_NE(std::find(used.begin(), used.end(), plain), used.end());
}

TEST(Wide, TargetErrorsHaveTheSameBits) {
    Display d = diffused_example();
    const Texels panel = patterned_panel(d);
    RenderOptions options{0, "", Rect{9, 20, 75, 60}};
    options.target_error = 0.03;
    HostQueue queue;
    const Rendering wide = by_host(d, panel, options, queue), cpu = by_cpu(d, panel, options);
    expect_same(wide.image, cpu.image, "picture");
    expect_same(wide.error, cpu.error, "error");
    EXPECT_EQ(wide.samples, cpu.samples);
    EXPECT_GT(wide.samples, 66 * 40 * 17);  // more than the first step
}

TEST(Wide, StopsWhenAskedAndLeavesTheRestBlack) {
    class Stops : public Job {
      public:
        void advance(std::int64_t units) override { done += units; }
        bool cancelled() const override { return done > 0; }
        std::int64_t done = 0;
    } job;
    Display d = diffused_example();
    const Texels panel = uniform_panel(d, 1);
    const SummedPanel summed(panel);
    HostQueue queue;
    queue.points = 7 * 256 * *d.render.samples;  // of seven squares
    Work work(d, resolve(d), planes_of(summed), {}, job);
    work.make_pictures(false);
    const wide::DevicePanel there(queue, planes_of(summed)[0]);
    EXPECT_FALSE(wide::render(queue, there, work.tile, {}, nullptr, job).complete);
    EXPECT_GT(job.done, 0);
    EXPECT_LT(job.done, 160 * 112);
    EXPECT_GT(work.result.image.rgb.front() + work.result.image.at(80, 1)[0], 0);
    EXPECT_EQ(work.result.image.rgb.back(), 0);
}

TEST(Wide, SaysWhatMemoryItWants) {
    Display d = example();
    const Texels panel = uniform_panel(d, 1);
    const SummedPanel summed(panel);
    HostQueue small(1000);
    EXPECT_THROW(wide::DevicePanel(small, planes_of(summed)[0]), wide::DeviceError);
    EXPECT_GE(wide::DevicePanel::bytes(planes_of(summed)[0]), std::size_t(panel.columns() * panel.rows()) * 16);
}

/// A photograph that is somewhat like the view of a crop, and regions of both.
Expected expected_of(const Image& view) {
    Image photograph = view;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x)
            for (int c = 0; c < 3; ++c) photograph.at(x, y)[c] = 0.7f * view.at(x, y)[c] + 0.2f * float((x / 5 + y / 7 + c) % 2);
    const double w = view.width, h = view.height;
    const std::array<std::array<double, 2>, 4> corners = {{{0.1 * w, 0}, {0.9 * w, 0.1 * h}, {w, h}, {0, 0.9 * h}}};
    return {std::move(photograph), Region::polygon(corners, view.width, view.height),
            Region::of({view.width / 3, view.height / 3, view.width, view.height / 3 + 30})};
}

void expect_same(const Likeness& a, const Likeness& b) {
    EXPECT_EQ(a.screen, b.screen);
    EXPECT_EQ(a.content, b.content);
    EXPECT_EQ(a.share, b.share);
}

TEST(Wide, LikenessHasTheSameBits) {
    Display d = example();
    d.camera.resolution = {480, 336};  // rows are taken in two parts
    const Texels panel = patterned_panel(d);
    const SummedPanel summed(panel);
    for (const Rect crop : {Rect{7, 5, 460, 330}, Rect{0, 0, 480, 336}, Rect{20, 20, 60, 30}}) {
        const RenderOptions options{0, "", crop, {}, "cpu"};
        const Image view = by_cpu(d, panel, options).image;
        const Expected expected = expected_of(view);
        HostQueue queue;
        Job job;
        const wide::DevicePanel there(queue, planes_of(summed)[0]);
        const wide::Photograph photograph(queue, expected.photograph());
        const Work work(d, resolve(d), planes_of(summed), options, job);
        wide::ViewComparison comparison(queue, photograph, expected.screen, expected.content);
        const wide::Buffer<float> seen(queue, view.rgb.size());
        EXPECT_TRUE(wide::render_there(queue, there, work.tile, seen.get(), job).complete);
        const Likeness wide = comparison.with(seen.get(), 1.3f),
                       cpu = compare_view(d, resolve(d), summed, expected, 1.3f, options, job).likeness;
        if (view.height > 11) {
            expect_same(wide, cpu);
            EXPECT_GT(cpu.screen, 0.1);
            EXPECT_LT(cpu.screen, 0.99);
            EXPECT_LT(std::abs(cpu.screen - cpu.content), 0.9);
        } else {
            EXPECT_TRUE(std::isnan(wide.screen) && std::isnan(cpu.screen));
            EXPECT_EQ(wide.share, cpu.share);
        }
    }
}

TEST(CompareView, WantsAPhotographOfTheCropsSize) {
    const Display d = example();
    const Texels panel = uniform_panel(d, 1);
    const SummedPanel summed(panel);
    Job job;
    const Expected expected(Image(30, 20), {}, {});
    EXPECT_THROW(compare_view(d, resolve(d), summed, expected, 1, {}, job), InputError);
    RenderOptions options{0, "", Rect{0, 0, 30, 20}};
    EXPECT_TRUE(compare_view(d, resolve(d), summed, expected, 1, options, job).complete);
    options.target_error = 0.1;
    EXPECT_THROW(compare_view(d, resolve(d), summed, expected, 1, options, job), std::invalid_argument);
}

TEST(Devices, AreChosenByWordOrExplained) {
    EXPECT_FALSE(choose_device("cpu", "").gpu);
    EXPECT_FALSE(choose_device("auto", "scalar").gpu);  // a kernel of the CPU
    for (const char* const wrong : {"gpu", "cuda:", "cuda:x", "cuda:-1", "cuda:1x", "CUDA", "cuda:99999999999"}) {
        try {
            choose_device(wrong, "");
            ADD_FAILURE() << wrong;
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find("allowed: auto, cpu, cuda"), std::string::npos) << error.what();
        }
    }
    const cuda::GpuSearch& found = found_gpus();
    if (found.missing.empty()) {
        EXPECT_TRUE(choose_device("auto", "").gpu);
        EXPECT_THROW(choose_device("cuda:1000", ""), InputError);
    } else {
        EXPECT_FALSE(choose_device("auto", "").gpu);
        try {
            choose_device("cuda", "");
            ADD_FAILURE() << "no GPU, and no error";
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find(found.missing), std::string::npos) << error.what();
        }
    }
}

TEST(Ahead, KeepsTheOrderAndStopsWhereItIsTold) {
    for (const bool at_once : {false, true}) {
        std::vector<std::size_t> taken;
        std::atomic<int> made{0};
        const auto make = [&](std::size_t k) {
            ++made;
            return 10 * k;
        };
        make_ahead(5, at_once, make, [&](std::size_t k, std::size_t value) {
            EXPECT_EQ(value, 10 * k);
            taken.push_back(k);
            return k < 3;
        });
        EXPECT_EQ(taken, (std::vector<std::size_t>{0, 1, 2, 3}));
        EXPECT_EQ(made, at_once ? 5 : 4);
        make_ahead(0, at_once, make, [](std::size_t, std::size_t) { return true; });
    }
}

TEST(Ahead, HandsOnWhatIsThrownWhenNothingIsUnderWay) {
    for (const bool at_once : {false, true}) {
        std::atomic<int> under_way{0};
        const auto make = [&](std::size_t k) {
            ++under_way;
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
            --under_way;
            if (k == 3) throw std::runtime_error("3");
            return k;
        };
        EXPECT_THROW(make_ahead(9, at_once, make, [](std::size_t, std::size_t) { return true; }), std::runtime_error);
        EXPECT_EQ(under_way, 0);
        EXPECT_THROW(
            make_ahead(9, at_once, make, [](std::size_t k, std::size_t) { return k == 1 ? throw std::logic_error("1") : true; }),
            std::logic_error);
        EXPECT_EQ(under_way, 0);
    }
}

/// On a GPU what Wide does on the host.
class OnGpu : public testing::Test {
  protected:
    void SetUp() override {
        if (!found_gpus().missing.empty()) GTEST_SKIP() << found_gpus().missing;
    }
    void expect_cpu_bits(const std::string& name, const Display& d, const Texels& panel, RenderOptions options) {
        options.device = "cuda";
        Job job;
        const Rendering gpu = render(d, resolve(d), panel, options, job), cpu = by_cpu(d, panel, options);
        EXPECT_EQ(gpu.device.rfind("cuda:0", 0), 0u) << gpu.device;
        EXPECT_GT(gpu.gpu_seconds, 0);
        EXPECT_EQ(gpu.samples, cpu.samples);
        expect_same(gpu.image, cpu.image, name);
        if (options.target_error) expect_same(gpu.error, cpu.error, name + ", error");
    }
};

TEST_F(OnGpu, PointsHaveTheCpusBits) {
    for (auto& [name, d] : every_kind()) {
        for (const std::int64_t samples : {1, 2, 7, 300}) {
            d.render.samples = samples;
            expect_cpu_bits(name, d, noise_panel(d), {0, "", Rect{3, 0, 110, 61}});
        }
    }
}

TEST_F(OnGpu, OtherEstimatorsGiveWayToPoints) {
    for (auto& [name, d] : diffused()) {
        const Texels panel = patterned_panel(d);
        RenderOptions options{0, "", Rect{35, 23, 99, 71}};
        for (const std::optional<std::int64_t> samples : {std::optional<std::int64_t>{}, {9}}) {
            d.render.samples = samples;
            options.device = "cuda";
            Job job;
            const Rendering gpu = render(d, resolve(d), panel, options, job);
            EXPECT_EQ(gpu.estimator, Estimator::point);
            EXPECT_EQ(gpu.samples, 64 * 48 * samples.value_or(256));
            Display points = d;
            points.render.estimator = Estimator::point;
            points.render.samples = samples.value_or(256);
            expect_same(gpu.image, by_cpu(points, panel, options).image, name);
        }
    }
}

TEST_F(OnGpu, PicturesMadeAtOnceHaveTheCpusBits) {
    const Display middle = diffused_example();
    const Texels panel = patterned_panel(middle);
    const SummedPanel summed(panel);
    RenderOptions options;
    options.device = "cuda";
    const auto seen = [&](std::size_t k) {
        Display d = middle;
        d.camera.position_mm[0] += 5 * double(k);
        return d;
    };
    Job job;
    make_ahead(
        20, true, [&](std::size_t k) { return render(seen(k), resolve(seen(k)), summed, options, job); },
        [&](std::size_t k, const Rendering& r) {
            expect_same(r.image, by_cpu(seen(k), panel, {}).image, "view " + std::to_string(k));
            return true;
        });
}

TEST_F(OnGpu, LikenessHasTheCpusBits) {
    Display d = example();
    d.camera.resolution = {960, 672};
    const Texels panel = patterned_panel(d);
    const SummedPanel summed(panel);
    const Expected expected = expected_of(by_cpu(d, panel, {}).image);
    Job job;
    RenderOptions cpu, gpu;
    cpu.device = "cpu";
    gpu.device = "cuda";
    for (int k = 0; k < 3; ++k) {  // the photograph is there from the second on
        const ComparedView seen = compare_view(d, resolve(d), summed, expected, 0.8f, gpu, job);
        EXPECT_GT(seen.gpu_seconds, 0);
        expect_same(seen.likeness, compare_view(d, resolve(d), summed, expected, 0.8f, cpu, job).likeness);
        d.camera.position_mm[0] += 11;
    }
}

TEST_F(OnGpu, TargetErrorsHaveTheCpusBits) {
    const Display d = diffused_example();
    RenderOptions options;
    options.target_error = 0.03;
    expect_cpu_bits("target error", d, patterned_panel(d), options);
}

}  // namespace
}  // namespace lfdsim
