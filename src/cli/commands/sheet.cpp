#include "image/sheet.h"
#include "base/counted.h"
#include "base/printable.h"
#include "cli/output/output.h"
#include "cli/program/arguments.h"
#include "cli/program/commands.h"
#include "cli/program/input_files.h"
#include "engine/devices/memory.h"
#include "image/formats/image_file.h"
#include "image/scaled.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

// lfdsim sheet: writes pictures side by side, with labels, in one picture. Only one of them at a time is in memory at full size.
namespace lfdsim::cli {
namespace {

struct SheetArguments {
    Command command;
    List images = command.list("IMAGE", "", "Pictures, row by row").required();
    Option output = command.option("-o,--output", "FILE", "Picture to write: .png (sRGB), or linear .exr .npy").required();
    Option columns = command.option("--columns", "N", "Pictures in a row; default 2").initially("2");
    Option width_px = command.option("--width-px", "W", "Width of each picture on the sheet; default 640").initially("640");
    List labels =
        command.list("--label", "TEXT", "Text above a picture; this option once for each, in order").one_each().may_be_empty();
    Flag json = command.flag("--json", "Print results as JSON");
};

void run(const SheetArguments& args) {
    const std::vector<std::string>&images = args.images.texts(), &labels = args.labels.texts();
    const std::string& output = args.output.text();
    Faults faults;
    std::int64_t columns = 0, width = 0;
    faults.of([&] { columns = args.columns.whole_number(1, 100); });
    faults.of([&] { width = args.width_px.whole_number(16, 16384); });
    for (const std::string& path : images) faults.of([&] { remember_input("IMAGE", path); });
    faults.of([&] { check_output(output); });
    if (!labels.empty() && labels.size() != images.size())
        faults.of([&] {
            throw InputError("--label", fmt::format("{} for {}; give one label for each picture, or none",
                                                    counted(labels.size(), "label"), counted(images.size(), "picture")));
        });
    faults.report();

    // Each picture is reduced to its cell as soon as it is read.
    std::vector<Image> cells;
    for (const std::string& path : images)
        faults.of([&] {
            const Image image = read_image(path, Encoding::srgb);
            warn_of_colours(path, Encoding::srgb);
            const double height = std::max(1.0, std::round(double(width) * image.height / image.width));
            require_memory(path, fmt::format("a cell of {} x {:.0f} pixels", width, height), double(width) * height * 12);
            cells.push_back(scaled(image, int(width), int(height)));
        });
    faults.report();

    double cell_pixels = 0;
    for (const Image& cell : cells) cell_pixels += double(cell.width) * cell.height;
    const double sheet_pixels = contact_sheet_pixels(cells, labels, int(columns));
    if (sheet_pixels >= 0x1p31)
        throw InputError("--width-px",
                         fmt::format("the sheet would have {:.0f} million pixels, fewer than {:.0f} are allowed; give a smaller "
                                     "width, or fewer pictures",
                                     sheet_pixels * 1e-6, 0x1p31 * 1e-6));
    // Bytes of the cells and of the sheet, 12 a pixel, and a tenth more.
    require_memory("--width-px", fmt::format("{} {} pixels wide, and the sheet", counted(cells.size(), "picture"), width),
                   1.1 * 12 * (cell_pixels + sheet_pixels));
    const Image sheet = contact_sheet(cells, labels, int(columns));
    write_image(output, sheet, {8, Encoding::srgb, {{"Software", software}}});
    CutOff cut;
    if (holds_codes(output)) cut.add(sheet);
    Json made{{"output", output}, {"width", sheet.width}, {"height", sheet.height}, {"pictures", cells.size()}};
    made.update(warn_of_cut_off(output, cut, keeps_light));
    if (args.json) return print_json(made);
    print(fmt::format("{}: {}, {} x {} pixels\n", printable(output), counted(cells.size(), "picture"), sheet.width, sheet.height));
}

}  // namespace

CommandSpec sheet_command() {
    return {.name = "sheet",
            .summary = "Writes a contact sheet: pictures side by side, with labels",
            .examples = "Example:\n  lfdsim sheet view.png photo.png --label \"view, 15\u00b0\" --label reference -o sheet.png",
            .run = with_options<SheetArguments>(run)};
}

}  // namespace lfdsim::cli
