#include "engine/views/panel_rays.h"

#include "engine/devices/devices.h"

namespace lfdsim {

PanelRays::PanelRays(const Display& display, const Geometry& geometry, const std::string& kernel)
    : scene_(make_traced_display<float>(display, geometry)),
      view_(make_ray_origin(display, geometry)),
      kernel_(choose_kernel(kernel).run),
      samples_(std::uint32_t(samples_of(by_points(display)))),
      sampling_(display.render.sampling),
      dimensions_(sample_dimensions(display)) {}

void PanelRays::trace(const Rect& part, std::vector<PanelRay>& rays) const {
    rays.resize(std::size_t(part.x1 - part.x0) * std::size_t(part.y1 - part.y0) * samples_);
    kernel_({.display = &scene_,
             .view = &view_,
             .directions = &sobol_directions(),
             .texels = nullptr,
             .panel = {},
             .out = nullptr,
             .rays = rays.data(),
             .crop_x = part.x0,
             .crop_y = part.y0,
             .crop_width = part.x1 - part.x0,
             .x0 = part.x0,
             .y0 = part.y0,
             .x1 = part.x1,
             .y1 = part.y1,
             .samples = samples_,
             .strata = 0,
             .lens_by_lens = false,
             .block_side = 0,
             .cuts_pixel = false,
             .sampling = sampling_,
             .dimensions = dimensions_});
}

}  // namespace lfdsim
