#include "cli/options/display_options.h"
#include "cli/options/panel_source.h"
#include "cli/options/work_options.h"
#include "cli/program/arguments.h"
#include "cli/program/commands.h"

#include <fmt/format.h>

// lfdsim photo: renders the model itself, with the same camera and shading. It is the reference for views of the display.
namespace lfdsim::cli {
namespace {

struct PhotoArguments {
    Command command;
    DisplayOptions display{command, {content_options, camera_options, point_options}};
    ModelOption model{command};
    CropOption crop{command};
    OutputOptions output{command, ".png (sRGB), or linear .exr .npy"};
    WorkOptions work{command};
};

// Throws InputError if options of sampling are given for a pinhole that looks through pixel centres: it casts one ray a pixel.
void refuse_idle_samples(const PhotoArguments& args, const Camera& camera) {
    if (camera.pupil_diameter_mm || camera.pixel_filter == PixelFilter::box) return;
    for (const KeyOption& option : point_options)
        if (args.display.given(option.option))
            throw InputError(option.option,
                             "has no effect on a pinhole that looks through pixel centres; give the camera a pupil (--set "
                             "camera.pupil_diameter_mm=4) or a pixel filter (--set camera.pixel_filter=box)");
}

void run(const PhotoArguments& args) {
    Faults faults;
    Display display;
    std::optional<Rect> crop;
    faults.of([&] {
        display = args.display.read();
        crop = args.crop.read(display.camera, 0);
        refuse_idle_samples(args, display.camera);
    });
    faults.of([&] { args.model.apply(display); });
    faults.of([&] { args.work.check(); });
    faults.of([&] { args.output.check(); });
    faults.report();

    const Geometry geometry = resolve(display);
    const ContentScene scene = load_scene(display, geometry);
    Progress progress(args.work.progress());
    const Picture picture = reference_photograph(display, geometry, scene, args.work.threads(), crop, progress);
    const Json cut_off = args.output.write(picture.image, Encoding::srgb, display,
                                           {{"seconds", fmt::format("{:.3f}", picture.seconds)}}, picture.complete, progress);
    print_made(PictureMade{args.output.path(), picture.image.width, picture.image.height, "rays", picture.rays, picture.seconds},
               args.work.json(), {}, cut_off);
}

}  // namespace

CommandSpec photo_command() {
    return {.name = "photo",
            .summary = "Renders the reference photograph: the model itself, seen by the same camera",
            .examples =
                "Example:\n  lfdsim photo display.toml --model monkey.blend --camera-mm 518,0,1932 -o photo.png\n"
                "  lfdsim photo display.toml --set camera.pupil_diameter_mm=20 camera.focus_distance_mm=1800 -o blurred.png",
            .run = with_options<PhotoArguments>(run)};
}

}  // namespace lfdsim::cli
