// Measures that are pictures: they show what they say.
#include <gtest/gtest.h>

#include "analysis/pictures/components.h"
#include "analysis/pictures/directions.h"
#include "example.h"

#include <cmath>

namespace lfdsim {
namespace {

struct CountedSteps : Job {
    void advance(std::int64_t units) override { done += units; }
    std::int64_t done = 0;
};

Subject subject(Display d) { return Subject(d, ContentScene(built_in_model(), d, resolve(d)), {}); }

const Image& named(const Result& r, const std::string& name) {
    for (const NamedPicture& p : r.pictures)
        if (p.name == name) return p.image;
    throw std::runtime_error("no picture " + name);
}

TEST(Components, DiffuserAloneBlursTheBoardAndBendsNothing) {
    Display d = analysis_example::display(40, 60);
    d.diffuser = Diffuser{1, {0, 0}};  // without any angle: the panel itself is seen
    Subject s = subject(d);
    CountedSteps job;
    const Result r = measure_components(s, job);
    EXPECT_EQ(job.done, components_steps(s));
    // The camera sees the panel, 240 mm wide, in a frame of 247.2 mm: squares of 4 lenses = 24 mm are 46.6 pixels wide, and the
    // board's corner is the panel's.
    const Image& seen = named(r, "components-diffuser");
    const double per_mm = 480 / resolve(d).frame_width_mm;
    int wrong = 0;
    for (int k = 0; k < 10; ++k)
        for (int j = 0; j < 6; ++j) {
            const int x = int(240 + (-120 + 24 * k + 12) * per_mm), y = int(144 + (-72 + 24 * j + 12) * per_mm);
            const float corner = seen.at(int(240 - 108 * per_mm), int(144 - 60 * per_mm))[1];
            wrong += std::abs(seen.at(x, y)[1] - ((k + j) % 2 ? 1 - corner : corner)) > 0.01f;
        }
    EXPECT_EQ(wrong, 0);
}

TEST(Components, WithoutLensesThereAreNoErrorsOfTheirs) {
    Display d = analysis_example::display(40, 60);
    d.diffuser = Diffuser{1, {2, 2}};
    const auto alone = [](const Display& display) {
        Subject s = subject(display);
        CountedSteps job;
        return named(measure_components(s, job), "components-diffuser");
    };
    const Image without = alone(d);
    d.errors.shift_mm = {0.5, 0};
    d.errors.given = std::make_shared<const std::vector<GivenLensError>>(
        std::vector<GivenLensError>{{0, 0, {{0.1, 0}}}, {3, 2, {{0, 0.1}}}});  // lens (3, 2) is beyond an array of one
    EXPECT_EQ(alone(d).rgb, without.rgb);
}

TEST(Components, WithoutADiffuserThatPictureIsLeftOut) {
    Display d = analysis_example::display(40, 60);
    d.diffuser.reset();
    Subject s = subject(d);
    CountedSteps job;
    const Result r = measure_components(s, job);
    EXPECT_EQ(job.done, components_steps(s));
    EXPECT_THROW(named(r, "components-diffuser"), std::runtime_error);
    EXPECT_FALSE(r.remarks.empty());
}

TEST(Directions, SheetsAndFramesAreThere) {
    Subject s = subject(analysis_example::display(40, 60));
    CountedSteps job;
    const Result r = measure_directions(s, job);
    EXPECT_EQ(job.done, directions_steps(s));
    EXPECT_EQ(r.pictures.size(), 2u);
    ASSERT_EQ(r.animations.size(), 1u);
    const std::vector<Image>& frames = r.animations[0].frames;
    ASSERT_GE(frames.size(), 24u);
    for (const Image& f : frames) EXPECT_EQ(f.width, frames[0].width);
    EXPECT_NE(frames[0].rgb, frames[frames.size() / 4].rgb);
}

}  // namespace
}  // namespace lfdsim
