#include "checks/first_order.h"
#include "checks/lenticular.h"
#include "cli/output/new_description.h"
#include "cli/output/output.h"
#include "cli/program/arguments.h"
#include "cli/program/commands.h"
#include "content/content.h"
#include "files/description/shell.h"
#include "files/description/write_first_order.h"
#include "report/folder/check.h"

#include <fmt/format.h>
#include <cmath>
#include <filesystem>
#include <functional>

// lfdsim new: a commented description of a first-order design.
namespace lfdsim::cli {
namespace {

struct NewArguments {
    explicit NewArguments(Command c) : command(c), output(command) {
        command.add_option("--panel-inch", panel_inch, "Diagonal of the panel").type_name("I").required();
        command.add_option("--pixels", pixels, "Pixels of the panel").type_name("WxH").required();
        command.add_option("--distance-mm", distance_mm, "Distance from the panel to the eye").type_name("D").required();
        command
            .add_option(
                "--lattice", lattice,
                "Round lenses in squares or hexagons, or strips: a lenticular sheet, horizontal parallax only; default square")
            .type_name("square|hexagon|strips");
        command
            .add_option("--fov-deg", fov_deg,
                        "Field of view of whole elemental images, 2 atan(p' / 2g), of strips along the panel's rows: where an eye "
                        "may move. What it "
                        "sees of the screen follows from panel and distance (lfdsim check: screen_field_deg); default 30")
            .type_name("F");
        command
            .add_option(
                "--views", views,
                "Panel pixels behind a lens along a row, in place of the rule for the pitch; 2 of strips: one view for each eye")
            .type_name("N");
        command.add_option("--pitch-mm", pitch_mm, "From lens to lens, in place of --views; of strips across them").type_name("P");
        command
            .add_option("--depth-mm", depth_mm,
                        "Central depth plane, measured from the lenses towards the eye; default D/10, or -1000 for eyes nearer "
                        "than 250 mm; "
                        "strips are focused on the panel")
            .type_name("L");
        command
            .add_option("--slant-deg", slant_deg,
                        "Of strips: from the vertical, positive where upper ends lean to the viewer's right; default 18.43, 1 in "
                        "3; 0 of two "
                        "views")
            .type_name("A");
        command
            .add_option("--sheet-mm", sheet_mm, "Thickness of strips' sheet, panel to ridges, in place of --fov-deg, which follows")
            .type_name("T");
        command.add_option("--eye-distance-mm", eyes_mm, "Of two views: between a viewer's eyes, in place of --fov-deg; default 65")
            .type_name("B");
        command.add_option("--lens", lens, "Kind of lens; default plano_convex").type_name("plano_convex|ideal");
    }
    Command command;
    std::string panel_inch, pixels, lattice = "square", fov_deg, distance_mm, depth_mm, views, pitch_mm, slant_deg, sheet_mm,
                                    eyes_mm, lens = "plano_convex";
    NewDescription output;
};

/// What both kinds of designs are asked for.
template <class Request>
void read_common(const NewArguments& args, Request& request, Faults& faults) {
    faults.of([&] { request.panel_inch = number("--panel-inch", args.panel_inch); });
    faults.of([&] { request.pixels = size("--pixels", args.pixels); });
    if (!args.fov_deg.empty()) faults.of([&] { request.fov_deg = number("--fov-deg", args.fov_deg); });
    faults.of([&] { request.distance_mm = number("--distance-mm", args.distance_mm); });
    if (!args.pitch_mm.empty()) faults.of([&] { request.pitch_mm = number("--pitch-mm", args.pitch_mm); });
    faults.of([&] {
        if (word("--lens", args.lens, {"plano_convex", "ideal"}) == "ideal") request.lens = LensType::ideal;
    });
}

DesignRequest request_of(const NewArguments& args, LatticeKind lattice) {
    DesignRequest request;
    request.lattice = lattice;
    Faults faults;
    read_common(args, request, faults);
    if (!args.depth_mm.empty()) faults.of([&] { request.depth_mm = number("--depth-mm", args.depth_mm); });
    if (!args.views.empty()) faults.of([&] { request.views = whole_number("--views", args.views, 2, 10000); });
    for (const char* option : {"--slant-deg", "--sheet-mm", "--eye-distance-mm"})
        if (args.command.given(option)) faults.of([&] { throw InputError(option, "is for --lattice strips"); });
    faults.report();
    return request;
}

LenticularRequest lenticular_request(const NewArguments& args) {
    LenticularRequest request;
    Faults faults;
    read_common(args, request, faults);
    const auto read = [&](const char* option, const std::string& text, std::optional<double>& to) {
        if (!text.empty()) faults.of([&] { to = number(option, text); });
    };
    read("--views", args.views, request.views);
    read("--slant-deg", args.slant_deg, request.slant_deg);
    read("--sheet-mm", args.sheet_mm, request.sheet_mm);
    read("--eye-distance-mm", args.eyes_mm, request.eyes_mm);
    if (args.command.given("--depth-mm"))
        faults.of([] { throw InputError("--depth-mm", "is not for strips, which are focused on the panel; leave it out"); });
    faults.report();
    return request;
}

std::vector<std::string> told_by_check(const Display& d) {
    const Geometry g = resolve(d);
    return worth_knowing(d, g, theory(d, g));
}

/// The widest field of view, below that of a design, of which `check` has nothing to say.
template <class Request, class Design>
std::string narrower(Request request, Design (*design)(const Request&), double fov_deg) {
    for (int tenths = 9; tenths >= 3; --tenths) {
        const double fov = std::round(0.1 * tenths * fov_deg);
        request.fov_deg = fov;
        try {
            Design made = design(request);
            made.display.content.model = built_in_spheres;
            if (told_by_check(made.display).empty())
                return fmt::format("  Of a narrower field of view, --fov-deg {:g}, there would be nothing to say.\n", fov);
        } catch (const InputError&) {
            break;  // of a narrower field lenses stand farther from the panel
        }
    }
    return {};
}

/// Names the design, writes it and says what it is, and of what `check` would warn. `narrower`: designs with a narrower field.
template <class Design>
void finish(const NewArguments& args, Design& made, std::string (*write)(const Design&, const std::string&),
            const std::string& what, const std::function<std::string()>& narrower) {
    made.display.name = std::filesystem::path(args.output.path()).stem();
    made.display.content.model = built_in_spheres;
    args.output.write(write(made, NewDescription::made_by()));
    const std::string name = shell_file(args.output.path());
    std::string text = fmt::format("{}: {}\n", args.output.path(), what);
    if (const std::vector<std::string> doubts = told_by_check(made.display); !doubts.empty()) {
        text +=
            "It is a valid display, but worth knowing (--set: an option of lfdsim check, view and others, or a key of the file):\n";
        for (const std::string& doubt : doubts) text += "  - " + doubt + "\n";
        text += narrower();
    }
    print(text + fmt::format("Next: lfdsim check {}, lfdsim view {}\n", name, name));
}

void run(const NewArguments& args) {
    Faults faults;
    std::optional<FirstOrder> lenses;
    std::optional<Lenticular> strips;
    faults.of([&] {
        const std::string lattice = word("--lattice", args.lattice, {"square", "hexagon", "strips"});
        if (lattice == "strips")
            strips = lenticular(lenticular_request(args));
        else
            lenses = first_order(request_of(args, lattice == "square" ? LatticeKind::square : LatticeKind::hexagon));
    });
    faults.of([&] { args.output.check(); });
    faults.report();
    if (strips) {
        const LensArray& array = strips->display.array;
        return finish(
            args, *strips, write_lenticular,
            fmt::format(
                "{} strips of {:.4g} mm, slant {:.4g} degrees, {:.4g} views over {:.4g} degrees, {:.4g} mm from view to view "
                "at the eye",
                array.count->at(0), array.pitch_mm[0], array.slant_deg.value_or(0), strips->views, strips->fov_deg,
                strips->view_step_mm),
            [&] { return strips->two_view ? std::string() : narrower(lenticular_request(args), lenticular, strips->fov_deg); });
    }
    const Display& d = lenses->display;
    finish(args, *lenses, write_first_order,
           fmt::format("{} x {} lenses of {:.4g} mm, {} x {} views over {:g} degrees, central depth plane at {:g} mm",
                       (*d.array.count)[0], (*d.array.count)[1], d.array.pitch_mm[0], lenses->views, lenses->views,
                       lenses->request.fov_deg, *lenses->request.depth_mm),
           [&] { return narrower(request_of(args, d.array.lattice), first_order, lenses->request.fov_deg); });
}

}  // namespace

void add_new(Command program) {
    Command command = program.add_subcommand("new", "Writes a commented description of a first design to start from");
    const auto args = std::make_shared<NewArguments>(command);
    command.footer(
        "Examples:\n  lfdsim new --panel-inch 8 --pixels 2560x1600 --fov-deg 30 --distance-mm 500 -o tablet.toml\n"
        "  lfdsim new --panel-inch 0.7 --pixels 1920x1080 --fov-deg 30 --distance-mm 20 --depth-mm -1000 -o near-eye.toml\n"
        "  lfdsim new --panel-inch 100 --pixels 3840x2160 --fov-deg 40 --distance-mm 3000 -o wall.toml\n"
        "  lfdsim new --panel-inch 10 --pixels 2560x1600 --lattice strips --views 8 --distance-mm 450 -o lenticular.toml\n"
        "  lfdsim new --panel-inch 6 --pixels 2560x1440 --lattice strips --views 2 --distance-mm 350 -o two-view.toml");
    command.callback([args] { run(*args); });
}

}  // namespace lfdsim::cli
