#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/output.h"
#include "content/content.h"
#include "files/display_file.h"
#include "files/shell.h"
#include "files/write_first_order.h"
#include "image/file.h"
#include "model/first_order.h"
#include "model/keys.h"

#include <fmt/format.h>

// lfdsim new: a commented description of a first-order design.
namespace lfdsim::cli {
namespace {

struct NewArguments {
    std::string panel_inch, pixels, fov_deg = "30", distance_mm, depth_mm, lens = "plano_convex", output;
    bool force = false;
};

DesignRequest request_of(const NewArguments& args) {
    DesignRequest request;
    Faults faults;
    faults.of([&] { request.panel_inch = number("--panel-inch", args.panel_inch); });
    faults.of([&] { request.pixels = size("--pixels", args.pixels); });
    faults.of([&] { request.fov_deg = number("--fov-deg", args.fov_deg); });
    faults.of([&] { request.distance_mm = number("--distance-mm", args.distance_mm); });
    if (!args.depth_mm.empty()) faults.of([&] { request.depth_mm = number("--depth-mm", args.depth_mm); });
    faults.of([&] {
        if (word("--lens", args.lens, {"plano_convex", "ideal"}) == "ideal") request.lens = LensType::ideal;
    });
    faults.report();
    return request;
}

void check_free(const NewArguments& args) {
    if (args.output.empty()) throw InputError("--output", "the name is empty; give the file to write");
    const std::filesystem::path path = args.output;
    guard_output(path);
    detail::check_replaceable(path);
    if (path.extension() != ".toml")
        throw InputError("--output", fmt::format("{}: a description's name ends in .toml", args.output));
    std::error_code error;
    if (!args.force && std::filesystem::exists(std::filesystem::symlink_status(path, error)))
        throw InputError("--output", fmt::format("{} already exists; --force replaces it", args.output));
}

void run(const NewArguments& args) {
    Faults faults;
    FirstOrder made;
    faults.of([&] { made = first_order(request_of(args)); });
    faults.of([&] { check_free(args); });
    faults.report();
    made.display.name = std::filesystem::path(args.output).stem();
    made.display.content.model = built_in_spheres;

    const std::string text = write_first_order(made, command_line());
    try {
        parse_display(text, args.output);
    } catch (const InputError&) {  // all else of the text is ours
        throw InputError("--output", "the name is not UTF-8, so the description could not be read; give another one");
    }
    detail::OutputFile file(args.output);
    file.write(text.data(), text.size());
    file.commit();
    const Display& d = made.display;
    const std::string name = shell_file(args.output);
    print(
        fmt::format("{}: {} x {} lenses of {:.4g} mm, {} x {} views over {:g} degrees, central depth plane at {:g} mm\n"
                    "Next: lfdsim check {}, lfdsim view {}\n",
                    args.output, (*d.array.count)[0], (*d.array.count)[1], d.array.pitch_mm[0], made.views, made.views,
                    made.request.fov_deg, *made.request.depth_mm, name, name));
}

}  // namespace

void add_new(Command program) {
    const auto args = std::make_shared<NewArguments>();
    Command command = program.add_subcommand("new", "Writes a commented description of a first design to start from");
    command.add_option("--panel-inch", args->panel_inch, "Diagonal of the panel").type_name("I").required();
    command.add_option("--pixels", args->pixels, "Pixels of the panel").type_name("WxH").required();
    command.add_option("--distance-mm", args->distance_mm, "Distance from the panel to the eye").type_name("D").required();
    command.add_option("--fov-deg", args->fov_deg, "Field of view with whole elemental images; default 30").type_name("F");
    command
        .add_option(
            "--depth-mm", args->depth_mm,
            "Central depth plane, measured from the lenses towards the eye; default D/10, or -1000 for eyes nearer than 250 mm")
        .type_name("L");
    command.add_option("--lens", args->lens, "Kind of lens; default plano_convex").type_name("plano_convex|ideal");
    command.add_option("-o,--output", args->output, "Description to write: .toml").type_name("FILE").required();
    command.add_flag("--force", args->force, "Replace an existing file");
    command.footer(
        "Examples:\n  lfdsim new --panel-inch 8 --pixels 2560x1600 --fov-deg 30 --distance-mm 500 -o tablet.toml\n"
        "  lfdsim new --panel-inch 0.7 --pixels 1920x1080 --fov-deg 30 --distance-mm 20 --depth-mm -1000 -o near-eye.toml\n"
        "  lfdsim new --panel-inch 100 --pixels 3840x2160 --fov-deg 40 --distance-mm 3000 -o wall.toml");
    command.callback([args] { run(*args); });
}

}  // namespace lfdsim::cli
