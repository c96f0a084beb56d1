#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/new_description.h"
#include "cli/output.h"
#include "content/content.h"
#include "files/shell.h"
#include "files/write_first_order.h"
#include "model/first_order.h"

#include <fmt/format.h>
#include <filesystem>

// lfdsim new: a commented description of a first-order design.
namespace lfdsim::cli {
namespace {

struct NewArguments {
    explicit NewArguments(Command command) : output(command) {
        command.add_option("--panel-inch", panel_inch, "Diagonal of the panel").type_name("I").required();
        command.add_option("--pixels", pixels, "Pixels of the panel").type_name("WxH").required();
        command.add_option("--distance-mm", distance_mm, "Distance from the panel to the eye").type_name("D").required();
        command
            .add_option("--fov-deg", fov_deg,
                        "Field of view of whole elemental images, 2 atan(p' / 2g): where an eye may move. What it sees of the "
                        "screen follows "
                        "from panel and distance (lfdsim check: screen_field_deg); default 30")
            .type_name("F");
        command
            .add_option(
                "--depth-mm", depth_mm,
                "Central depth plane, measured from the lenses towards the eye; default D/10, or -1000 for eyes nearer than 250 mm")
            .type_name("L");
        command.add_option("--lens", lens, "Kind of lens; default plano_convex").type_name("plano_convex|ideal");
    }
    std::string panel_inch, pixels, fov_deg = "30", distance_mm, depth_mm, lens = "plano_convex";
    NewDescription output;
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

void run(const NewArguments& args) {
    Faults faults;
    FirstOrder made;
    faults.of([&] { made = first_order(request_of(args)); });
    faults.of([&] { args.output.check(); });
    faults.report();
    made.display.name = std::filesystem::path(args.output.path()).stem();
    made.display.content.model = built_in_spheres;

    args.output.write(write_first_order(made, command_line()));
    const Display& d = made.display;
    const std::string name = shell_file(args.output.path());
    print(
        fmt::format("{}: {} x {} lenses of {:.4g} mm, {} x {} views over {:g} degrees, central depth plane at {:g} mm\n"
                    "Next: lfdsim check {}, lfdsim view {}\n",
                    args.output.path(), (*d.array.count)[0], (*d.array.count)[1], d.array.pitch_mm[0], made.views, made.views,
                    made.request.fov_deg, *made.request.depth_mm, name, name));
}

}  // namespace

void add_new(Command program) {
    Command command = program.add_subcommand("new", "Writes a commented description of a first design to start from");
    const auto args = std::make_shared<NewArguments>(command);
    command.footer(
        "Examples:\n  lfdsim new --panel-inch 8 --pixels 2560x1600 --fov-deg 30 --distance-mm 500 -o tablet.toml\n"
        "  lfdsim new --panel-inch 0.7 --pixels 1920x1080 --fov-deg 30 --distance-mm 20 --depth-mm -1000 -o near-eye.toml\n"
        "  lfdsim new --panel-inch 100 --pixels 3840x2160 --fov-deg 40 --distance-mm 3000 -o wall.toml");
    command.callback([args] { run(*args); });
}

}  // namespace lfdsim::cli
