#include "base/output_file.h"
#include "base/printable.h"
#include "cli/options/display_options.h"
#include "cli/options/shown_panel.h"
#include "cli/options/work_options.h"
#include "cli/output/companion.h"
#include "cli/program/arguments.h"
#include "cli/program/commands.h"
#include "cli/program/effects.h"
#include "cli/program/input_files.h"
#include "cli/program/interrupt.h"
#include "engine/devices/memory.h"
#include "files/description/display_file.h"
#include "files/description/shell.h"
#include "files/lenses/lens_table.h"
#include "interchange/peers/fine_panel.h"
#include "interchange/peers/peers.h"
#include "report/folder/folder_lock.h"

#include <fmt/format.h>
#include <filesystem>

// lfdsim export: writes the display as a scene for another renderer, with the command that renders it there and the one that
// renders the same with lfdsim (docs/peers.md).
namespace lfdsim::cli {
namespace {

namespace fs = std::filesystem;

struct ExportArguments {
    Command command;
    Option peer =
        command.option("PEER", "pov|cycles|mitsuba", "For which program: pov (POV-Ray 3.7), cycles (Blender), mitsuba (Mitsuba 3)")
            .required();
    DisplayOptions display{command, {camera_options, content_options}};
    PanelImageOption panel_image{command};
    ModelOption model{command};
    PatternOption pattern{command};
    WorkOptions work{command};
    Option folder = command.option("-o,--output", "DIR", "Folder for the scene; created if missing").required();
    Option triangles = command.option(
        "--triangles", "N",
        fmt::format("Triangles per lens, 100 or more; default: true surfaces for pov, {} for the others", default_triangles));
    Option channel = command.option(
        "--channel", "r|g|b", "Scene of one channel, with the refractive indices at its wavelength; needed for dispersive glass");
    Option normals = command.option("--normals", "flat|smooth",
                                    "Normals: those of the triangles, or the true surface's, interpolated; default flat");
    Flag replace = command.flag(
        "--replace",
        "Overwrite files in the folder that are not of this display's scene; files of an earlier scene with other names remain");
};

bool is_peer(const std::string& name) { return name == "pov" || name == "cycles" || name == "mitsuba"; }

Peer peer_of(const ExportArguments& args) {
    const std::string &name = args.peer.text(), &display = args.display.path();
    if (!is_peer(name) && is_peer(display))
        throw InputError("PEER", fmt::format("comes before the display: lfdsim export {} {} ...", display, shell_file(name)));
    args.peer.word();
    return name == "pov" ? Peer::pov : name == "cycles" ? Peer::cycles : Peer::mitsuba;
}

PeerOptions options_of(const ExportArguments& args) {
    PeerOptions options;
    if (!args.triangles.empty()) options.triangles = args.triangles.whole_number(1, std::numeric_limits<std::int32_t>::max());
    if (!args.channel.empty()) options.channel = int(std::string_view("rgb").find(args.channel.word()));
    if (args.normals.empty()) return options;
    if (args.peer.text() == "pov" && !options.triangles)
        throw InputError("--normals", "are those of triangles; give --triangles N, too");
    options.normals = args.normals.word() == "flat" ? MeshNormals::flat : MeshNormals::smooth;
    return options;
}

constexpr const char* description_file = "display.toml";

/// Throws InputError if the folder holds another display's scene, because its files of other names would remain beside this one's,
/// or files of other origin with this scene's names. If description_file has this text, all files are of this scene: it is the
/// first text that is written.
void keep_apart(const fs::path& folder, const Json& files, const std::string& description, bool replace) {
    const fs::path there = folder / description_file;
    const bool own = holds(there, description);
    if (std::error_code error; fs::exists(there, error) && !own && !replace)
        throw InputError(there.string(), "is of another display; give another folder, or --replace to write over it");
    for (const std::string file : files) check_companion(folder / file, own, replace);
}

/// Adds to the scene the table of lens errors that its display.toml then names. The table contains the random errors, too, so that
/// their standard deviations become 0.
void take_lens_table(PeerScene& scene) {
    Errors& errors = scene.shown.errors;
    if (!errors.given) return;
    errors.table = "lenses.csv";
    scene.files.push_back({errors.table, write_lens_table(scene.shown)});
    errors.decenter_sd_mm = errors.height_sd_mm = errors.tilt_sd_deg = errors.curvature_sd = 0;
}

Image picture_of(const Texels& texels) {
    Image image(int(texels.columns()), int(texels.rows()));
    const float* from = texels.data();
    for (std::size_t i = 0; i < image.rgb.size(); i += 3, from += 4) std::copy(from, from + 3, &image.rgb[i]);
    return image;
}

std::string readme(const PeerScene& scene, const std::string& lfdsims) {
    std::string text = fmt::format(
        "{} and the files next to it describe a light field display for another renderer.\n"
        "Made by: {}\n\nIts picture, {}, rendered in this folder:\n\n    {}\n\n"
        "lfdsim's picture of the same, and the comparison of both:\n\n    {}\n    lfdsim compare lfdsim.exr {} --encoding linear\n",
        scene.files.front().name, command_line(), scene.picture, scene.command, lfdsims, scene.picture);
    text += scene.deviations.empty() ? "\nNothing deviates.\n" : "\nDeviations from lfdsim's model:\n\n";
    for (const std::string& deviation : scene.deviations) text += "- " + deviation + "\n";
    return text;
}

void run(const ExportArguments& args) {
    Faults faults;
    Display display;
    PatternOptions pattern_options;
    PeerOptions options;
    Peer peer{};
    faults.of([&] { peer = peer_of(args); });
    faults.of([&] {
        display = args.display.read();
        const auto [columns, rows] = display.panel.pixels;
        require_memory("panel.pixels", fmt::format("a panel image of {} x {} pixels and its copy", columns, rows),
                       texel_bytes(display) + picture_bytes(columns, rows));
        if (!args.panel_image.given()) require_panel_memory(display);
    });
    faults.of([&] { args.panel_image.check(); });
    faults.of([&] { pattern_options = args.pattern.read(); });
    faults.of([&] { options = options_of(args); });
    faults.of([&] { args.model.apply(display); });
    faults.of([&] { args.work.check(); });
    faults.of([&] { check_folder(args.folder.text()); });
    faults.of([&] { check_effects(args.command); });
    faults.report();

    // The scene. A panel with subpixels becomes one of more, whole pixels.
    const Geometry geometry = resolve(display);
    const FinePanel fine = fine_panel(display);
    const Geometry shown_geometry = resolve(fine.display);
    if (std::vector<Problem> problems = not_expressed(peer, fine.display, shown_geometry, options); !problems.empty())
        throw InputError(std::move(problems));
    Progress progress(args.work.progress());
    const fs::path folder = args.folder.text();
    PeerScene scene = peer_scene(peer, fine.display, shown_geometry, options);
    take_lens_table(scene);
    scene.deviations.insert(scene.deviations.end(), fine.deviations.begin(), fine.deviations.end());
    Json files = Json::array({scene.panel_file, description_file, "README.txt"});
    for (const PeerFile& file : scene.files) files.push_back(file.name);
    // The panel's image is a file of the scene: its description needs no content.
    scene.shown.content.model.clear();
    scene.shown.content.objects.clear();
    const std::string description = write_display(scene.shown);
    for (const std::string file : files) refuse_input(folder / file);
    const FolderLock lock(folder);
    keep_apart(folder, files, description, args.replace);
    // The panel's image, which may take long: after all checks.
    PanelTexels panel =
        shown_panel(args.panel_image, args.pattern, display, geometry, pattern_options, args.work.threads(), progress);
    panel.texels = light_of_channel(std::move(panel.texels), options.channel);
    if (fine.times > 1) panel.texels = fine_image(fine, panel.texels);
    if (const auto deviation = panel_deviation(scene, panel.texels)) scene.deviations.push_back(*deviation);
    write_text(folder / description_file, description);

    const std::string lfdsims = fmt::format("lfdsim render display.toml --panel-image {} -o lfdsim.exr", scene.panel_file);
    guard_output(folder / scene.panel_file);
    write_image(folder / scene.panel_file, picture_of(panel.texels), {16, Encoding::linear, {}, {}}, &progress);
    progress.end();
    for (const PeerFile& file : scene.files) write_text(folder / file.name, file.bytes);
    write_text(folder / "README.txt", readme(scene, lfdsims));

    if (args.work.json())
        return print_json({{"output", args.folder.text()},
                           {"files", files},
                           {"command", scene.command},
                           {"picture", scene.picture},
                           {"lfdsim", lfdsims},
                           {"deviations", scene.deviations}});
    std::string text =
        fmt::format("{}: a scene for {}{}; render it there with\n  {}\nand lfdsim's picture of the same with\n  {}\n",
                    printable(args.folder.text()), name_of(peer), panel.text, scene.command, lfdsims);
    for (const std::string& deviation : scene.deviations) text += "deviates: " + deviation + "\n";
    print(text);
}

}  // namespace

CommandSpec export_command() {
    return {.name = "export",
            .summary = "Writes the display as a scene for another renderer, to check the result independently",
            .examples =
                "Examples:\n  lfdsim export pov display.toml --panel-image eia.png --set diffuser=none -o scene\n"
                "  lfdsim export cycles display.toml --panel-image eia.png --triangles 16380 --normals smooth -o scene\n"
                "  lfdsim export mitsuba display.toml --panel-image eia.png --channel r -o red",
            .run = with_options<ExportArguments>(run)};
}

}  // namespace lfdsim::cli
