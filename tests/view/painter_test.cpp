#include "view/painting/painter.h"

#include <gmock/gmock.h>
#include <atomic>
#include <fstream>
#include <map>
#include <random>
#include <thread>

#include "../sanitizers.h"
#include "analysis/pictures/views.h"
#include "engine/render.h"
#include "engine/scene/traced_display.h"
#include "files/description/display_file.h"
#include "view/answers/likeness.h"
#include "view/painting/eye_displays.h"
#include "visit.h"

namespace lfdsim::view {
namespace {
using namespace test;
using testing::HasSubstr;

class PainterTest : public testing::Test {
  protected:
    PainterTest() { lfdsim::test::save(folder / "small.toml", tiny_display); }

    Start start() const { return {folder / "small.toml", {}, "", "", ""}; }
    /// What `lfdsim render` makes of the state, by its own way.
    Image rendered(const Wanted& w, int eye = 0) const {
        Job job;
        const auto [file, set] = library.description(w, eye);
        const Display d = read_display(file, set);
        Wanted made = w;
        if (w.shown.hold) made.set.clear();
        const Display m = library.display(made, w.shown.hold ? 0 : eye);
        Texels panel;
        if (w.shown.kind == Shown::Kind::panel_image)
            panel = read_panel_image(folder / w.shown.name, d.panel.encoding, d.panel.pixels[0], d.panel.pixels[1]);
        else if (w.shown.kind == Shown::Kind::pattern)
            panel = shown_texels(pattern(w.shown.name, m, resolve(m)), m.panel.encoding);
        else
            panel = shown_texels(elemental_images(m, resolve(m), ContentScene(built_in_model(), m, resolve(m)), 0, job).image,
                                 m.panel.encoding);
        return render(d, resolve(d), panel, {}, job).image;
    }

