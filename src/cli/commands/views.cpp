#include "base/output_file.h"
#include "cli/options/display_options.h"
#include "cli/options/grid_options.h"
#include "cli/options/panel_source.h"
#include "cli/options/shown_panel.h"
#include "cli/options/work_options.h"
#include "cli/output/companion.h"
#include "cli/output/rendered.h"
#include "cli/output/views_folder.h"
#include "cli/program/arguments.h"
#include "cli/program/commands.h"
#include "cli/program/effects.h"
#include "cli/program/input_files.h"
#include "cli/program/interrupt.h"
#include "display/keys.h"
#include "engine/devices/memory.h"
#include "engine/views/grid_view.h"
#include "files/description/display_file.h"
#include "report/folder/folder_lock.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>

// lfdsim views: writes a grid of views, or a quilt, of the content or of what the simulated display shows (docs/views.md).
namespace lfdsim::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t content_rays = 4;       // a pixel, if neither --samples nor render.samples is given
constexpr std::int64_t default_columns = 480;  // pixels of a view along its width

struct ViewsArguments {
    Command command;
    DisplayOptions display{command, {sample_options, content_options}};
    PanelImageOption panel_image{command};
    ModelOption model{command};
    PatternOption pattern{command};
    GridOptions grid{command};
    OutputOptions output{command,
                         "a quilt, NAME_qs8x6a0.75 with .png .exr .npy; or a folder for a grid of views, created if missing"};
    DeviceOption device{command};
    WorkOptions work{command};
    Flag resume = command.flag("--resume", "Skip views in the folder that the same command has already made from the same files");
    Flag replace =
        command.flag("--replace", "Remove views there that another command has made, or overwrite the .toml beside a quilt");
    Option of_what =
        command.option("--of", "content|display", "Views of the content itself, or of what the simulated display shows")
            .initially("content")
            .shown();
    Option count = command.option(
        "--grid", "CxR", "Columns and rows of views in a folder; default 9x9, for strips 9x1 or, where they lie flat, 1x9");
    Option size = command.option("--view-size", "WxH", "Pixels of a view; default 480 wide");
    Option kind = command.option("--views-as", "png|exr|npy", "Files in the folder").initially("png").shown();
    Flag depth = command.flag("--depth", "Write a depth map for each view of the content, too");

    bool of_display() const { return of_what.text() == "display"; }
};

/// The output of the views, and their number.
struct Target {
    bool quilt = false;         // one picture; else a folder
    QuiltName name{};           // of a quilt
    int columns = 9, rows = 9;  // of the grid of cameras; a quilt is one row of them, broken into its tiles
    int width = 0, height = 0;  // of a view, pixels
    std::string how;            // the view cone by which the cameras are placed, as of views_toml(); empty: no cone
};

/// The output that the options ask for, without width, height and how, which grid_of() sets. Throws InputError.
Target target_of(const ViewsArguments& args, const Display& display) {
    Target target;
    const fs::path path = args.output.path();
    const std::string kind = path.extension();
    target.quilt = kind == ".png" || kind == ".exr" || kind == ".npy";
    Faults faults;
    faults.of([&] { args.kind.word(); });
    if (target.quilt) {  // its name gives the number of views
        faults.of([&] {
            const std::optional<QuiltName> name = quilt_name(path);
            if (!name)
                throw InputError(
                    path.string(),
                    fmt::format(
                        "a quilt's name gives columns, rows and the aspect of a view, as in {}_qs8x6a0.75{}; or give a folder",
                        path.stem().string(), kind));
            target.name = *name;
            target.columns = name->columns * name->rows;
            target.rows = 1;
        });
        for (const auto& [option, given] :
             {std::pair("--grid", !args.count.empty()), {"--depth", bool(args.depth)}, {"--resume", bool(args.resume)}})
            if (given) faults.of([o = option] { throw InputError(o, "is for views in a folder, not for a quilt"); });
        faults.of([&] { check_output(path); });
        faults.of([&] { args.output.check_bits(path); });
    } else {
        faults.of([&] {
            if (quilt_name(path) || kind == ".jpg" || kind == ".jpeg" || kind == ".tif" || kind == ".tiff")
                throw InputError(path.string(), "a quilt's name ends in .png, .exr or .npy; give one of these, or a folder");
        });
        if (is_strips(display.array))
            (line_of_eyes(make_lattice(display.panel, display.array)) == 1 ? target.columns : target.rows) = 1;
        faults.of(args.count, [&] {
            const auto [columns, rows] = args.count.size();
            if (columns > most_views_a_side || rows > most_views_a_side || columns * rows > most_views)
                throw InputError("--grid", fmt::format("is {}; allowed are {} along each side and {} in all", args.count.text(),
                                                       most_views_a_side, most_views));
            target.columns = int(columns);
            target.rows = int(rows);
        });
        faults.of([&] { args.output.check_bits("view." + args.kind.text()); });
        faults.of([&] {
            check_folder(path);
            check_resume(args.resume, args.kind.text());
        });
    }
    faults.report();
    return target;
}

