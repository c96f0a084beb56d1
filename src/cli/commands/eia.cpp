#include "analysis/pictures/shown_content.h"
#include "base/counted.h"
#include "cli/options/display_options.h"
#include "cli/options/grid_options.h"
#include "cli/options/made_for.h"
#include "cli/options/panel_source.h"
#include "cli/options/work_options.h"
#include "cli/output/inverse_report.h"
#include "cli/output/mapping_export.h"
#include "cli/program/arguments.h"
#include "cli/program/commands.h"
#include "cli/program/effects.h"
#include "engine/devices/memory.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

// lfdsim eia: writes elemental images or a test pattern as a file that the panel can show: code values by the panel's encoding.
namespace lfdsim::cli {
namespace {

struct EiaArguments {
    Command command;
    DisplayOptions display{command, {content_options}};
    ModelOption model{command};
    PatternOption pattern{command};
    ViewsOption views{command};
    OutputOptions output{command, ".png with the panel's encoding, or linear .exr .npy"};
    MappingOption mapping{command};
    WorkOptions work{command};
};

void run(const EiaArguments& args) {
    Faults faults;
    Display display;
    PatternOptions pattern_options;
    ViewsOption views = args.views;
    faults.of([&] {
        display = args.display.read();
        const auto [columns, rows] = display.panel.pixels;
        require_memory("panel.pixels", fmt::format("an image of the panel's {} x {} pixels", columns, rows),
                       picture_bytes(columns, rows));
    });
    faults.of([&] { pattern_options = args.pattern.read(); });
    faults.of([&] { args.model.apply(display); });
    faults.of([&] { views.check(); });
    faults.of([&] { args.work.check(); });
    faults.of([&] { args.output.check(); });
    faults.of([&] { args.mapping.check(args.output.path()); });
    if (args.mapping.given() && display.content.pickup == PickupKind::inverse)
        faults.of([] {
            throw InputError(
                "--mapping",
                "is the table of traced rays, which the inverse pick-up does not use; leave it out, or take --pickup traced");
        });
    faults.of([&] { check_effects(args.command); });
    faults.report();

    // The panel's picture: of views, a pattern or a model.
    const Geometry geometry = resolve(display);
    Picture picture;
    std::string of_views;
    std::optional<InverseReport> inverse;
    Json more = Json::object();
    Progress progress(args.work.progress());
    if (views.given()) {
        ViewsOption::PanelOfViews made = views.make(display, geometry, args.work.threads(), progress);
        picture = std::move(made.field.picture);
        of_views = std::move(made.text);
        more["views"] = std::move(made.json);
        inverse = std::move(made.inverse);
    } else if (args.pattern.given()) {
        picture.image = pattern(args.pattern.name(), display, geometry, pattern_options);
    } else {
        const ContentScene scene = load_scene(display, geometry);
        ShownContent made = shown_content(display, geometry, scene, args.work.threads(), progress);
        picture = std::move(made.picture);
        inverse = std::move(made.inverse);
    }
    // The picture's file, and what is reported of it.
    if (inverse) {
        warn_of_inverse(*inverse);
        of_views += "; " + inverse_text(*inverse);
        more["inverse"] = inverse_json(*inverse);
    }
    if (args.mapping.given()) args.mapping.write(display, geometry, args.work.threads());
    if (picture.dark > 0) {
        more["dark"] = picture.dark;
        spdlog::warn("the light of {} never leaves its lens: black is shown there",
                     counted(picture.dark, display.panel.subpixels == SubpixelLayout::none ? "pixel" : "subpixel"));
    }
    Metadata about{{"seconds", fmt::format("{:.3f}", picture.seconds)}};
    if (args.pattern.given()) about[pattern_mark] = args.pattern.name();
    std::string incomplete;
    if (inverse)
        incomplete = inverse->result == PickupKind::traced && inverse->iterations == 0 ? "traced content, as far as it was made"
                                                                                       : "the best panel so far";
    more.update(args.output.write(picture.image, display.panel.encoding, display, std::move(about), picture.complete, progress, {},
                                  incomplete));
    print_made(PictureMade{args.output.path(), picture.image.width, picture.image.height, "rays", picture.rays, picture.seconds},
               args.work.json(), of_views, more);
}

}  // namespace

CommandSpec eia_command() {
    return {.name = "eia",
            .summary = "Computes the panel's picture: the elemental images of a model or of views, or a test pattern",
            .examples =
                "Examples:\n  lfdsim eia display.toml --model monkey.blend --height-mm 120 -o eia.png\n"
                "  lfdsim eia display.toml --views lego --baseline-mm 12 --focus-depth-mm 0 -o eia.png\n"
                "  lfdsim eia display.toml --pattern checkerboard --cell-pixels 8 -o eia.png",
            .run = with_options<EiaArguments>(run)};
}

}  // namespace lfdsim::cli
