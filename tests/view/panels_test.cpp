#include "view/painting/panels.h"
#include "analysis/core/elemental_panel.h"
#include "engine/estimator/panel_planes.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <algorithm>
#include <set>

#include "content/models/memory.h"
#include "display/keys.h"
#include "optics/traced_display.h"
#include "visit.h"

namespace lfdsim::view {
namespace {
using namespace test;

class PanelsTest : public testing::Test {
  protected:
    PanelsTest() { lfdsim::test::save(folder / "small.toml", tiny_display); }
    std::shared_ptr<const ShownPanel> get(const Display& d, const PanelContent& source = {Shown::Kind::model, "built-in:spheres"}) {
        Job job;
        return panels.get(panel_key(source, d, resolve(d)), d, resolve(d), 2, job);
    }
    Display display(const std::vector<std::string>& set = {}) const { return read_display(folder / "small.toml", set); }

    void tell_apart(const PanelContent&, const Display& before, int least_changed, int least_told_apart);

    TemporaryFolder folder;
    Panels panels;
};

TEST_F(PanelsTest, KeepsTheThreeUsedLast) {
    const auto first = get(display()), second = get(display({"array.gap_mm=6.6"}));
    EXPECT_EQ(get(display({"camera.position_mm=[9, 9, 700]", "render.samples=9", "diffuser.distance_mm=61"})), first);
    get(display({"array.gap_mm=6.7"}));
    EXPECT_EQ(get(display()), first);
    get(display({"array.gap_mm=6.8"}));
    EXPECT_EQ(panels.kept().panels, 3u);
    EXPECT_EQ(get(display()), first);
    EXPECT_NE(get(display({"array.gap_mm=6.6"})), second);
    EXPECT_EQ(panels.kept().scenes, 1u);  // the model is as high, tilted and turned in all
}

TEST_F(PanelsTest, AFileThatChangesIsReadAgain) {
    Image image(480, 270);
    write_image(folder / "panel.png", image);
    const Library library({folder / "small.toml", {}, "", "", ""}, folder.path());
    const Shown shown{Shown::Kind::panel_image, "panel.png"};
    const auto black = get(display(), source_of(library, shown, display()));
    EXPECT_EQ(get(display({"array.gap_mm=7"}), source_of(library, shown, display())), black);
    std::fill(image.rgb.begin(), image.rgb.end(), 1.f);
    std::filesystem::remove(folder / "panel.png");
    write_image(folder / "panel.png", image);
    const auto white = get(display(), source_of(library, shown, display()));
    EXPECT_EQ(planes_of(white->summed())[0].texels[0], 1);
}

TEST_F(PanelsTest, ScenesThatAreMovedAreThoseMadeThere) {
    Job job;
    const PanelContent spheres{Shown::Kind::model, "built-in:spheres"};
    for (const std::vector<std::string>& set : {std::vector<std::string>{}, {"array.gap_mm=7.2"}, {"content.depth_mm=-30.0"}}) {
        const Display d = display(set);
        const ContentScene made(built_in_model(), d, resolve(d)), kept = panels.scene(spheres, d, resolve(d), job);
        EXPECT_EQ(elemental_images(d, resolve(d), kept, 2, job).image.rgb, elemental_images(d, resolve(d), made, 2, job).image.rgb);
    }
    EXPECT_EQ(panels.kept().scenes, 1u);
}

// Each number and word of a description is changed in turn. Elemental images that differ must have another key, lest a wrong panel
// be shown; that equal ones share a key saves time, and must hold where a visitor turns a knob most: eye, diffuser, samples.
void PanelsTest::tell_apart(const PanelContent& source, const Display& before, int least_changed, int least_told_apart) {
    Job job;
    const PanelKey key = panel_key(source, before, resolve(before));
    const auto images = [&](const Display& d) {
        const Picture p = elemental_images(d, resolve(d), panels.scene(source, d, resolve(d), job), 2, job);
        return std::make_pair(encode8(p.image, d.panel.encoding), d.panel);
    };
    const auto as_before = images(before);
    int changed = 0, told_apart = 0;
    const auto judge = [&](const std::string& name, const Display& d) {
        if (d == before || !validate(d).empty()) return;
        ++changed;
        const PanelKey other = panel_key(source, d, resolve(d));
        if (d.content.pickup == PickupKind::inverse) {  // takes long, and depends on nearly all
            EXPECT_FALSE(other == key);
            return;
        }
        const auto now = images(d);
        const bool equal = now.first == as_before.first && now.second.pixels == as_before.second.pixels &&
                           now.second.encoding == as_before.second.encoding;
        if (!equal) ++told_apart;
        EXPECT_TRUE(equal || !(other == key)) << name << " changes the elemental images";
        const bool of_the_view = name.starts_with("camera.") || name.starts_with("diffuser.") || name.starts_with("render.");
        EXPECT_TRUE(!of_the_view || other == key) << name << " makes them again in vain";
    };
    Display d = before;
    const auto change_field = [&](const std::string& name, auto& field) {
        const auto change = [&](auto& v) {
            const auto old = v;
            using Value = std::remove_cvref_t<decltype(v)>;
            if constexpr (std::is_floating_point_v<Value>)
                for (const double to : {v * 1.01 + 0.01, v * 0.99 - 0.01}) v = to, judge(name, d);
            else if constexpr (std::is_same_v<Value, std::int64_t>)
                for (const std::int64_t to : {v + 1, v - 1}) v = to, judge(name, d);
            else if constexpr (std::is_enum_v<Value>)
                for (std::size_t k = 0; k < words<Value>().size(); ++k) v = Value(k), judge(name, d);
            v = old;
        };
        using Field = std::remove_cvref_t<decltype(field)>;
        const Field old = field;
        if constexpr (std::is_same_v<Field, std::optional<double>>) {
            for (const double to : {0.5, 3., 40., 450.}) field = field.value_or(to), change(*field), field = old;
        } else if constexpr (std::is_same_v<Field, std::optional<std::int64_t>>) {
            field = field.value_or(16), judge(name, d), change(*field);
        } else if constexpr (requires { field.size(); } && !std::is_same_v<Field, std::string>) {
            for (auto& part : field) change(part);
        } else {
            change(field);
        }
        field = old;
    };
    visit_all(d, [&](const std::string& path, const KeyInfo&, ValueRef value) {
        std::visit([&](auto* field) { change_field(path, *field); }, value);
    });
    EXPECT_GT(changed, least_changed);
    EXPECT_GT(told_apart, least_told_apart);
}

/// A hilly square of 2 n^2 triangles.
void save_hills(const std::filesystem::path& path, int n) {
    std::string text;
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j) text += fmt::format("v {} {} {}\n", i, j, (7 * i + 3 * j) % 5);
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const int a = i * (n + 1) + j + 1;
            text += fmt::format("f {} {} {}\nf {} {} {}\n", a, a + 1, a + n + 2, a, a + n + 2, a + n + 1);
        }
    lfdsim::test::save(path, text);
}

