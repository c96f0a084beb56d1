#include "cli/options/shown_panel.h"

#include "analysis/pictures/shown_content.h"
#include "cli/output/inverse_report.h"
#include "report/folder/run_settings.h"

namespace lfdsim::cli {
namespace {

constexpr const char* less_light = "the panel shows no more; --set content.light.strength can darken it";

}  // namespace

PanelTexels shown_panel(const PanelImageOption& image, const PatternOption& shape, const Display& display, const Geometry& geometry,
                        const PatternOptions& pattern_options, int threads, Progress& progress) {
    if (image.given()) {
        PanelImageOption::Read panel = image.read(display, progress);
        return {std::move(panel.texels), {{"panel_image", {{"incomplete", panel.incomplete}}}}};
    }
    if (shape.given()) return {shown_texels(pattern(shape.name(), display, geometry, pattern_options), display.panel.encoding)};
    const ContentScene scene = load_scene(display, geometry);
    const auto [picture, inverse] = shown_content(display, geometry, scene, threads, progress);
    progress.end();
    if (!picture.complete) end_interrupted();
    std::string text;
    Json images = {{"rays", picture.rays}, {"seconds", picture.seconds}};
    if (inverse) {
        warn_of_inverse(*inverse);
        images["inverse"] = inverse_json(*inverse);
        text = "; content " + inverse_text(*inverse);
    }
    CutOff cut;
    cut.add(picture.image);
    images.update(warn_of_cut_off("the panel's content", cut, less_light));
    return {shown_texels(picture.image, display.panel.encoding),
            {{"elemental_images", std::move(images)}},
            std::move(text),
            scene.files()};
}

Json shown_stamps(const PanelImageOption& image, const PatternOption& shape, const Display& display) {
    std::vector<std::string> files = named_files(display, !image.given() && !shape.given());
    if (image.given()) files.push_back(image.path());
    return stamps(files);
}

}  // namespace lfdsim::cli
