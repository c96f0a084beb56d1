#include "cli/options/work_options.h"

#include "base/on_threads.h"
#include "base/printable.h"
#include "cli/program/arguments.h"
#include "engine/devices/devices.h"
#include "engine/devices/memory.h"

#include <fmt/format.h>

namespace lfdsim::cli {

int WorkOptions::threads() const { return threads_.empty() ? 0 : int(threads_.whole_number(1, most_threads)); }

void WorkOptions::check() const {
    Faults faults;
    faults.of([&] { threads(); });
    faults.of([&] { progress_.word(); });
    faults.report();
}

std::optional<Rect> CropOption::read(const Camera& camera, double panel_bytes) const {
    const auto [width, height] = camera.resolution;
    std::optional<Rect> crop;
    if (!crop_.empty()) crop = rectangle(crop_.name(), crop_.text(), width, height);
    require_picture_memory(crop ? crop->x1 - crop->x0 : width, crop ? crop->y1 - crop->y0 : height, panel_bytes);
    return crop;
}

std::string DeviceOption::read() const {
    choose_device(device_.text(), "");
    return device_.text();
}

void print_made(const PictureMade& made, bool json, const std::string& more_text, const Json& more) {
    // The rate is that of tracing alone: files and start take the same time with all kernels.
    const double rate = made.seconds > 0 ? double(made.count) / made.seconds : 0;
    if (json) {
        Json all{{"output", made.path},   {"width", made.width},     {"height", made.height},
                 {made.unit, made.count}, {"seconds", made.seconds}, {fmt::format("m{}_per_s", made.unit), rate / 1e6}};
        all.update(more);
        return print_json(all);
    }
    std::string text = fmt::format("{}: {} x {} pixels", printable(made.path), made.width, made.height);
    if (made.count > 0)
        text += fmt::format(", {:.1f} million {} in {:.2f} s ({:.1f} million/s)", double(made.count) / 1e6, made.unit, made.seconds,
                            rate / 1e6);
    print(text + more_text + "\n");
}

}  // namespace lfdsim::cli
