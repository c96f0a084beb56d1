#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/font.h"
#include "cli/memory.h"
#include "cli/output.h"
#include "image/image_file.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

// lfdsim sheet: pictures side by side, for the eye. One picture at a time is in memory at full size.
namespace lfdsim::cli {
namespace {

struct Arguments {
    std::vector<std::string> images, labels;
    std::string output, columns = "2", width_px = "640";
    bool json = false;
};

constexpr int margin = 12;
constexpr float background = 0.012f, ink = 0.6f;  // linear light: a dark grey, and a light one

// The mean light over each new pixel's area, so that fine lens dots keep their brightness.
Image scaled(const Image& from, int width, int height) {
    Image to(width, height);
    const double sx = double(from.width) / width, sy = double(from.height) / height;
    // the share of [low, high] that lies in pixel i
    const auto share = [](double low, double high, int i) { return std::min(high, i + 1.0) - std::max(low, double(i)); };
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column) {
            const double x0 = column * sx, x1 = x0 + sx, y0 = row * sy, y1 = y0 + sy;
            double sum[3] = {};
            for (int y = int(y0); y < std::min(int(std::ceil(y1)), from.height); ++y)
                for (int x = int(x0); x < std::min(int(std::ceil(x1)), from.width); ++x)
                    for (int c = 0; c < 3; ++c) sum[c] += share(x0, x1, x) * share(y0, y1, y) * from.at(x, y)[c];
            for (int c = 0; c < 3; ++c) to.at(column, row)[c] = float(sum[c] / (sx * sy));
        }
    return to;
}

void paste(const Image& from, Image& to, int x, int y) {
    for (int row = 0; row < from.height; ++row) std::copy_n(from.at(0, row), std::size_t(from.width) * 3, to.at(x, y + row));
}

void run(const Arguments& args) {
    Faults faults;
    std::int64_t columns = 0, width = 0;
    faults.of([&] { columns = whole_number("--columns", args.columns, 1, 100); });
    faults.of([&] { width = whole_number("--width-px", args.width_px, 16, 16384); });
    faults.of([&] { check_output(args.output); });
    if (!args.labels.empty() && args.labels.size() != args.images.size())
        faults.of([&] {
            throw InputError("--label", fmt::format("there are {} labels and {} pictures; give one label for each picture, or none",
                                                    args.labels.size(), args.images.size()));
        });
    faults.report();

    std::vector<Image> cells;
    for (const std::string& path : args.images)
        faults.of([&] {
            check_input("IMAGE", path);
            const Image image = read_image(path, Encoding::srgb);
            const double height = std::max(1.0, std::round(double(width) * image.height / image.width));
            require_memory(path, fmt::format("a cell of {} x {:.0f} pixels", width, height), double(width) * height * 12);
            cells.push_back(scaled(image, int(width), int(height)));
        });
    faults.report();

    const int scale = std::max(1, int(width) / 240), label = args.labels.empty() ? 0 : glyph_height * scale + margin / 2;
    columns = std::min<std::int64_t>(columns, std::int64_t(cells.size()));
    std::vector<int> tops;  // of each row
    int bottom = margin;
    for (std::size_t first = 0; first < cells.size(); first += std::size_t(columns)) {
        int tallest = 0;
        for (std::size_t i = first; i < std::min(cells.size(), first + std::size_t(columns)); ++i)
            tallest = std::max(tallest, cells[i].height);
        tops.push_back(bottom);
        bottom += label + tallest + margin;
    }
    const std::int64_t sheet_width = columns * (width + margin) + margin;
    require_memory("--width-px", fmt::format("a sheet of {} x {} pixels", sheet_width, bottom), picture_bytes(sheet_width, bottom));
    Image sheet(int(sheet_width), bottom);
    std::fill(sheet.rgb.begin(), sheet.rgb.end(), background);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const int x = margin + int(i % std::size_t(columns)) * int(width + margin), y = tops[i / std::size_t(columns)];
        if (!args.labels.empty()) {
            const auto fitting = std::size_t(width / (glyph_width * scale));
            draw_text(sheet, x, y, scale, args.labels[i].substr(0, fitting), ink);
        }
        paste(cells[i], sheet, x, y + label);
    }
    write_image(args.output, sheet, {8, Encoding::srgb, {{"Software", "lfdsim " LFDSIM_VERSION}}});
    if (args.json)
        return print_json(
            Json{{"output", args.output}, {"width", sheet.width}, {"height", sheet.height}, {"pictures", cells.size()}});
    print(fmt::format("{}: {} pictures, {} x {} pixels\n", args.output, cells.size(), sheet.width, sheet.height));
}

}  // namespace

void add_sheet(CLI::App& program) {
    const auto args = std::make_shared<Arguments>();
    CLI::App& command = *program.add_subcommand("sheet", "A contact sheet: pictures side by side, with labels");
    command.add_option("IMAGE", args->images, "Pictures, row by row")->type_name("")->required();
    command.add_option("-o,--output", args->output, "Picture to write: .png (sRGB), or linear .exr .npy")
        ->type_name("FILE")
        ->required();
    command.add_option("--columns", args->columns, "Pictures in a row; default 2")->type_name("N");
    command.add_option("--width-px", args->width_px, "Width of each picture on the sheet; default 640")->type_name("W");
    command.add_option("--label", args->labels, "Text over a picture; one for each, in order")
        ->type_name("TEXT")
        ->allow_extra_args(false);
    command.add_flag("--json", args->json, "Print results as JSON");
    command.footer("Example:\n  lfdsim sheet view.png photo.png --label \"view, 15\u00b0\" --label reference -o sheet.png");
    command.callback([args] { run(*args); });
}

}  // namespace lfdsim::cli
