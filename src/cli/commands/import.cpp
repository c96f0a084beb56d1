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
#include <filesystem>
#include <optional>
#include <variant>

// lfdsim import: writes a description with a lens from a lens design program, or of the lenticular display of which a file holds
// the calibration (docs/import.md).
namespace lfdsim::cli {
namespace {

namespace fs = std::filesystem;

struct ImportArguments {
    Command command;
    NewDescription output{command};
    Option file = command
                      .option("FILE", "",
                              "Lens of Zemax (.zmx), Optiland (.json) or ray-optics (.roa), or calibration of a Looking Glass "
                              "display (visual.json)")
                      .required();
    Flag flip = command.flag("--flip", "Reverse the lens: the side of the file's object faces the panel, not that of its image");
    Option scale = command.option("--scale", "S", "Factor for all lengths of the lens; default 1");
    Option gap = command.option("--gap-mm", "G",
                                "Panel to the lens's principal plane; default: from the image in the file, or from the view cone");
    Option pitch = command.option("--pitch-mm", "P", "Lens pitch; default: the lens's width");
    Option semi_aperture = command.option(
        "--semi-aperture-mm", "R", "Semi-aperture of surfaces that have none in the file; default: as the file's beam requires");
    List glasses = command
                       .list("--glass", "NAME=OTHER|ND|ND,VD",
                             "Replacement for a glass of the file: another name, an index n_d, or n_d and the Abbe number V_d")
                       .one_each();
    List catalogues = command.list("--catalogue", "FILE.agf", "Glass catalogue, searched before the glasses that ship").one_each();
    Option panel_inch = command.option("--panel-inch", "I", "Diagonal of the panel; default 24");
    Option pixels = command.option("--pixels", "WxH", "Pixels of the panel; default 3840x2160");
    Option distance = command.option(
        "--distance-mm", "D",
        "Distance from the panel to the eye; default 600, or for a calibration that at which the panel is 14 degrees high");
    Option index = command.option("--index", "N",
                                  "For a calibration, which does not describe the lenses: cylinders of this index in a sheet on "
                                  "the panel; default: lenses without aberrations, in air");
};

/// Sets a length, mm, or a factor, 1e-6 to 1e6, if the option is given.
template <class Number>
void read_positive(const Option& option, Number& to, Faults& faults) {
    faults.of(option, [&] {
        const double value = option.number();
        if (!(value >= 1e-6 && value <= 1e6))
            throw InputError(option.name(), fmt::format("is {}; allowed is 1e-6 to 1e6", option.text()));
        to = value;
    });
}

/// The replacement that --glass NAME=OTHER, NAME=ND or NAME=ND,VD asks for. Throws InputError.
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

/// Reports options that have no effect on a file of this kind; `calibrated`: a calibration, else a lens.
void check_unused(const Command& command, bool calibrated, Faults& faults) {
    constexpr const char* of_lenses[] = {"--flip",  "--scale",     "--pitch-mm",   "--semi-aperture-mm",
                                         "--glass", "--catalogue", "--panel-inch", "--pixels"};
    const auto refuse = [&](const char* option, const char* why) {
        if (command.given(option)) faults.of([&] { throw InputError(option, why); });
    };
    if (!calibrated) return refuse("--index", "is for a calibration; a lens has the glass of its file (--glass replaces it)");
    for (const char* option : of_lenses) refuse(option, "is for a lens of a design program, not for a calibration; leave it out");
}

CalibrationRequest calibration_request(const ImportArguments& args) {
    CalibrationRequest request;
    Faults faults;
    read_positive(args.gap, request.gap_mm, faults);
    read_positive(args.distance, request.distance_mm, faults);
    faults.of(args.index, [&] {
        request.index = args.index.number();
        if (!(*request.index > 1 && *request.index <= 4))
            throw InputError(args.index.name(), fmt::format("is {}; allowed is more than 1 to 4", args.index.text()));
    });
    faults.report();
    return request;
}

ImportRequest lens_request(const ImportArguments& args) {
    ImportRequest request;
    request.flip = args.flip;
    Faults faults;
    read_positive(args.scale, request.scale, faults);
    read_positive(args.gap, request.gap_mm, faults);
    read_positive(args.pitch, request.pitch_mm, faults);
    read_positive(args.semi_aperture, request.semi_aperture_mm, faults);
    read_positive(args.panel_inch, request.panel_inch, faults);
    read_positive(args.distance, request.distance_mm, faults);
    faults.of(args.pixels, [&] { request.pixels = args.pixels.size(); });
    for (const std::string& file : args.catalogues.texts()) {
        remember_input("--catalogue", file);
        faults.of([&] { request.catalogues.push_back(read_agf(file)); });
    }
    for (const std::string& text : args.glasses.texts())
        faults.of([&] { request.glasses.push_back(glass_choice(text, request.catalogues)); });
    faults.report();
    return request;
}

/// The files by their paths relative to the description's folder, as a description names its catalogues.
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
    const std::string& path = args.file.text();
    remember_input("FILE", path);
    Faults faults;
    std::optional<std::variant<DrawnLens, Calibration>> file;
    ImportRequest for_lens;
    CalibrationRequest for_calibration;
    faults.of([&] { args.output.check(); });
    faults.of([&] { file = read_importable(path); });
    const bool calibrated = file && std::holds_alternative<Calibration>(*file);
    if (file) check_unused(args.command, calibrated, faults);
    faults.of([&] { calibrated ? void(for_calibration = calibration_request(args)) : void(for_lens = lens_request(args)); });
    faults.report();

    Imported made = calibrated ? import_calibration(std::get<Calibration>(*file), for_calibration, path)
                               : import_lens(std::get<DrawnLens>(std::move(*file)), for_lens);
    if (made.display.name.empty()) made.display.name = fs::path(args.output.path()).stem();
    // Comments of the description name the file without its folder on this machine.
    if (fs::path(path).is_absolute())
        for (std::string& place : made.surfaces)
            if (place.starts_with(path)) place.replace(0, path.size(), fs::path(path).filename().string());
    args.output.write(write_imported(made, seen_from(args.output.path(), made.catalogues), NewDescription::made_by()));

    std::string text = fmt::format("{}: {}\n", args.output.path(), calibrated ? lenticular_in_words(made) : lens_in_words(made));
    for (const std::string& note : made.notes) text += "  - " + note + "\n";
    const std::string name = shell_file(args.output.path());
    print(text + fmt::format("Next: lfdsim check {}, lfdsim {}\n", name,
                             calibrated ? "eia " + name + " -o eia.png" : "analyze spot " + name + " -o spots"));
}

}  // namespace

CommandSpec import_command() {
    return {.name = "import",
            .summary = "Writes a description with a lens from a design program, or of a calibrated lenticular display",
            .examples =
                "Examples:\n  lfdsim import triplet.zmx --scale 0.05 -o triplet.toml\n"
                "  lfdsim import visual.json --distance-mm 650 -o portrait.toml\n"
                "What is read, refused and assumed: docs/import.md",
            .run = with_options<ImportArguments>(run)};
}

}  // namespace lfdsim::cli