    TemporaryFolder folder;
    Library library{start(), folder.path()};
    Panels panels;
    Kept outbox;
};

TEST_F(PainterTest, RestingPictureIsTheRenderedOneBitForBit) {
    Image image(480, 270);
    std::mt19937 random(3);
    for (float& x : image.rgb) x = float(random() % 1000) / 999;
    write_image(folder / "panel.png", image);

    std::vector<Wanted> states{wanted(0)};
    states.push_back(wanted(0, {"array.gap_mm=6.8", "content.yaw_deg=20"}));
    states.back().eye_mm = {90, -20, 450};
    states.push_back(wanted(0, {"render.estimator=\"point\"", "render.samples=3"}));
    states.push_back(wanted(0, {"array.rotation_deg=3", "render.samples=4"}));
    states.push_back(wanted(0, {"array.gap_mm=7"}));
    states.back().shown = {Shown::Kind::model, "built-in:spheres", true};
    states.back().size = {331, 17};
    for (const char* name : {"checkerboard", "edge", "view", "address"}) {
        states.push_back(wanted(0, {"array.gap_mm=7.5"}));
        states.back().shown = {Shown::Kind::pattern, name};
    }
    states.push_back(wanted(0, {"panel.encoding=\"linear\""}));
    states.back().shown = {Shown::Kind::panel_image, "panel.png"};

    Painter painter(library, panels, outbox, 2);
    std::int64_t id = 0;
    for (Wanted w : states) {
        w.id = ++id;
        painter.want(w);
        const Sent sent = outbox.wait(w.id);
        EXPECT_EQ(sent.header["format"], "png");
        EXPECT_EQ(sent.header["width"], w.size[0]);
        EXPECT_EQ(codes_of(sent, folder), encode8(rendered(w), Encoding::srgb)) << id;
        EXPECT_EQ(outbox.wait(w.id, "one", "coarse").header["format"], "jpeg");
    }
}

TEST_F(PainterTest, RendersOnTheDeviceOfTheCommandLine) {
    const Library elsewhere({folder / "small.toml", {}, "", "", "", "abacus"}, folder.path());
    Painter painter(elsewhere, panels, outbox, 2);
    painter.want(wanted(1));
    EXPECT_EQ(outbox.problems(1)[0]["key"], "--device");
}

TEST_F(PainterTest, TwoEyesHaveTheirPicturesInStep) {
    Painter painter(library, panels, outbox, 2);
    Wanted w = wanted(1);
    w.layout = Layout::crossed;
    w.eye_distance_mm = 80;
    painter.want(w);
    EXPECT_EQ(codes_of(outbox.wait(1, "left"), folder), encode8(rendered(w, -1), Encoding::srgb));
    EXPECT_EQ(codes_of(outbox.wait(1, "right"), folder), encode8(rendered(w, 1), Encoding::srgb));
    const std::vector<Sent> frames = outbox.frames();
    ASSERT_EQ(frames.size() % 2, 0u);
    for (std::size_t k = 0; k < frames.size(); k += 2) {
        EXPECT_EQ(frames[k].header["lane"], "left");
        EXPECT_EQ(frames[k + 1].header["lane"], "right");
        EXPECT_EQ(frames[k].header["quality"], frames[k + 1].header["quality"]);
    }
}

TEST_F(PainterTest, NewestWinsAndIdsNeverFall) {
    Painter painter(library, panels, outbox, 2);
    for (int id = 1; id <= 200; ++id) {
        Wanted w = wanted(id);
        w.eye_mm[0] = id;
        w.moving = id < 200;
        painter.want(w);
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    painter.want(wanted(150));  // too late
    outbox.wait(200);
    std::int64_t last = 0;
    for (const Sent& f : outbox.frames()) {
        EXPECT_GE(f.header["id"].get<std::int64_t>(), last);
        last = f.header["id"];
        EXPECT_TRUE(last == 200 || f.header["quality"] == "coarse");
    }
    EXPECT_EQ(last, 200);
}

TEST_F(PainterTest, WaitsForASlowBrowser) {
    outbox.set_busy(true);
    Painter painter(library, panels, outbox, 2);
    for (int id = 1; id <= 3; ++id) painter.want(wanted(id));
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    EXPECT_THAT(outbox.frames(), testing::IsEmpty());
    outbox.set_busy(false);
    outbox.wait(3);
    for (const Sent& f : outbox.frames()) EXPECT_EQ(f.header["id"], 3);
}

TEST_F(PainterTest, LongWorkEndsWhenSomethingElseIsWanted) {
    Painter painter(library, panels, outbox, 2);
    Wanted slow = wanted(1, {"render.samples=3600"});
    slow.size = {1920, 1080};  // minutes
    painter.want(slow);
    outbox.wait(1, "one", "coarse");
    std::this_thread::sleep_for(std::chrono::milliseconds(400));
    const auto asked = std::chrono::steady_clock::now();
    painter.want(wanted(2));
    const Sent next = outbox.wait(2, "one", "coarse");
    EXPECT_LT(std::chrono::duration<double>(next.at - asked).count(), 20.0) << "the work before takes minutes";
    outbox.wait(2);
    for (const Sent& f : outbox.frames()) EXPECT_FALSE(f.header["id"] == 1 && f.header["quality"] == "final");

    slow.id = 3;
    painter.want(slow);  // and the end of the visit does not wait for it, either
    outbox.wait(3, "one", "coarse");
}

TEST_F(PainterTest, ProblemsAreToldAndTheNextPictureComes) {
    Painter painter(library, panels, outbox, 2);
    painter.want(wanted(1, {"array.gap_mm=-3"}));
    EXPECT_THAT(outbox.problems(1)[0]["key"], "array.gap_mm");

    Wanted w = wanted(2);
    w.shown = {Shown::Kind::model, "none.obj"};
    painter.want(w);
    EXPECT_THAT(outbox.problems(2)[0]["what"].get<std::string>(), HasSubstr("is not in the folder"));

    lfdsim::test::save(folder / "bad.obj", "f 1 2 3\n");
    w = wanted(3);
    w.shown = {Shown::Kind::model, "bad.obj"};
    painter.want(w);
    EXPECT_FALSE(outbox.problems(3).empty());

    painter.want(wanted(4, {"render.samples=1000000"}));
    EXPECT_EQ(outbox.problems(4)[0]["key"], "render.samples");

    w = wanted(5);
    w.shown = {Shown::Kind::pattern, "white"};
    w.beside = Beside::photograph;
    painter.want(w);
    EXPECT_EQ(outbox.problems(5)[0]["key"], "beside");
    outbox.wait(5);

    w = wanted(6, {"panel.pixels=[240, 135]"});
    w.shown.hold = true;
    painter.want(w);
    EXPECT_EQ(outbox.problems(6)[0]["key"], "panel.pixels");

    painter.want(wanted(7));
    EXPECT_EQ(codes_of(outbox.wait(7), folder), encode8(rendered(wanted(7)), Encoding::srgb));
    const auto texts = outbox.texts();
    EXPECT_EQ(std::count_if(texts.begin(), texts.end(), [](const auto& t) { return t["type"] == "problems"; }), 6);  // each once
}

// One budget for all: what does not fit is refused to whom it is for, with both figures, and others see what they saw.
TEST_F(PainterTest, WhatDoesNotFitIsRefusedAndOthersGoOn) {
    Panels few(60e6);
    Kept to_other;
    Painter other(library, few, to_other, 2), painter(library, few, outbox, 2);
    other.want(wanted(1));
    const Sent before = to_other.wait(1);
    painter.want(wanted(1, {"panel.pixels=[16000, 12000]"}));
    const auto problem = outbox.problems(1)[0];
    EXPECT_EQ(problem["key"], "panel.pixels");
    EXPECT_THAT(problem["what"].get<std::string>(),
                testing::ContainsRegex("16000 x 12000 pixels needs 8.4 GB of memory; .* has [0-9]+ MB free"));
    Wanted large = wanted(2);
    large.size = {3840, 2160};
    painter.want(large);
    EXPECT_EQ(outbox.problems(2)[0]["key"], "size");
    painter.want(wanted(3));
    outbox.wait(3);
    other.want(wanted(2));
    EXPECT_EQ(to_other.wait(2).picture, before.picture);
    EXPECT_FALSE(
        std::any_of(to_other.texts().begin(), to_other.texts().end(), [](const auto& t) { return t["type"] == "problems"; }));
}

TEST_F(PainterTest, LikenessIsThatOfTheAnalysis) {
    Painter painter(library, panels, outbox, 2);
    Wanted w = wanted(1);
    w.size = {320, 180};
    w.beside = Beside::photograph;
    painter.want(w);
    const Sent photograph = outbox.wait(1, "photograph"), view = outbox.wait(1);

    Subject subject(library.display(w), ContentScene(built_in_model(), library.display(w), resolve(library.display(w))), {});
    Job job;
    const double alike = likeness(expected_view(subject.display(), subject.geometry(), subject.scene(), 0, job), subject.display(),
                                  subject.geometry(), subject.panel(job), subject.white_field(job), {}, job)
                             .content;
    EXPECT_NEAR(photograph.header["ssim"].get<double>(), alike, 2e-3);
    EXPECT_EQ(photograph.header["ssim"], view.header["ssim"]);
    EXPECT_EQ(
        codes_of(photograph, folder),
        encode8(reference_photograph(subject.display(), subject.geometry(), subject.scene(), 0, {}, job).image, Encoding::srgb));
    EXPECT_EQ(codes_of(view, folder), encode8(rendered(w), Encoding::srgb));
    // In motion it is that of a smaller picture, and near.
    EXPECT_NEAR(outbox.wait(1, "one", "coarse").header["ssim"].get<double>(), alike, 0.1);

    w.id = 2;
    w.beside = Beside::difference;
    painter.want(w);
    const std::vector<std::uint8_t> difference = codes_of(outbox.wait(2, "difference"), folder);
    EXPECT_EQ(difference[0], 128);  // beside the screen both are black
    EXPECT_EQ(outbox.wait(2, "difference").header["ssim"], photograph.header["ssim"]);
}

// A GPU has no filtered light: one sample a pixel there would be noise.
TEST(CoarseView, HasManyPointsOnAGpu) {
    Display d = parse_display(tiny_display, "tiny.toml");
    d.camera.pupil_diameter_mm = 3;
    const Display coarse = coarse_view(d, resolve(d), 0.5, false), there = coarse_view(d, resolve(d), 0.5, true);
    EXPECT_EQ(estimator_of(coarse), Estimator::filtered);
    EXPECT_EQ(samples_of(coarse), 1);
    EXPECT_EQ(estimator_of(there), Estimator::point);
    EXPECT_EQ(samples_of(there), 64);
    EXPECT_EQ(there.camera.resolution, coarse.camera.resolution);
    EXPECT_FALSE(there.camera.pupil_diameter_mm);
}

TEST(Difference, IsGreyWhereBothAreEqual) {
    Image a(3, 1), b(3, 1);
    for (int c = 0; c < 3; ++c) {
        a.at(1, 0)[c] = b.at(2, 0)[c] = 1;
        a.at(0, 0)[c] = b.at(0, 0)[c] = 0.3f;
    }
    EXPECT_THAT(difference_codes(a, b), testing::ElementsAre(128, 128, 128, 255, 255, 255, 0, 0, 0));
}

TEST_F(PainterTest, FileHoldsTheLightOfBothEyes) {
    Painter painter(library, panels, outbox, 2);
    painter.want_exr(5);  // of nothing
    Wanted w = wanted(1);
    w.layout = Layout::pair;
    painter.want(w);
    const Sent file = outbox.wait(5, "file");
    EXPECT_EQ(file.header["format"], "exr");
    lfdsim::test::save(folder / "file.exr", file.picture);
    EXPECT_EQ(read_image(folder / "file.exr", Encoding::linear).rgb, rendered(w, -1).rgb);
    const std::optional<Image> right = read_layer(folder / "file.exr", "right");
    ASSERT_TRUE(right);
    EXPECT_EQ(right->rgb, rendered(w, 1).rgb);
}

double resident_mb() {
    double pages = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> pages >> resident;
    return resident * 4096 / 1e6;
}

TEST_F(PainterTest, MemoryStaysFlat) {
    if (address_sanitizer) GTEST_SKIP() << "AddressSanitizer keeps freed memory";
    Painter painter(library, panels, outbox, 2);
    std::mt19937 random(7);
    const auto some = [&](double low, double high) { return low + (high - low) * double(random()) / double(random.max()); };
    double before = 0;
    for (int id = 1; id <= 200; ++id) {
        Wanted w = wanted(id, {"array.gap_mm=" + std::to_string(some(6, 8)), "content.tilt_deg=" + std::to_string(random() % 2)});
        w.eye_mm = {some(-100, 100), some(-60, 60), some(400, 600)};
        w.size = {int(some(60, 160)), int(some(40, 90))};
        w.layout = random() % 4 == 0 ? Layout::pair : Layout::one;
        w.beside = random() % 8 == 0 ? Beside::difference : Beside::none;
        w.shown.hold = random() % 2 == 0;
        w.moving = random() % 16 != 0;
        painter.want(w);
        outbox.wait(id, w.layout == Layout::one ? "one" : "left", w.moving ? "coarse" : "final");
        if (id == 60) before = resident_mb();
        outbox.clear();
    }
    EXPECT_LT(resident_mb(), before + 64);
}

}  // namespace
}  // namespace lfdsim::view