TEST_F(PanelsTest, ModelsAndTheirTreesAreInTheBudget) {
    const Display d = display();
    const Geometry g = resolve(d);
    Job job;
    for (const char* name : {"a.obj", "b.obj"}) save_hills(folder / name, 60);
    const PanelContent a = model_source(folder / "a.obj", d), b = model_source(folder / "b.obj", d);
    constexpr double all = 1200e6;
    double model = 0, tree = 0;
    {
        Panels some(all);
        const ContentParts parts = some.parts(a, d, job);
        model = all - some.budget().left();
        EXPECT_EQ(model, bytes_of(parts));
        EXPECT_GT(model, 7200 * 16 + 3600 * 32);
        const ContentScene scene = some.scene(a, d, g, job);
        tree = all - some.budget().left() - model;
        EXPECT_EQ(tree, bytes_of(scene));
        EXPECT_GT(tree, 7200 * 60);
        EXPECT_LT(tree, making_scene_bytes(parts, d));
    }
    // Idle ones give way to new ones.
    Panels few(model + tree + 520e6);
    static_cast<void>(few.scene(a, d, g, job));
    static_cast<void>(few.scene(b, d, g, job));
    EXPECT_EQ(few.kept().scenes, 1u);
    // Those in use do not, and the error names both figures.
    const ContentScene held = few.scene(a, d, g, job);
    const auto claim = few.budget().claim("", "", few.budget().left() - 5e6);
    try {
        static_cast<void>(few.scene(b, d, g, job));
        ADD_FAILURE();
    } catch (const InputError& error) {
        EXPECT_EQ(error.problems[0].where, "content.model");
        EXPECT_THAT(error.problems[0].what, testing::MatchesRegex("reading a model needs 512 MB of memory; .* has 5 MB free"));
    }
}

