#include "image/sheet.h"
#include "base/counted.h"
#include "base/printable.h"
#include "cli/output/output.h"
#include "cli/program/arguments.h"
#include "cli/program/commands.h"
#include "engine/devices/memory.h"
#include "image/formats/image_file.h"
#include "image/scaled.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

// lfdsim sheet: pictures side by side, for the eye. One picture at a time is in memory at full size.
namespace lfdsim::cli {
namespace {

struct SheetArguments {
    std::vector<std::string> images, labels;
    std::string output, columns = "2", width_px = "640";
    bool json = false;
};

void run(const SheetArguments& args) {
    Faults faults;
    std::int64_t columns = 0, width = 0;
    faults.of([&] { columns = whole_number("--columns", args.columns, 1, 100); });
    faults.of([&] { width = whole_number("--width-px", args.width_px, 16, 16384); });
    for (const std::string& path : args.images) faults.of([&] { check_input("IMAGE", path); });
    faults.of([&] { check_output(args.output); });
    if (!args.labels.empty() && args.labels.size() != args.images.size())
        faults.of([&] {
            throw InputError("--label", fmt::format("{} for {}; give one label for each picture, or none",
                                                    counted(args.labels.size(), "label"), counted(args.images.size(), "picture")));
        });
    faults.report();

    std::vector<Image> cells;
    for (const std::string& path : args.images)
        faults.of([&] {
            const Image image = read_image(path, Encoding::srgb);
            const double height = std::max(1.0, std::round(double(width) * image.height / image.width));
            require_memory(path, fmt::format("a cell of {} x {:.0f} pixels", width, height), double(width) * height * 12);
            cells.push_back(scaled(image, int(width), int(height)));
        });
    faults.report();

    double cell_pixels = 0;
    for (const Image& cell : cells) cell_pixels += double(cell.width) * cell.height;
    require_memory("--width-px", fmt::format("{} {} pixels wide, and the sheet", counted(cells.size(), "picture"), width),
                   2.2 * 12 * cell_pixels);
    const Image sheet = contact_sheet(cells, args.labels, int(columns));
    write_image(args.output, sheet, {8, Encoding::srgb, {{"Software", "lfdsim " LFDSIM_VERSION}}});
    if (args.json)
        return print_json(
            Json{{"output", args.output}, {"width", sheet.width}, {"height", sheet.height}, {"pictures", cells.size()}});
    print(fmt::format("{}: {}, {} x {} pixels\n", printable(args.output), counted(cells.size(), "picture"), sheet.width,
                      sheet.height));
}

}  // namespace

void add_sheet(Command program) {
    const auto args = std::make_shared<SheetArguments>();
    Command command = program.add_subcommand("sheet", "Makes a contact sheet: pictures side by side, with labels");
    command.add_option("IMAGE", args->images, "Pictures, row by row").type_name("").required();
    command.add_option("-o,--output", args->output, "Picture to write: .png (sRGB), or linear .exr .npy")
        .type_name("FILE")
        .required();
    command.add_option("--columns", args->columns, "Pictures in a row; default 2").type_name("N");
    command.add_option("--width-px", args->width_px, "Width of each picture on the sheet; default 640").type_name("W");
    command.add_option("--label", args->labels, "Text above a picture; one for each, in order")
        .type_name("TEXT")
        .allow_extra_args(false);
    command.add_flag("--json", args->json, "Print results as JSON");
    command.footer("Example:\n  lfdsim sheet view.png photo.png --label \"view, 15\u00b0\" --label reference -o sheet.png");
    command.callback([args] { run(*args); });
}

}  // namespace lfdsim::cli
