#include "base/counted.h"
#include "cli/output/new_description.h"
#include "cli/output/output.h"
#include "cli/program/arguments.h"
#include "cli/program/commands.h"
#include "files/description/shell.h"
#include "files/lenses/import_lens.h"
#include "files/lenses/importable.h"
#include "geometry/geometry.h"

#include <fmt/format.h>
#include <algorithm>
#include <filesystem>
#include <optional>
#include <variant>

// lfdsim import: a lens that was drawn in a lens design program becomes the lens of a display, the calibration of a lenticular
// display a description of it.
namespace lfdsim::cli {
namespace {

namespace fs = std::filesystem;

struct ImportArguments {
    explicit ImportArguments(Command c) : command(c), output(command) {
        command
            .add_option("FILE", file,
                        "Lens of Zemax (.zmx), Optiland (.json) or ray-optics (.roa), or calibration of a Looking Glass display "
                        "(visual.json)")
            .type_name("")
            .required();
        command.add_flag("--flip", flip,
                         "Turn the lens over: the side of the file's object faces the panel, not that of its image");
        command.add_option("--scale", scale, "Factor for all lengths of the lens; default 1").type_name("S");
        command
            .add_option("--gap-mm", gap,
                        "Panel to the lens's principal plane; default: the panel stands where the image is, or by the view cone")
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
        command
            .add_option("--distance-mm", distance,
                        "Distance from the panel to the eye; default 600, of a calibration where the panel is 14 degrees high")
            .type_name("D");
        command
            .add_option(
                "--index", index,
                "For a calibration, which says nothing of the lenses: cylinders of this index in a sheet on the panel; default: "
                "lenses without aberrations, in air")
            .type_name("N");
    }
    Command command;
    NewDescription output;
    std::string file, scale, gap, pitch, semi_aperture, panel_inch, pixels, distance, index;
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
    const std::vector<double> nd_vd = numbers("--glass", value, "1.5168,64.17", "ND,VD");
    return {name, {}, Glass{"", Formula::nd_vd, nd_vd}};
}

/// Refuses options that have no effect on such a file.
void check_unused(const Command& command, bool calibrated, Faults& faults) {
    constexpr const char* of_lenses[] = {"--flip",  "--scale",     "--pitch-mm",   "--semi-aperture-mm",
                                         "--glass", "--catalogue", "--panel-inch", "--pixels"};
    const auto refuse = [&](const char* option, const char* why) {
        if (command.given(option)) faults.of([&] { throw InputError(option, why); });
    };
    if (!calibrated) return refuse("--index", "is for a calibration; this lens has its own glass (--glass)");
    for (const char* option : of_lenses) refuse(option, "is for a lens of a design program, not for a calibration; leave it out");
}

CalibrationRequest calibration_request(const ImportArguments& args) {
    CalibrationRequest request;
    Faults faults;
    if (!args.gap.empty()) faults.of([&] { request.gap_mm = positive("--gap-mm", args.gap); });
    if (!args.distance.empty()) faults.of([&] { request.distance_mm = positive("--distance-mm", args.distance); });
    if (!args.index.empty())
        faults.of([&] {
            request.index = number("--index", args.index);
            if (!(*request.index > 1 && *request.index <= 4))
                throw InputError("--index", fmt::format("is {}; allowed is more than 1 to 4", args.index));
        });
    faults.report();
    return request;
}

ImportRequest lens_request(const ImportArguments& args) {
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

std::string lens_in_words(const Imported& made) {
    const Geometry g = resolve(made.display);
    return fmt::format("{}, focal length {:.5g} mm, gap {:.5g} mm, {} x {} lenses of {:.4g} mm",
                       counted(made.surfaces.size(), "surface"), g.focal_length_mm, g.gap_mm, g.lattice.count[0],
                       g.lattice.count[1], made.display.array.pitch_mm[0]);
}

std::string lenticular_in_words(const Imported& made) {
    const Display& d = made.display;
    const Theory t = theory(d, resolve(d));
    return fmt::format(
        "{} x {} pixels of {:.4g} mm under {} strips of {:.5g} mm, slant {:.4g} degrees, gap {:.4g} mm, {:.3g} views",
        d.panel.pixels[0], d.panel.pixels[1], d.panel.pixel_pitch_mm, d.array.count->at(0), d.array.pitch_mm[0], *d.array.slant_deg,
        t.gap_mm, t.along[0].views);
}

void run(const ImportArguments& args) {
    check_input("FILE", args.file);
    Faults faults;
    std::optional<std::variant<DrawnLens, Calibration>> file;
    ImportRequest for_lens;
    CalibrationRequest for_calibration;
    faults.of([&] { args.output.check(); });
    faults.of([&] { file = read_importable(args.file); });
    const bool calibrated = file && std::holds_alternative<Calibration>(*file);
    if (file) check_unused(args.command, calibrated, faults);
    faults.of([&] { calibrated ? void(for_calibration = calibration_request(args)) : void(for_lens = lens_request(args)); });
    faults.report();

    Imported made = calibrated ? import_calibration(std::get<Calibration>(*file), for_calibration, args.file)
                               : import_lens(std::get<DrawnLens>(std::move(*file)), for_lens);
    if (made.display.name.empty()) made.display.name = fs::path(args.output.path()).stem();
    // Comments name the file, not where it lies on this machine.
    if (const fs::path path = args.file; path.is_absolute())
        for (std::string& place : made.surfaces)
            if (place.starts_with(args.file)) place.replace(0, args.file.size(), path.filename().string());
    args.output.write(write_imported(made, seen_from(args.output.path(), made.catalogues), NewDescription::made_by()));

    std::string text = fmt::format("{}: {}\n", args.output.path(), calibrated ? lenticular_in_words(made) : lens_in_words(made));
    for (const std::string& note : made.notes) text += "  - " + note + "\n";
    const std::string name = shell_file(args.output.path());
    print(text + fmt::format("Next: lfdsim check {}, lfdsim {}\n", name,
                             calibrated ? "eia " + name + " -o eia.png" : "analyze spot " + name + " -o spots"));
}

}  // namespace

void add_import(Command program) {
    Command command = program.add_subcommand(
        "import", "Makes a description with a lens from a design program, or of a calibrated lenticular display");
    const auto args = std::make_shared<ImportArguments>(command);
    command.footer(
        "Examples:\n  lfdsim import triplet.zmx --scale 0.05 -o triplet.toml\n"
        "  lfdsim import visual.json --distance-mm 650 -o portrait.toml\n"
        "What is read, refused and assumed: docs/import.md");
    command.callback([args] { run(*args); });
}

}  // namespace lfdsim::cli
