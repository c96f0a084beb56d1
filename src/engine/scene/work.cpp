#include "engine/scene/work.h"

#include "engine/scene/traced_display.h"

#include <fmt/format.h>
#include <cmath>
#include <stdexcept>

namespace lfdsim {

namespace {

Rect checked_crop(const std::optional<Rect>& crop, const Camera& camera) {
    const int width = int(camera.resolution[0]), height = int(camera.resolution[1]);
    const Rect r = crop.value_or(Rect{0, 0, width, height});
    if (r.x0 < 0 || r.y0 < 0 || r.x1 > width || r.y1 > height || r.x0 >= r.x1 || r.y0 >= r.y1) {
        throw InputError(
            "--crop",
            fmt::format("{},{},{},{} does not lie in the frame of {} x {} pixels; give X0,Y0,X1,Y1 with 0 <= X0 < X1 <= {} "
                        "and 0 <= Y0 < Y1 <= {}",
                        r.x0, r.y0, r.x1, r.y1, width, height, width, height));
    }
    return r;
}

}  // namespace

Work::Work(const Display& display, const Geometry& geometry, const std::vector<optics::SummedImage>& planes,
           const RenderOptions& options, const Job& job) {
    if (planes[0].columns != display.panel.pixels[0] || planes[0].rows != display.panel.pixels[1]) {
        throw InputError("panel image", fmt::format("{} x {} pixels; the panel has {} x {}", planes[0].columns, planes[0].rows,
                                                    display.panel.pixels[0], display.panel.pixels[1]));
    }
    if (options.target_error && !(*options.target_error > 0 && std::isfinite(*options.target_error)))
        throw InputError("--target-error", fmt::format("{}; allowed: more than 0", *options.target_error));
    const Rect crop = checked_crop(options.crop, display.camera);
    scene = make_traced_display<float>(display, geometry);
    view = make_ray_origin(display, geometry);
    const int dimensions = sample_dimensions(display);
    const std::int64_t samples = samples_of(display);

    result.estimator = estimator_of(display);
    const bool filtered = result.estimator != Estimator::point;
    const int strata = filtered ? int(std::lround(std::sqrt(double(samples)))) : 0;
    constexpr std::int64_t most = (max_strata - more_strata) * (max_strata - more_strata);
    if (filtered && samples > most)
        throw InputError("render.samples",
                         fmt::format("{}; at most {} filtered samples, or use the estimator \"point\"", samples, most));
    if (filtered && display.diffuser && display.diffuser->profile != Profile::box)
        throw std::logic_error("the filtered estimator's work is on even_parts()");
    if (dimensions > 0) target_error = options.target_error;
    // A target error takes more strata than the first picture has.
    const BlockShape shape = block_shape(scene, view, target_error ? 2 * few_strata : strata, options.rough);

    tile = {.display = &scene,
            .view = &view,
            .directions = &sobol_directions(),
            .texels = planes[0].texels,
            .panel = {.plane = planes.data(), .whole = scene.emission.whole, .emission = &scene.emission},
            .out = nullptr,  // make_pictures()
            .crop_x = crop.x0,
            .crop_y = crop.y0,
            .crop_width = crop.x1 - crop.x0,
            .x0 = crop.x0,
            .y0 = crop.y0,
            .x1 = crop.x1,
            .y1 = crop.y1,
            .samples = std::uint32_t(samples),
            .strata = strata,
            .lens_by_lens = filtered && (result.estimator == Estimator::lens_by_lens || !shape.shared),
            .block_side = shape.side,
            .cuts_pixel = cuts_pixel(scene, view),
            .sampling = display.render.sampling,
            .dimensions = dimensions,
            .job = &job};
}

void Work::make_pictures(bool with_error) {
    result.image = Image(tile.x1 - tile.x0, tile.y1 - tile.y0);
    if (with_error) result.error = Image(result.image.width, result.image.height);
    tile.out = result.image.rgb.data();
}

}  // namespace lfdsim
