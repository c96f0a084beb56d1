#include "cli/options/panel_source.h"

#include "cli/options/made_for.h"
#include "cli/output/output.h"
#include "cli/program/arguments.h"
#include "cli/program/input_files.h"
#include "image/compare/above_white.h"
#include "image/formats/image_file.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

namespace lfdsim::cli {

PanelImageOption::PanelImageOption(Command command)
    : option_(command.add_option("--panel-image", path_, "Picture that the panel shows: .png .exr .npy of its size")
                  .type_name("FILE")) {}

void PanelImageOption::check() const {
    if (given()) check_input("--panel-image", path_);
}

bool PanelImageOption::warn(const Display& display) const {
    const Metadata about = read_metadata(path_);
    const bool incomplete = about.count(incomplete_mark) > 0;
    if (incomplete) spdlog::warn("{}: is marked incomplete: the run that made it was interrupted, and the rest is black", path_);
    warn_if_for_another(path_, about, display);
    return incomplete;
}

PanelImageOption::Read PanelImageOption::read(const Display& display, Job& job) const {
    const Panel& panel = display.panel;
    const bool incomplete = warn(display);
    Texels texels = read_panel_image(path_, panel.encoding, panel.pixels[0], panel.pixels[1], &job);
    if (const std::string doubt = above_white(texels.data(), texels.columns() * texels.rows(), 4, LightOf::panel); !doubt.empty())
        spdlog::warn("{}: {}", path_, doubt);
    return {std::move(texels), incomplete};
}

ModelOption::ModelOption(Command command)
    : option_(command
                  .add_option("--model", path_,
                              "Mesh file to show (any format Assimp reads), or built-in:spheres; default: the description's "
                              "content.model or its objects, or the spheres where it has none")
                  .type_name("FILE")) {}

void ModelOption::apply(Display& display) const {
    for (const ContentFile& file : content_files(display)) remember_input(file.image ? "an image" : "the model", file.path);
    if (!given()) return;
    if (path_.empty()) throw InputError("--model", "the name is empty; give a mesh file or built-in:spheres");
    remember_input("the model", path_);
    display.content.model = path_;
    display.content.objects.clear();
}

ContentScene load_scene(const Display& display, const Geometry& geometry) {
    const std::vector<ContentFile> files = content_files(display);
    const ContentParts parts = load_parts(files);
    for (std::size_t i = 0; i < files.size(); ++i) {
        if (std::find(parts.begin(), parts.begin() + std::ptrdiff_t(i), parts[i]) != parts.begin() + std::ptrdiff_t(i)) continue;
        const ModelInfo about = info(*parts[i]);
        for (const std::string& note : about.notes) spdlog::warn("{}: {}", files[i].path, note);
        for (const std::string& file : about.files) remember_input("a file of the model", file);
    }
    return ContentScene(parts, display, geometry);
}

PatternOption::PatternOption(Command command)
    : option_(command.add_option("--pattern", name_, fmt::format("Test pattern to show: {}", fmt::join(pattern_names(), ", ")))
                  .type_name("NAME")) {
    command.add_option("--cell-pixels", cell_, "Checkerboard: side of a square").type_name("N");
    command.add_option("--view", view_, "View: position of the white one, -0.5 .. 0.5 of the elemental image from its centre")
        .type_name("X,Y");
    command.add_option("--edge-deg", edge_, "Edge: slant").type_name("A");
    command.add_option("--edge-depth-mm", depth_, "Edge: depth in front of the lenses' vertex plane").type_name("Z");
}

PatternOptions PatternOption::read() const {
    PatternOptions options;
    Faults faults;
    if (given()) faults.of([&] { word("--pattern", name_, pattern_names()); });
    const auto value = [&](const std::string& text, auto parse) {
        if (!text.empty()) faults.of(parse);
    };
    value(cell_, [&] { options.cell_pixels = int(whole_number("--cell-pixels", cell_, 1, 1 << 30)); });
    value(view_, [&] {
        const std::vector<double> xy = numbers("--view", view_, "0.25,0", "X,Y");
        options.view_x = xy[0];
        options.view_y = xy[1];
        if (std::max(std::abs(xy[0]), std::abs(xy[1])) > 0.5)
            throw InputError("--view", fmt::format("\"{}\" is not possible; both are -0.5 to 0.5 of the elemental image", view_));
    });
    value(edge_, [&] { options.edge_deg = number("--edge-deg", edge_); });
    value(depth_, [&] { options.depth_mm = number("--edge-depth-mm", depth_); });
    faults.report();
    return options;
}

}  // namespace lfdsim::cli
