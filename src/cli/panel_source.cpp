#include "cli/panel_source.h"

#include "cli/arguments.h"
#include "cli/output.h"
#include "image/image_file.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

namespace lfdsim::cli {

PanelImageOption::PanelImageOption(Command command)
    : option_(command.add_option("--panel-image", path_, "What the panel shows: .png .exr .npy of its size").type_name("FILE")) {}

void PanelImageOption::check() const {
    if (given()) check_input("--panel-image", path_);
}

PanelImageOption::Read PanelImageOption::read(const Panel& panel, Job& job) const {
    const bool incomplete = read_metadata(path_).count(incomplete_mark) > 0;
    if (incomplete)
        spdlog::warn("{}: is marked incomplete: the run that made it was interrupted, and what it had not done is black", path_);
    return {read_panel_image(path_, panel.encoding, panel.pixels[0], panel.pixels[1], &job), incomplete};
}

ModelOption::ModelOption(Command command)
    : option_(command
                  .add_option(
                      "--model", path_,
                      "Mesh file to show (any format Assimp reads), or built-in:spheres; default: the description's content.model")
                  .type_name("FILE")) {}

void ModelOption::apply(Display& display) const {
    if (given()) display.content.model = path_;
}

Scene load_scene(const Display& display, const Geometry& geometry) {
    if (display.content.model.empty())
        throw InputError("--model",
                         "there is nothing to show; give a mesh file or built-in:spheres, or set content.model in the description");
    const std::shared_ptr<const Model> model = load_model(display.content.model);
    for (const std::string& note : info(*model).notes) spdlog::warn("{}: {}", display.content.model, note);
    return Scene(model, display, geometry);
}

Json stamp(const std::string& file) {
    std::error_code error;
    const auto changed = std::filesystem::last_write_time(file, error);
    if (error) return {{"file", file}};
    return {{"file", file}, {"bytes", std::filesystem::file_size(file, error)}, {"changed", changed.time_since_epoch().count()}};
}

PatternOption::PatternOption(Command command)
    : option_(command.add_option("--pattern", name_, fmt::format("Test pattern to show: {}", fmt::join(pattern_names(), ", ")))
                  .type_name("NAME")) {
    command.add_option("--cell-pixels", cell_, "Checkerboard: side of a square").type_name("N");
    command.add_option("--view", view_, "View: which one is white, -0.5 .. 0.5 of the elemental image from its centre")
        .type_name("X,Y");
    command.add_option("--edge-deg", edge_, "Edge: slant").type_name("A");
    command.add_option("--edge-depth-mm", depth_, "Edge: where it stands before the lenses' vertex plane").type_name("Z");
}

PatternOptions PatternOption::read() const {
    PatternOptions options;
    Faults faults;
    if (given()) faults.of([&] { word("--pattern", name_, pattern_names()); });
    const auto value = [&](const char* option, const std::string& text, const char* pattern, auto parse) {
        if (text.empty()) return;
        if (name_ != pattern) faults.of([&] { throw InputError(option, fmt::format("is for --pattern {} alone", pattern)); });
        faults.of(parse);
    };
    value("--cell-pixels", cell_, "checkerboard",
          [&] { options.cell_pixels = int(whole_number("--cell-pixels", cell_, 1, 1 << 30)); });
    value("--view", view_, "view", [&] {
        const std::vector<double> xy = numbers("--view", view_, 2);
        options.view_x = xy[0];
        options.view_y = xy[1];
        if (std::max(std::abs(xy[0]), std::abs(xy[1])) > 0.5)
            throw InputError("--view", fmt::format("\"{}\" is not possible; both are -0.5 to 0.5 of the elemental image", view_));
    });
    value("--edge-deg", edge_, "edge", [&] { options.edge_deg = number("--edge-deg", edge_); });
    value("--edge-depth-mm", depth_, "edge", [&] { options.depth_mm = number("--edge-depth-mm", depth_); });
    faults.report();
    return options;
}

}  // namespace lfdsim::cli