/// The grid that is asked for: by default the cameras of a view cone as wide as the lenses' field of view, at the viewing distance.
/// Completes `target`. Throws InputError for impossible sizes and grids, and if the memory does not suffice.
ViewGrid grid_of(const ViewsWish& wish, Target& target, const ViewsArguments& args, const Display& display,
                 const Geometry& geometry) {
    // Pixels of a view: the aspect (width / height) is that of the quilt's name, of --view-size, or of the panel.
    double aspect = geometry.panel_width_mm / geometry.panel_height_mm;
    if (target.quilt) aspect = target.name.aspect;
    if (!args.size.empty()) {
        const auto [width, height] = args.size.size();
        if (!target.quilt) aspect = double(width) / double(height);
        if (double(width) * double(height) >= two_to_31 || std::max(width, height) > 1 << 20)
            throw InputError("--view-size", fmt::format("is {}; allowed is up to {} along each side and a product below 2^31",
                                                        args.size.text(), 1 << 20));
        target.width = int(width);
        target.height = int(height);
    } else {
        target.width = int(default_columns);
        target.height = std::max(1, int(std::lround(default_columns / aspect)));
    }
    const std::int64_t columns = std::int64_t(target.width) * (target.quilt ? target.name.columns : 1),
                       rows = std::int64_t(target.height) * (target.quilt ? target.name.rows : 1);
    if (double(columns) * double(rows) >= two_to_31)
        throw InputError("--view-size",
                         fmt::format("makes a quilt of {} x {} pixels; allowed is a product below 2^31", columns, rows));
    require_picture_memory(columns, rows, args.of_display() ? texel_bytes(display) : 0);

    // The cameras: views that are to be made are placed by the same rules as views that are read.
    ViewsSource all;
    all.name = "the grid";
    if (target.quilt) all.form = ViewsForm::quilt;
    all.columns = target.columns;
    all.rows = target.rows;
    if (target.columns > 1 || target.rows > 1) {
        const Theory of_display = theory(display, geometry);
        const double strips_deg = of_display.fov_of_eyes_deg, lenses_deg = of_display.along[0].fov_deg;
        const double fov = display.content.view_cone_deg.value_or(is_strips(display.array) ? strips_deg : lenses_deg);
        if (std::isfinite(fov) && fov > 0 && fov < 170) all.cone_deg = fov;
    }
    if (!wish.baseline_mm && (wish.cone_deg || all.cone_deg))
        target.how =
            fmt::format("view_cone_deg = {:.8g}, cone = \"{}\"", wish.cone_deg ? *wish.cone_deg : *all.cone_deg,
                        cone_camera_words[std::size_t(wish.cone.value_or(target.quilt ? ConeCameras::ends : ConeCameras::bins))]);
    std::vector<std::string> notes;
    const ViewsPlace place = views_place(display, geometry);
    const ViewGrid grid = placed(all, wish, place, aspect, notes);
    // At the edge of its zone an eye sees the views of two neighbouring elemental images.
    const double outermost = grid.camera(grid.columns - 1, 0)[0];
    if (args.of_display() && grid.columns > 1 && outermost > 0.499 * place.zone_width_mm)
        spdlog::warn(
            "the outermost cameras are {:.4g} mm off axis, at the edge of the zone of {:.4g} mm or beyond it, where the display's "
            "views flip; --cone bins puts them half a step further in, --view-cone-deg chooses another angle",
            outermost, place.zone_width_mm);
    return grid;
}

/// Makes the views of a grid. All arguments have to outlive it.
class ViewsMaker {
  public:
    /// Throws InputError if views are of the display and a camera of the grid is within it, or too far aside to see it.
    ViewsMaker(const ViewsArguments& args, const Display& display, const Geometry& geometry, const ViewGrid& grid,
               const Target& target, std::string device)
        : args_(args), display_(display), geometry_(geometry), grid_(grid), target_(target), device_(std::move(device)) {
        if (of_display())
            for (int row = 0; row < grid.rows; ++row)
                for (int column = 0; column < grid.columns; ++column)
                    grid_camera(display, geometry, grid, column, row, target.width, target.height);
    }
    bool of_display() const { return args_.of_display(); }

