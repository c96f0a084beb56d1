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

void PanelImageOption::check() const {
    if (given()) remember_input(image_.name(), path());
}

bool PanelImageOption::warn(const Display& display) const {
    const Metadata about = read_metadata(path());
    const bool incomplete = about.count(incomplete_mark) > 0;
    if (incomplete)
        spdlog::warn("{}: is marked incomplete: the run that made it was interrupted; its last words said what it contains",
                     path());
    warn_of_colours(path(), display.panel.encoding);
    warn_if_for_another(path(), about, display);
    return incomplete;
}

PanelImageOption::Read PanelImageOption::read(const Display& display, Job& job) const {
    const Panel& panel = display.panel;
    const bool incomplete = warn(display);
    Texels texels = read_panel_image(path(), panel.encoding, panel.pixels[0], panel.pixels[1], &job);
    if (const std::string doubt = above_white(texels.data(), texels.columns() * texels.rows(), 4, LightOf::panel); !doubt.empty())
        spdlog::warn("{}: {}", path(), doubt);
    return {std::move(texels), incomplete};
}

void ModelOption::apply(Display& display) const {
    if (!given()) return;
    remember_input("the model", path());
    display.content.model = path();
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

Option pattern_name(Command command) {
    return command.option("--pattern", "NAME", fmt::format("Test pattern to show: {}", fmt::join(pattern_names(), ", ")));
}

void check_pattern(const Option& pattern) {
    if (pattern.given()) word(pattern.name(), pattern.text(), pattern_names());
}

PatternOptions PatternOption::read() const {
    PatternOptions options;
    Faults faults;
    faults.of([&] { check_pattern(pattern_); });
    faults.of(cell_, [&] { options.cell_pixels = int(cell_.whole_number(1, 1 << 30)); });
    faults.of(view_, [&] {
        const std::vector<double> xy = view_.numbers("0.25,0");
        options.view_x = xy[0];
        options.view_y = xy[1];
        if (std::max(std::abs(xy[0]), std::abs(xy[1])) > 0.5)
            throw InputError(view_.name(),
                             fmt::format("\"{}\" is not possible; both are -0.5 to 0.5 of the elemental image", view_.text()));
    });
    faults.of(edge_, [&] { options.edge_deg = edge_.number(); });
    faults.of(depth_, [&] { options.depth_mm = depth_.number(); });
    faults.report();
    return options;
}

}  // namespace lfdsim::cli