TEST_F(PanelsTest, ATreeThatDoesNotFitIsRefused) {
    const Display d = display();
    Job job;
    save_hills(folder / "hills.obj", 150);
    const PanelContent hills = model_source(folder / "hills.obj", d);
    Panels few(1200e6);
    static_cast<void>(few.parts(hills, d, job));
    const auto claim = few.budget().claim("", "", few.budget().left() - 2e6);
    try {
        static_cast<void>(few.scene(hills, d, resolve(d), job));
        ADD_FAILURE();
    } catch (const InputError& error) {
        EXPECT_THAT(error.problems[0].what, testing::StartsWith("showing 45000 triangles needs 8 MB of memory; "));
    }
    EXPECT_EQ(few.kept().scenes, 0u);
}

TEST_F(PanelsTest, KeyTellsElementalImagesApart) {
    const Display d = display({"panel.pixels=[192, 108]", "panel.pixel_pitch_mm=0.5"});  // few, to be quick
    tell_apart({Shown::Kind::model, "built-in:spheres"}, d, 40, 15);
}

TEST_F(PanelsTest, KeyTellsElementalImagesForTheRealLensApart) {
    // Strips, whose table is short.
    const Display d =
        display({"panel.pixels=[96, 54]", "panel.pixel_pitch_mm=1", "content.pickup=\"traced\"", "array.lattice=\"strips\"",
                 "array.slant_deg=12", "array.count=none", "array.aperture=\"cell\"", "array.surround=\"plate\""});
    tell_apart({Shown::Kind::model, "built-in:spheres"}, d, 40, 15);
}

Display with_objects(Display d, const std::filesystem::path& image) {
    d.content.model.clear();
    for (const double z : {-20., 15.}) {
        SceneObject object;
        (z < 0 ? object.model : object.image) = z < 0 ? std::string(built_in_spheres) : image.string();
        object.height_mm = 30;
        object.position_mm = {z, 1, z};
        if (z < 0) object.colour = Vec3d{0.9, 0.5, 0.2};
        d.content.objects.push_back(object);
    }
    return d;
}

TEST_F(PanelsTest, KeyTellsScenesApart) {
    Image image(8, 8);
    std::fill(image.rgb.begin(), image.rgb.end(), 0.7f);
    write_image(folder / "grey.png", image);
    const Display d = with_objects(display({"panel.pixels=[192, 108]", "panel.pixel_pitch_mm=0.5"}), folder / "grey.png");
    tell_apart(model_source(model_of(d), d), d, 60, 40);
}

TEST_F(PanelsTest, AnImageOfASceneThatChangesIsReadAgain) {
    Image image(8, 8);
    write_image(folder / "grey.png", image);
    const Display d = with_objects(display({"panel.pixels=[192, 108]", "panel.pixel_pitch_mm=0.5"}), folder / "grey.png");
    const PanelContent before = model_source(model_of(d), d);
    const auto black = get(d, before);
    EXPECT_EQ(get(d, model_source(model_of(d), d)), black);
    std::fill(image.rgb.begin(), image.rgb.end(), 0.7f);
    std::filesystem::remove(folder / "grey.png");
    write_image(folder / "grey.png", image);
    const auto grey = get(d, model_source(model_of(d), d));
    EXPECT_NE(grey, black);
}

}  // namespace
}  // namespace lfdsim::view