    /// Loads the content, or makes the panel's light that views of the display show. Throws InputError, and Interrupted.
    void prepare(const PatternOptions& pattern_options, Progress& progress) {
        if (!of_display()) {
            scene_.emplace(load_scene(display_, geometry_));
            return;
        }
        light_ =
            shown_panel(args_.panel_image, args_.pattern, display_, geometry_, pattern_options, args_.work.threads(), progress);
        panel_.emplace(light_.texels, args_.work.threads());
    }
    /// The view of a camera of the grid, linear light, after prepare().
    Picture view(int column, int row, Job& job) {
        if (scene_) return scene_view(*scene_, geometry_, grid_, column, row, making(), job);
        RenderOptions options;
        options.threads = args_.work.threads();
        options.device = device_;
        Rendering r = grid_view(grid_camera(display_, geometry_, grid_, column, row, target_.width, target_.height), *panel_,
                                target_.width, target_.height, options, job);
        if (const double error = r.measured_error.value_or(0); error >= largest_error_) {  // the view that is reported
            largest_error_ = error;
            how_ = "; " + how_made(r);
            how_json_ = how_made_json(r);
        }
        return {std::move(r.image), r.complete, r.samples, 0, r.seconds};
    }
    /// The depth map of a view of the content.
    Picture depth(int column, int row, Job& job) const {
        return scene_view_depth(*scene_, geometry_, grid_, column, row, making(), job);
    }
    const PanelTexels& light() const { return light_; }  // that views of the display show
    const std::string& how() const { return how_; }      // that view of the display was rendered whose error is the largest
    const Json& how_json() const { return how_json_; }
    const std::vector<std::string>& files() const { return scene_ ? scene_->files() : light_.files; }

  private:
    ViewMaking making() const {
        return {target_.width, target_.height, display_.render.samples.value_or(content_rays), args_.work.threads()};
    }
    const ViewsArguments& args_;
    const Display& display_;
    const Geometry& geometry_;
    const ViewGrid& grid_;
    const Target& target_;
    const std::string device_;
    std::optional<ContentScene> scene_;
    PanelTexels light_;
    std::optional<SummedPanel> panel_;
    double largest_error_ = 0;
    std::string how_;
    Json how_json_ = Json::object();
};

/// Adds the rays and seconds of a view to those of all.
Picture& add(Picture& all, const Picture& one) {
    all.rays += one.rays;
    all.seconds += one.seconds;
    return all;
}

fs::path beside_quilt(const ViewsArguments& args) { return fs::path(args.output.path()).replace_extension(".toml"); }

/// Writes the quilt and, beside it, NAME.toml with its geometry. The first view is the tile at the lower left, and rows of tiles go
/// up (docs/views.md). Adds to `more` what --json has of light that is cut off. Throws Interrupted.
Picture make_quilt(ViewsMaker& maker, const ViewsArguments& args, const Display& display, const ViewGrid& grid,
                   const Target& target, Progress& progress, Json& more) {
    Picture all{Image(target.width * target.name.columns, target.height * target.name.rows)};
    progress.stage("views", grid.columns);
    Quiet one(progress);
    for (int n = 0; n < grid.columns; ++n) {
        const Picture view = maker.view(n, 0, one);
        if (!view.complete) end_interrupted();
        const int left = n % target.name.columns * target.width,
                  top = (target.name.rows - 1 - n / target.name.columns) * target.height;
        for (int y = 0; y < target.height; ++y)
            std::copy_n(view.image.at(0, y), std::size_t(target.width) * 3, all.image.at(left, top + y));
        add(all, view);
        progress.advance(1);
    }
    more.update(
        args.output.write(all.image, Encoding::srgb, display, {{"seconds", fmt::format("{:.3f}", all.seconds)}}, true, progress));
    write_text(beside_quilt(args), views_toml(grid, "", "", target.how));
    return all;
}

