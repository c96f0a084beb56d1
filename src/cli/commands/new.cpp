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

// lfdsim new: writes a commented description of a first design (docs/model.md, "First designs").
namespace lfdsim::cli {
namespace {

struct NewArguments {
    Command command;
    NewDescription output{command};
    Option panel_inch = command.option("--panel-inch", "I", "Diagonal of the panel").required();
    Option pixels = command.option("--pixels", "WxH", "Pixels of the panel").required();
    Option distance_mm = command.option("--distance-mm", "D", "Distance from the panel to the eye").required();
    Option lattice = command
                         .option("--lattice", "square|hexagon|strips",
                                 "Round lenses in squares or hexagons, or strips: a lenticular sheet, horizontal parallax only; "
                                 "default square")
                         .initially("square");
    Option fov_deg = command.option(
        "--fov-deg", "F",
        "Field of view of whole elemental images, 2 atan(p' / 2g), in which an eye may move; for strips along the panel's rows. "
        "The angle that the screen fills follows from panel and distance (lfdsim check: screen_field_deg); default 30");
    Option views = command.option(
        "--views", "N",
        "Panel pixels behind a lens along a row, in place of the rule for the pitch; strips with 2: one view for each eye");
    Option pitch_mm = command.option("--pitch-mm", "P", "Lens pitch, in place of --views; for strips across their axes");
    Option depth_mm = command.option("--depth-mm", "L",
                                     "Central depth plane, measured from the lenses towards the eye; default D/10, or for eyes "
                                     "nearer than 250 mm -1000 or, if that is nearer, about "
                                     "-50 D; strips are focused on the panel");
    Option slant_deg = command.option("--slant-deg", "A",
                                      "Slant of strips from the vertical, positive where upper ends lean to the viewer's right; "
                                      "default 18.43, 1 in 3; 0 for two views");
    Option sheet_mm = command.option(
        "--sheet-mm", "T",
        "Thickness of the lenticular sheet, from the panel to the vertices, in place of --fov-deg, which follows from it");
    Option eyes_mm = command.option("--eye-distance-mm", "B",
                                    "Distance between a viewer's eyes, for two views, in place of --fov-deg; default 65");
    Option lens = command.option("--lens", "plano_convex|ideal", "Kind of lens; default plano_convex").initially("plano_convex");
};

/// Reads the options that both kinds of designs have.
template <class Request>
void read_common(const NewArguments& args, Request& request, Faults& faults) {
    faults.of([&] { request.panel_inch = args.panel_inch.number(); });
    faults.of([&] { request.pixels = args.pixels.size(); });
    faults.of(args.fov_deg, [&] { request.fov_deg = args.fov_deg.number(); });
    faults.of([&] { request.distance_mm = args.distance_mm.number(); });
    faults.of(args.pitch_mm, [&] { request.pitch_mm = args.pitch_mm.number(); });
    faults.of([&] {
        if (args.lens.word() == "ideal") request.lens = LensType::ideal;
    });
}

DesignRequest request_of(const NewArguments& args, LatticeKind lattice) {
    DesignRequest request;
    request.lattice = lattice;
    Faults faults;
    read_common(args, request, faults);
    faults.of(args.depth_mm, [&] { request.depth_mm = args.depth_mm.number(); });
    faults.of(args.views, [&] { request.views = args.views.whole_number(2, 10000); });
    for (const Option& option : {args.slant_deg, args.sheet_mm, args.eyes_mm})
        if (option.given()) faults.of([&] { throw InputError(option.name(), "is for --lattice strips"); });
    faults.report();
    return request;
}

LenticularRequest lenticular_request(const NewArguments& args) {
    LenticularRequest request;
    Faults faults;
    read_common(args, request, faults);
    faults.of(args.views, [&] { request.views = args.views.number(); });
    faults.of(args.slant_deg, [&] { request.slant_deg = args.slant_deg.number(); });
    faults.of(args.sheet_mm, [&] { request.sheet_mm = args.sheet_mm.number(); });
    faults.of(args.eyes_mm, [&] { request.eyes_mm = args.eyes_mm.number(); });
    if (args.depth_mm.given())
        faults.of([] { throw InputError("--depth-mm", "is not for strips, which are focused on the panel; leave it out"); });
    faults.report();
    return request;
}

/// The warnings that `lfdsim check` prints for the display.
std::vector<std::string> warnings_of_check(const Display& d) {
    const Geometry g = resolve(d);
    return worth_knowing(d, g, theory(d, g));
}

/// A line with the widest field of view, of 0.9, 0.8 ... 0.3 times a design's, for which `check` prints no warning; empty if there
/// is none.
template <class Request, class Design>
std::string narrower(Request request, Design (*design)(const Request&), double fov_deg) {
    for (int tenths = 9; tenths >= 3; --tenths) {
        const double fov = std::round(0.1 * tenths * fov_deg);
        request.fov_deg = fov;
        try {
            Design made = design(request);
            made.display.content.model = built_in_spheres;
            if (warnings_of_check(made.display).empty())
                return fmt::format("  A narrower field of view, --fov-deg {:g}, would give no advice.\n", fov);
        } catch (const InputError&) {
            break;  // lenses of a still narrower field are even farther from the panel
        }
    }
    return {};
}

/// Names the design after its file, writes it, and prints `what` it is and the warnings of `check`. `narrower` gives the advice of
/// narrower(), which is added to warnings.
template <class Design>
void finish(const NewArguments& args, Design& made, std::string (*write)(const Design&, const std::string&),
            const std::string& what, const std::function<std::string()>& narrower) {
    made.display.name = std::filesystem::path(args.output.path()).stem();
    made.display.content.model = built_in_spheres;
    args.output.write(write(made, NewDescription::made_by()));
    const std::string name = shell_file(args.output.path());
    std::string text = fmt::format("{}: {}\n", args.output.path(), what);
    if (const std::vector<std::string> doubts = warnings_of_check(made.display); !doubts.empty()) {
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
        const std::string lattice = args.lattice.word();
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

CommandSpec new_command() {
    return {.name = "new",
            .summary = "Writes a commented description of a first design to start from",
            .examples =
                "Examples:\n  lfdsim new --panel-inch 8 --pixels 2560x1600 --fov-deg 30 --distance-mm 500 -o tablet.toml\n"
                "  lfdsim new --panel-inch 0.7 --pixels 1920x1080 --fov-deg 30 --distance-mm 20 --depth-mm -1000 -o near-eye.toml\n"
                "  lfdsim new --panel-inch 100 --pixels 3840x2160 --fov-deg 40 --distance-mm 3000 -o wall.toml\n"
                "  lfdsim new --panel-inch 10 --pixels 2560x1600 --lattice strips --views 8 --distance-mm 450 -o lenticular.toml\n"
                "  lfdsim new --panel-inch 6 --pixels 2560x1440 --lattice strips --views 2 --distance-mm 350 -o two-view.toml",
            .run = with_options<NewArguments>(run)};
}

}  // namespace lfdsim::cli
