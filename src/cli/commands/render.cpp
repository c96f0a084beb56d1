#include "engine/render.h"

#include "base/counted.h"
#include "cli/commands/render_path.h"
#include "cli/options/display_options.h"
#include "cli/options/exposure.h"
#include "cli/options/lens_mesh_options.h"
#include "cli/options/panel_source.h"
#include "cli/options/shown_panel.h"
#include "cli/options/work_options.h"
#include "cli/output/rendered.h"
#include "cli/program/arguments.h"
#include "cli/program/commands.h"
#include "cli/program/effects.h"
#include "display/keys.h"
#include "engine/devices/devices.h"
#include "engine/devices/memory.h"
#include "engine/scene/traced_display.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

// lfdsim render: renders what a camera sees of a panel image, a pattern or a model. All faults of the command line are reported,
// together, before work begins.
namespace lfdsim::cli {
namespace {

struct RenderArguments {
    Command command;
    DisplayOptions display{command, {camera_options, sample_options, content_options}};
    PanelImageOption panel_image{command};
    ModelOption model{command};
    PatternOption pattern{command};
    CropOption crop{command};
    OutputOptions output{command,
                         ".png (sRGB), or linear .exr .npy (float32, H x W x 3); with --path a folder, created if missing"};
    PathOptions path{command};
    LensMeshOptions lens_mesh{command};
    ExposureOption exposure{command};
    DeviceOption device{command};
    WorkOptions work{command};
    Option kernel = command.option("--kernel", "scalar|baseline|avx2|avx512",
                                   "Instruction set; default: environment variable LFDSIM_KERNEL, else the best available");
    Option target_error =
        command.option("--target-error", "E",
                       "Add samples until the estimated error is below E, in linear light: of points that of each "
                       "4 x 4 pixels, of filtered light that of the picture; an .exr then has a layer \"error\"");
};

void render_frames(const RenderArguments& args, const Display& display, const CameraPath& path, const RenderOptions& options,
                   const std::function<PanelTexels()>& light, Progress& progress) {
    PanelTexels panel;  // empty if no frame was left to render
    const auto shown = [&]() -> const PanelTexels& { return panel = light(); };
    PathMade made = render_path(
        {args.path, args.output, path, display, options, shown_stamps(args.panel_image, args.pattern, display)}, shown, progress);
    const auto [columns, rows] = display.camera.resolution;
    made.more.update({{"frames", made.frames}, {"rendered", made.rendered}});
    made.more.update(panel.made);
    print_made(PictureMade{args.output.path(), options.crop ? options.crop->x1 - options.crop->x0 : int(columns),
                           options.crop ? options.crop->y1 - options.crop->y0 : int(rows), "samples", made.samples, made.seconds},
               args.work.json(),
               fmt::format("{}{}; {}, {} of them made before{}", made.how.empty() ? "" : ", ", made.how,
                           counted(made.frames, "frame"), made.frames - made.rendered, panel.text),
               made.more);
}

void run(const RenderArguments& args) {
    Faults faults;
    Display display;
    PatternOptions pattern_options;
    std::optional<Rect> crop;
    faults.of([&] {
        display = args.display.read();
        crop = args.crop.read(display.camera, texel_bytes(display));
        if (!args.panel_image.given()) require_panel_memory(display);
        if (args.command.given("--sampling") && !args.lens_mesh.given() && estimator_of(display) != Estimator::point)
            throw InputError("--sampling", "applies to points only; add --estimator point");
    });
    faults.of([&] { args.panel_image.check(); });
    faults.of([&] { pattern_options = args.pattern.read(); });
    std::string device;
    faults.of([&] {
        choose_kernel(args.kernel.text());
        device = args.device.read();
    });
    std::optional<double> target;
    faults.of(args.target_error, [&] {
        target = args.target_error.number();
        if (*target <= 0)
            throw InputError(args.target_error.name(), fmt::format("is {}, allowed is more than 0", args.target_error.text()));
    });
    faults.of([&] { args.model.apply(display); });
    faults.of([&] { args.work.check(); });
    std::optional<CameraPath> path;
    faults.of([&] { args.path.check(args.output); });
    if (args.path.given())
        faults.of([&] { path = args.path.read(); });
    else
        faults.of([&] { args.output.check(); });
    faults.of([&] { args.lens_mesh.check(); });
    faults.of([&] { args.exposure.check(); });
    faults.of([&] { check_effects(args.command); });
    faults.report();
    if (path) args.path.check(*path, display);  // only now, because it needs a display without faults

    const Geometry geometry = resolve(display);
    Progress progress(args.work.progress());
    const std::optional<MeshedLens> lens = args.lens_mesh.lens(display, geometry);
    const auto light = [&] {
        return shown_panel(args.panel_image, args.pattern, display, geometry, pattern_options, args.work.threads(), progress);
    };
    RenderOptions options{args.work.threads(), args.kernel.text(), crop, target, device};
    if (path) return render_frames(args, display, *path, options, light, progress);
    const PanelTexels panel = light();
    // The exposure scales the finished picture and its error, for which the target is.
    const std::optional<double> exposure = args.exposure.factor(display, geometry, options, progress);
    if (exposure && target) options.target_error = *target / *exposure;
    Rendering r = lens ? render_meshed(display, geometry, panel.texels, *lens, options, progress)
                       : render(display, geometry, panel.texels, options, progress);
    if (exposure) ExposureOption::apply(*exposure, r);
    Rendered facts = rendered(r, target, keeps_layers(args.output.path()));
    if (exposure) {
        facts.about["exposure"] = fmt::format("{}", *exposure);
        facts.more["exposure"] = *exposure;
    }
    if (lens) {
        facts.about["lens_mesh"] = args.lens_mesh.text(*lens);
        facts.more["lens_mesh"] = args.lens_mesh.json(*lens);
    }
    if (facts.pixels_above_target > 0)
        spdlog::warn("{} did not reach the target error with the maximum number of samples",
                     counted(facts.pixels_above_target, "pixel"));
    const Json cut_off =
        args.output.write(r.image, Encoding::srgb, display, std::move(facts.about), r.complete, progress, std::move(facts.layers));

    facts.more.update(cut_off);
    facts.more.update(panel.made);
    print_made(PictureMade{args.output.path(), r.image.width, r.image.height, "samples", r.samples, r.seconds}, args.work.json(),
               ", " + how_made(r) + (lens ? "; " + args.lens_mesh.text(*lens) : "") + panel.text, facts.more);
}

}  // namespace

CommandSpec render_command() {
    return {
        .name = "render",
        .summary = "Renders what a camera sees of the display",
        .examples =
            "Examples:\n  lfdsim render display.toml --panel-image eia.png --camera-mm -300,0,1800 -o view.png\n"
            "  lfdsim render display.toml --panel-image eia.png --target-error 0.005 -o view.exr\n"
            "  lfdsim render display.toml --panel-image eia.png --set panel.subpixels=rgb_stripe --exposure auto -o stripes.png\n"
            "  lfdsim render display.toml --panel-image eia.png --path walk.json -o walk\n"
            "  lfdsim render display.toml --panel-image eia.png --lens-mesh 3386 --lens-normals smooth -o meshed.png\n"
            "  lfdsim render display.toml --model monkey.blend --set array.pitch_mm=8 lens.aperture_radius_mm=4 -o view.exr",
        .run = with_options<RenderArguments>(run)};
}

}  // namespace lfdsim::cli
