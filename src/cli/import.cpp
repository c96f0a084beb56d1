#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/new_description.h"
#include "cli/output.h"
#include "files/import_lens.h"
#include "files/shell.h"
#include "model/geometry.h"

#include <fmt/format.h>
#include <algorithm>
#include <filesystem>

// lfdsim import: a lens that was drawn in a lens design program becomes the lens of a display.
namespace lfdsim::cli {
namespace {

namespace fs = std::filesystem;

struct ImportArguments {
    explicit ImportArguments(Command command) : output(command) {
        command.add_option("LENS", lens, "Lens of Zemax (.zmx), Optiland (.json) or ray-optics (.roa)")
            .type_name("FILE")
            .required();
        command.add_flag("--flip", flip,
                         "Turn the lens over: the side of the file's object faces the panel, not that of its image");
        command.add_option("--scale", scale, "Factor for all lengths of the lens; default 1").type_name("S");
        command.add_option("--gap-mm", gap, "Panel to the lens's principal plane; default: the panel stands where the image is")
            .type_name("G");
        command.add_option("--pitch-mm", pitch, "From lens to lens; default: as wide as the lens").type_name("P");
        command
            .add_option("--semi-aperture-mm", semi_aperture,
                        "Of surfaces that have none in the file; default: what the file's beam needs")
            .type_name("R");
        command
            .add_option("--glass", glasses,
                        "What to take for a glass of the file: one of another name, its index n_d, or that and its Abbe number V_d")
            .type_name("NAME=OTHER|ND|ND,VD")
            .allow_extra_args(false);
        command.add_option("--catalogue", catalogues, "Glass catalogue, looked up before the glasses that ship")
            .type_name("FILE.agf")
            .allow_extra_args(false);
        command.add_option("--panel-inch", panel_inch, "Diagonal of the panel; default 24").type_name("I");
        command.add_option("--pixels", pixels, "Pixels of the panel; default 3840x2160").type_name("WxH");
        command.add_option("--distance-mm", distance, "Distance from the panel to the eye; default 600").type_name("D");
    }
    NewDescription output;
    std::string lens, scale, gap, pitch, semi_aperture, panel_inch, pixels, distance;
    std::vector<std::string> glasses, catalogues;
    bool flip = false;
};

double positive(const std::string& option, const std::string& text) {
    const double value = number(option, text);
    if (value >= 1e-6 && value <= 1e6) return value;
    throw InputError(option, fmt::format("is {}; allowed is 1e-6 to 1e6", text));
}

GlassChoice glass_choice(const std::string& text, const std::vector<GlassCatalogue>& catalogues) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
        throw InputError("--glass", fmt::format("\"{}\" is not of the form NAME=OTHER, NAME=ND or NAME=ND,VD", text));
    const std::string name = text.substr(0, equals), value = text.substr(equals + 1);
    const bool is_number = !value.empty() && value.find_first_not_of("0123456789.,+-eE") == std::string::npos;
    if (!is_number) {
        const Glass* found = find_glass(value, catalogues);
        if (!found) throw InputError("--glass", unknown_glass(value, catalogues));
        return {name, {}, *found};
    }
    if (value.find(',') == std::string::npos) return {name, number("--glass", value), {}};
    const std::vector<double> nd_vd = numbers("--glass", value, 2);
    return {name, {}, Glass{"", Formula::nd_vd, nd_vd}};
}

ImportRequest request_of(const ImportArguments& args) {
    ImportRequest request;
    request.flip = args.flip;
    Faults faults;
    const auto read = [&](const char* option, const std::string& text, auto& to) {
        if (!text.empty()) faults.of([&] { to = positive(option, text); });
    };
    read("--scale", args.scale, request.scale);
    read("--gap-mm", args.gap, request.gap_mm);
    read("--pitch-mm", args.pitch, request.pitch_mm);
    read("--semi-aperture-mm", args.semi_aperture, request.semi_aperture_mm);
    read("--panel-inch", args.panel_inch, request.panel_inch);
    read("--distance-mm", args.distance, request.distance_mm);
    if (!args.pixels.empty()) faults.of([&] { request.pixels = size("--pixels", args.pixels); });
    for (const std::string& file : args.catalogues) {
        check_input("--catalogue", file);
        faults.of([&] { request.catalogues.push_back(read_agf(file)); });
    }
    for (const std::string& text : args.glasses)
        faults.of([&] { request.glasses.push_back(glass_choice(text, request.catalogues)); });
    faults.report();
    return request;
}

/// Catalogues are named in a description as they are seen from its folder.
std::vector<std::string> seen_from(const fs::path& description, std::vector<std::string> files) {
    for (std::string& file : files) file = fs::absolute(file).lexically_proximate(fs::absolute(description).parent_path()).string();
    return files;
}

void run(const ImportArguments& args) {
    check_input("LENS", args.lens);
    Faults faults;
    ImportRequest request;
    DrawnLens lens;
    faults.of([&] { request = request_of(args); });
    faults.of([&] { args.output.check(); });
    faults.of([&] { lens = read_drawn_lens(args.lens); });
    faults.report();
    Imported made = import_lens(std::move(lens), request);
    if (made.display.name.empty()) made.display.name = fs::path(args.output.path()).stem();
    args.output.write(write_imported(made, seen_from(args.output.path(), made.catalogues), command_line()));

    const Geometry g = resolve(made.display);
    std::string text = fmt::format("{}: {} surfaces, focal length {:.5g} mm, gap {:.5g} mm, {} x {} lenses of {:.4g} mm\n",
                                   args.output.path(), made.surfaces.size(), g.focal_length_mm, g.gap_mm, g.lattice.count[0],
                                   g.lattice.count[1], made.display.array.pitch_mm[0]);
    for (const std::string& note : made.notes) text += "  - " + note + "\n";
    const std::string name = shell_file(args.output.path());
    print(text + fmt::format("Next: lfdsim check {}, lfdsim analyze spot {} -o spots\n", name, name));
}

}  // namespace

void add_import(Command program) {
    Command command = program.add_subcommand("import", "Makes a description with a lens from a lens design program");
    const auto args = std::make_shared<ImportArguments>(command);
    command.footer(
        "Example:\n  lfdsim import triplet.zmx --scale 0.05 -o triplet.toml\n"
        "What is read, refused and assumed: docs/import.md");
    command.callback([args] { run(*args); });
}

}  // namespace lfdsim::cli
