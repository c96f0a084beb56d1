#include "image/compare/compare.h"

#include "cli/commands/compare_photo.h"
#include "cli/options/made_for.h"
#include "cli/output/output.h"
#include "cli/program/arguments.h"
#include "cli/program/commands.h"
#include "cli/program/effects.h"
#include "cli/program/input_files.h"
#include "image/formats/image_file.h"

#include <fmt/format.h>

// lfdsim compare: figures of image/compare/compare.h for two files; for a photograph of a display see compare_photo.cpp.
namespace lfdsim::cli {
namespace {

struct CompareArguments {
    explicit CompareArguments(Command of) : command(of) {}
    Command command;
    std::string a, b, encoding = "srgb", crop;
    bool json = false;
};

void run(const CompareArguments& args, const PhotoOptions& photo) {
    check_effects(args.command);
    if (photo.given()) return photo.run(args.a, args.b, args.encoding, args.crop, args.json);
    // Errors are measured in linear light: code values have to be decoded as they were written.
    const Encoding encoding = word("--encoding", args.encoding, {"srgb", "linear"}) == "srgb" ? Encoding::srgb : Encoding::linear;
    Image a, b;
    Faults faults;
    const auto read = [&](const char* argument, const std::string& path, Image& image) {
        faults.of([&] {
            check_input(argument, path);
            image = read_image(path, encoding);
            warn_above_white(path, image);
        });
    };
    read("A", args.a, a);
    read("B", args.b, b);
    faults.report();
    if (a.width != b.width || a.height != b.height)
        throw InputError(args.b, fmt::format("is {} x {} pixels, {} is {} x {}; only pictures of equal size can be compared",
                                             b.width, b.height, args.a, a.width, a.height));
    std::optional<Rect> region;
    if (!args.crop.empty()) region = rectangle("--crop", args.crop, a.width, a.height);
    warn_if_other_camera(args.a, args.b);
    const Comparison c = compare(a, b, region);
    if (args.json)
        return print_json(Json{{"ssim", c.ssim},
                               {"psnr_db", c.psnr_db},
                               {"rmse", c.rmse},
                               {"max_difference", c.max_difference},
                               {"max_column", c.max_column},
                               {"max_row", c.max_row},
                               {"max_channel", c.max_channel}});
    constexpr const char* channels[] = {"red", "green", "blue"};
    print(
        fmt::format("SSIM                {:.6f}\n"
                    "PSNR                {:.3f} dB (linear light)\n"
                    "RMSE                {:.6g} (linear light)\n"
                    "greatest difference {:.6g} (linear light) at column {}, row {}, {}\n",
                    c.ssim, c.psnr_db, c.rmse, c.max_difference, c.max_column, c.max_row, channels[c.max_channel]));
}

}  // namespace

void add_compare(Command program) {
    Command command = program.add_subcommand(
        "compare", "Compares two pictures, or a view and a photograph of a real display: SSIM, PSNR, RMSE, greatest difference");
    const auto args = std::make_shared<CompareArguments>(command);
    command.add_option("A", args->a, "Picture: .png .exr .npy .jpg").type_name("").required();
    command.add_option("B", args->b, "Picture of the same size; or a photograph: see --corners").type_name("").required();
    command
        .add_option("--encoding", args->encoding,
                    "Encoding of PNG and JPEG code values; default srgb; with --corners that of B, and A is sRGB")
        .type_name("srgb|linear");
    command.add_option("--crop", args->crop, "Only this part: columns X0 to X1-1, rows Y0 to Y1-1").type_name("X0,Y0,X1,Y1");
    const auto photo = std::make_shared<PhotoOptions>(command);
    command.add_flag("--json", args->json, "Print results as JSON");
    command.footer(
        "Examples:\n  lfdsim compare view.png photo.png --crop 800,200,1200,600\n"
        "  lfdsim compare view.png prototype.jpg --corners 412,377 3630,402 3598,2221 440,2190 --fit-blur -o overlay.png");
    command.callback([args, photo] { run(*args, *photo); });
}

}  // namespace lfdsim::cli
