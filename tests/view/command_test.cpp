#include "view/answers/command.h"

#include <gmock/gmock.h>
#include <fstream>

#include "content/content.h"
#include "engine/render.h"
#include "folder.h"
#include "image/formats/encoder.h"
#include "image/formats/image_file.h"

namespace lfdsim::view {
namespace {
namespace fs = std::filesystem;
using testing::HasSubstr;

std::vector<std::uint8_t> codes(const Image& image) {
    const Encoder8& code = Encoder8::of(Encoding::srgb);
    std::vector<std::uint8_t> all;
    for (const float light : image.rgb) all.push_back(std::uint8_t(code(light)));
    return all;
}

// The command, run by a shell in the folder where the program was started, makes the pictures that the engine makes.
class CommandTest : public FolderTest {
  protected:
    void SetUp() override {
        FolderTest::SetUp();
        before = fs::current_path();
        fs::current_path(folder);
    }
    void TearDown() override {
        fs::current_path(before);
        FolderTest::TearDown();
    }
    static Wanted wanted(Shown shown) {
        Wanted w;
        w.eye_mm = {30, -20, 590};
        w.size = {96, 54};
        w.set = {"array.gap_mm=10.5", "lens.facing=panel", "render.samples=4"};
        w.shown = std::move(shown);
        return w;
    }
    static void run(const Library& library, const Wanted& w) {
        const std::string text = command(library, w);
        const std::string all = "PATH=" LFDSIM_BINARY_DIR ":$PATH; { " + text + "; } >said 2>&1";
        ASSERT_EQ(std::system(all.c_str()), 0) << text << std::ifstream("said").rdbuf();
    }
    static void expect_same(const Display& d, const Texels& panel, const char* file) {
        Job job;
        const Image made = render(d, resolve(d), panel, {}, job).image;
        EXPECT_EQ(codes(made), codes(read_image(file, Encoding::srgb))) << file;
        EXPECT_GT(*std::max_element(made.rgb.begin(), made.rgb.end()), 0.05f);
    }
    static Texels elemental(Display d) {
        Job job;
        const Geometry g = resolve(d);
        return shown_texels(elemental_images(d, g, ContentScene(built_in_model(), d, g), 0, job).image, d.panel.encoding);
    }
    fs::path before;
};

TEST_F(CommandTest, OfAModelHasThePicture) {
    const Library library({"small.toml", {"content.height_mm=60"}, "", "", ""}, ".");
    const Wanted w = wanted({Shown::Kind::model, "built-in:spheres", false});
    EXPECT_THAT(command(library, w),
                testing::StartsWith("lfdsim render small.toml --set content.height_mm=60 --set array.gap_mm=10.5"));
    run(library, w);
    const Display d = library.display(w);
    expect_same(d, elemental(d), "view.png");
}

TEST_F(CommandTest, OfTwoEyesHasBoth) {
    const Library library({"small.toml", {}, "built-in:spheres", "", ""}, ".");
    Wanted w = wanted({});
    w.layout = Layout::crossed;
    run(library, w);
    expect_same(library.display(w, -1), elemental(library.display(w)), "left.png");
    expect_same(library.display(w, 1), elemental(library.display(w)), "right.png");
}

TEST_F(CommandTest, HoldsElementalImagesAsTheyWere) {
    const Library library({"small.toml", {}, "built-in:spheres", "", ""}, ".");
    Wanted w = wanted({Shown::Kind::start, "", true});
    run(library, w);
    Wanted described = w;
    described.set.clear();
    expect_same(library.display(w), elemental(library.display(described)), "view.png");
    EXPECT_THAT(command(library, w), HasSubstr(" && "));
}

TEST_F(CommandTest, QuotesNames) {
    fs::create_directory("my 'own' $HOME");
    fs::copy_file("small.toml", "my 'own' $HOME/-x.toml");
    fs::copy_file("small.toml", "-x.toml");
    const Library library({"small.toml", {}, "", "", "checkerboard"}, ".");
    Display d = library.display(wanted({}));
    const Image checks = pattern("checkerboard", d, resolve(d));
    write_image("my 'own' $HOME/panel.png", checks);
    for (const char* display : {"my 'own' $HOME/-x.toml", "-x.toml"}) {
        Wanted w = wanted({});
        w.display = display;
        w.set.push_back("name=it's; exit 1");
        run(library, w);
        expect_same(library.display(w), shown_texels(checks, Encoding::srgb), "view.png");
        fs::remove("view.png");
        w.shown = {Shown::Kind::panel_image, "my 'own' $HOME/panel.png", true};
        run(library, w);
        expect_same(library.display(w), shown_texels(checks, Encoding::srgb), "view.png");
    }
    EXPECT_THROW(command(library, wanted({Shown::Kind::model, "none.obj", false})), InputError);
}

}  // namespace
}  // namespace lfdsim::view
