#include "image/compare/compare.h"

#include "base/constants.h"
#include "cli/commands/compare_photo.h"
#include "cli/options/made_for.h"
#include "cli/output/output.h"
#include "cli/program/arguments.h"
#include "cli/program/commands.h"
#include "cli/program/effects.h"
#include "cli/program/input_files.h"
#include "image/formats/image_file.h"

#include <fmt/format.h>

// lfdsim compare: prints the figures of image/compare/compare.h for two files; for a photograph of a display see compare_photo.cpp.
namespace lfdsim::cli {
namespace {

struct CompareArguments {
    Command command;
    Option a = command.option("A", "", "Picture: .png .exr .npy .jpg").required();
    Option b = command.option("B", "", "Picture of the same size; or a photograph: see --corners").required();
    Option encoding = command
                          .option("--encoding", "srgb|linear",
                                  "Encoding of PNG and JPEG code values; default srgb; with --corners that of B, and A is sRGB")
                          .initially("srgb");
    Option crop = command.option("--crop", "X0,Y0,X1,Y1", "Only this part: columns X0 to X1-1, rows Y0 to Y1-1");
    PhotoOptions photo{command};
    Flag json = command.flag("--json", "Print results as JSON");
};

void run(const CompareArguments& args) {
    check_effects(args.command);
    const std::string &path_a = args.a.text(), &path_b = args.b.text();
    if (args.photo.given()) return args.photo.run(path_a, path_b, args.encoding, args.crop, args.json);
    // Errors are measured in linear light: code values have to be decoded as they were written.
    const Encoding encoding = encoding_of(args.encoding);
    Image a, b;
    Faults faults;
    const auto read = [&](const char* argument, const std::string& path, Image& image) {
        faults.of([&] {
            remember_input(argument, path);
            image = read_image(path, encoding);
            warn_of_colours(path, encoding);
            warn_above_white(path, image);
        });
    };
    read("A", path_a, a);
    read("B", path_b, b);
    faults.report();
    if (a.width != b.width || a.height != b.height)
        throw InputError(path_b, fmt::format("is {} x {} pixels, {} is {} x {}; only pictures of equal size can be compared",
                                             b.width, b.height, path_a, a.width, a.height));
    std::optional<Rect> region;
    if (!args.crop.empty()) region = rectangle(args.crop.name(), args.crop.text(), a.width, a.height);
    warn_if_other_camera(path_a, path_b);
    const Comparison c = compare(a, b, region);
    if (args.json) {
        Json all;
        visit_figures(c, [&](const char* name, auto value) { all[name] = value; });
        return print_json(all);
    }
    print(
        fmt::format("SSIM                {:.6f}\n"
                    "PSNR                {:.3f} dB (linear light)\n"
                    "RMSE                {:.6g} (linear light)\n"
                    "greatest difference {:.6g} (linear light) at column {}, row {}, {}\n",
                    c.ssim, c.psnr_db, c.rmse, c.max_difference, c.max_column, c.max_row, colour_of_channel[c.max_channel]));
}

}  // namespace

CommandSpec compare_command() {
    return {.name = "compare",
            .summary = "Compares two pictures, or a view and a photograph of a real display: SSIM, PSNR, RMSE, greatest difference",
            .examples =
                "Examples:\n  lfdsim compare view.png photo.png --crop 800,200,1200,600\n"
                "  lfdsim compare view.png prototype.jpg --corners 412,377 3630,402 3598,2221 440,2190 --fit-blur -o overlay.png",
            .run = with_options<CompareArguments>(run)};
}

}  // namespace lfdsim::cli