/// Writes view_0000.png ..., a depth map for each if asked for, and views.toml. The returned picture has the size of a view, and no
/// pixels. Adds to `more` as make_quilt() does. Throws Interrupted.
Picture make_folder(ViewsMaker& maker, const ViewsArguments& args, const Display& display, const ViewGrid& grid,
                    const Target& target, const ViewsFolder& folder, Progress& progress, Json& more) {
    const FolderLock lock(args.output.path());
    folder.check();
    const NumberedPictures& pictures = folder.pictures();
    const std::vector<std::int64_t> left = pictures.left();
    const std::string shown = pictures.shown_with(maker.files());
    Picture all;
    CutOff cut;
    all.image.width = target.width;
    all.image.height = target.height;
    const auto views = std::int64_t(grid.views()), of_each = pictures.count / views;
    progress.stage("views", views);
    Quiet one(progress);
    auto next = left.begin();
    for (std::int64_t view = 0; view < views; ++view, progress.advance(1))
        for (; next != left.end() && *next / of_each == view; ++next) {
            const int column = int(view % grid.columns), row = int(view / grid.columns);
            const bool is_view = *next % of_each == 0;
            const Picture made = is_view ? maker.view(column, row, one) : maker.depth(column, row, one);
            if (!made.complete) folder.stop();
            cut += args.output.save(pictures.file(*next), made.image, is_view ? Encoding::srgb : Encoding::linear, display,
                                    {{"shown", shown}});
            if (is_view) add(all, made);
        }
    progress.end();
    more.update(args.output.warn(cut));
    write_text(folder.toml_file(), folder.toml());
    return all;
}

void run(const ViewsArguments& args) {
    Faults faults;
    Display display;
    PatternOptions pattern_options;
    ViewsWish wish;
    Target target;
    std::string device;
    faults.of([&] { display = args.display.read(); });
    faults.of([&] { args.panel_image.check(); });
    faults.of([&] { pattern_options = args.pattern.read(); });
    faults.of([&] { wish = args.grid.read(); });
    faults.of([&] { args.of_what.word(); });
    faults.of([&] { args.model.apply(display); });
    faults.of([&] { device = args.device.read(); });
    faults.of([&] { args.work.check(); });
    faults.of([&] { check_effects(args.command); });
    faults.of([&] {
        if (!args.of_display() && (args.panel_image.given() || args.pattern.given()))
            throw InputError(args.pattern.given() ? "--pattern" : "--panel-image", "is what the display shows; add --of display");
        for (const char* option : {"--estimator", "--seed", "--sampling", "--device", "--pickup"})
            if (!args.of_display() && args.command.given(option))
                throw InputError(option, "is for what the display shows; add --of display");
        if (args.of_display() && args.depth)
            throw InputError("--depth", "is for views of the content; views of the display have no depth map");
    });
    faults.of([&] { target = target_of(args, display); });
    faults.report();

    // Outputs are checked before the content is loaded.
    const Geometry geometry = resolve(display);
    const ViewGrid grid = grid_of(wish, target, args, display, geometry);
    if (args.of_display() && !args.panel_image.given()) require_panel_memory(display);
    ViewsMaker maker(args, display, geometry, grid, target, device);
    const ViewsFolder folder(args.output.path(), args.kind.text(), args.depth, grid, target.how, write_display(display),
                             shown_stamps(args.panel_image, args.pattern, display), args.resume, args.replace);
    if (target.quilt)
        check_companion(beside_quilt(args), holds(beside_quilt(args), views_toml(grid, "", "", target.how)), args.replace);
    else
        folder.check();
    Progress progress(args.work.progress());
    maker.prepare(pattern_options, progress);
    Json cut_off = Json::object();
    const Picture made = target.quilt ? make_quilt(maker, args, display, grid, target, progress, cut_off)
                                      : make_folder(maker, args, display, grid, target, folder, progress, cut_off);
    Json more{{"of", args.of_what.text()}, {"views", grid_json(grid)}};
    more.update(cut_off);
    more.update(maker.light().made);
    more.update(maker.how_json());
    print_made(PictureMade{args.output.path(), made.image.width, made.image.height, maker.of_display() ? "samples" : "rays",
                           made.rays, made.seconds},
               args.work.json(), "; " + grid_text(grid) + maker.how() + maker.light().text, more);
}

}  // namespace

CommandSpec views_command() {
    return {.name = "views",
            .summary = "Writes a grid of views or a quilt: of the content, or of what the simulated display shows",
            .examples =
                "Examples:\n  lfdsim views display.toml --model monkey.blend --grid 9x9 -o monkey\n"
                "  lfdsim views display.toml --view-cone-deg 40 --view-size 420x560 -o monkey_qs8x6a0.75.png\n"
                "  lfdsim views display.toml --of display --panel-image eia.png --grid 5x1 -o shown\n"
                "Views of the content have --samples rays a pixel, 4 if neither that nor render.samples is given.",
            .run = with_options<ViewsArguments>(run)};
}

}  // namespace lfdsim::cli
