#include "view/painting/eye_displays.h"

#include "engine/scene/traced_display.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace lfdsim::view {
namespace {

/// Returns the model that a panel image was made from, if the description names one.
std::string described_model(const Display& display) {
    return display.content.objects.empty() ? display.content.model : std::string(scene_of_objects);
}

EyeDisplay of_eye(const Library& library, const Wanted& wanted, const char* lane, int eye) {
    const Display display = library.display(wanted, eye);
    const Geometry geometry = resolve(display);
    EyeDisplay one{lane, display, geometry, display, geometry, source_of(library, wanted.shown, display), {}, {}};
    if (wanted.shown.hold) {
        one.made_for = library.display(wanted.without_settings());
        one.made_for_geometry = resolve(one.made_for);
        const auto& made = one.made_for.panel.pixels;
        if (made != display.panel.pixels)
            throw InputError("panel.pixels", fmt::format("is [{}, {}], but the stored elemental images have {} x {} pixels",
                                                         display.panel.pixels[0], display.panel.pixels[1], made[0], made[1]));
    }
    one.key = panel_key(one.source, one.made_for, one.made_for_geometry);
    one.model = one.source;
    if (one.source.kind == Shown::Kind::pattern) one.model = {};
    if (one.source.kind == Shown::Kind::panel_image) one.model = model_source(described_model(display), display);
    return one;
}

Display coarse_panel(Display d, const Geometry& g, int divisor) {
    for (std::int64_t& n : d.panel.pixels) n = (n + divisor - 1) / divisor;
    d.panel.pixel_pitch_mm *= divisor;
    d.camera.fov_deg.reset();
    d.camera.frame_width_mm = g.frame_width_mm;
    d.content.height_mm = g.content_height_mm;
    return d;
}

}  // namespace

std::vector<EyeDisplay> seen(const Library& library, const Wanted& wanted) {
    if (wanted.layout == Layout::one) return {of_eye(library, wanted, "one", 0)};
    return {of_eye(library, wanted, "left", -1), of_eye(library, wanted, "right", 1)};
}

std::optional<EyeDisplay> with_coarse_panel(const EyeDisplay& one, int divisor) {
    EyeDisplay coarse = one;
    coarse.display = coarse_panel(one.display, one.geometry, divisor);
    coarse.made_for = coarse_panel(one.made_for, one.made_for_geometry, divisor);
    if (!validate(coarse.display).empty() || !validate(coarse.made_for).empty()) return std::nullopt;
    coarse.geometry = resolve(coarse.display);
    coarse.made_for_geometry = resolve(coarse.made_for);
    coarse.key = panel_key(coarse.source, coarse.made_for, coarse.made_for_geometry);
    return coarse;
}

Display coarse_view(Display d, const Geometry& g, double scale, bool on_gpu) {
    for (std::int64_t& n : d.camera.resolution) n = std::max<std::int64_t>(1, std::llround(scale * double(n)));
    d.camera.fov_deg.reset();
    d.camera.frame_width_mm = g.frame_width_mm;
    d.camera.pixel_filter = PixelFilter::center;
    d.camera.pupil_diameter_mm.reset();
    d.render.estimator = on_gpu ? Estimator::point : Estimator::filtered;
    // Where the display is rendered by points, a single one would show only noise.
    d.render.samples = on_gpu ? 64 : estimator_of(d) == Estimator::filtered ? 1 : 4;
    return d;
}

}  // namespace lfdsim::view
