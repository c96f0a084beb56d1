#include "engine/views/compare_view.h"

#include "base/input_error.h"
#include "base/seconds.h"
#include "display/colour.h"
#include "engine/devices/gpu.h"
#include "engine/estimator/panel_planes.h"
#include "engine/scene/traced_display.h"
#include "engine/scene/work.h"

#include <fmt/format.h>
#include <chrono>
#include <stdexcept>

namespace lfdsim {

Expected::Expected(Image photograph, Region on_screen, Region on_content)
    : screen(std::move(on_screen)),
      content(std::move(on_content)),
      photograph_(std::move(photograph)),
      on_gpus_(std::make_shared<GpuPhotographs>()) {}

ComparedView compare_view(const Display& display, const Geometry& geometry, const SummedPanel& panel, const Expected& expected,
                          float gain, const RenderOptions& options, Job& job) {
    if (options.target_error) throw std::invalid_argument("views are compared without a target error");
    const auto start = std::chrono::steady_clock::now();
    const std::vector<optics::SummedImage>& planes = planes_of(panel, panel_reading(display));
    const Work work(by_points(display), geometry, planes, options, job);
    const Image& photograph = expected.photograph();
    const int width = work.tile.x1 - work.tile.x0, height = work.tile.y1 - work.tile.y0;
    if (photograph.width != width || photograph.height != height)
        throw InputError("", fmt::format("the photograph is {} x {} pixels, the view {} x {}; only equal sizes can be compared",
                                         photograph.width, photograph.height, width, height));
    const ChosenDevice device = choose_device(options.device, options.kernel);
    RenderOptions on_cpu = options;
    Display shown = display;
    if (device.gpu && !disperses(display) && estimator_of(display) != Estimator::lens_by_lens) {
        if (const auto done = compare_on_gpu(device, panel, planes, expected, gain, work, job))
            return {done->likeness, done->run.done.complete, seconds_since(start), done->run.seconds};
        on_cpu.device = "cpu";  // by the GPU's points, so with the same bits
        shown = by_points(display);
    }
    Rendering view = render(shown, geometry, panel, on_cpu, job);
    ComparedView result;
    result.complete = view.complete;
    if (view.complete) result.likeness = likeness(std::move(view.image), gain, photograph, expected.screen, expected.content);
    result.seconds = seconds_since(start);
    return result;
}

}  // namespace lfdsim
