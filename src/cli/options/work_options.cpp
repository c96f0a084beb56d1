#include "cli/options/work_options.h"

#include "base/printable.h"
#include "cli/program/arguments.h"
#include "engine/devices/devices.h"
#include "engine/devices/memory.h"

#include <fmt/format.h>

namespace lfdsim::cli {

WorkOptions::WorkOptions(Command command) {
    command.add_option("--threads", threads_, "Threads to use; default: one per processor").type_name("N");
    command.add_option("--progress", progress_, "Progress on standard error; auto: a bar on a terminal, else lines")
        .type_name("auto|bar|lines|json|none");
    command.add_flag("--json", json_, "Print results as JSON");
}

int WorkOptions::threads() const { return threads_.empty() ? 0 : int(whole_number("--threads", threads_, 1, 1024)); }

void WorkOptions::check() const {
    Faults faults;
    faults.of([&] { threads(); });
    faults.of([&] { word("--progress", progress_, {"auto", "bar", "lines", "json", "none"}); });
    faults.report();
}

CropOption::CropOption(Command command) {
    command.add_option("--crop", text_, "Only this part of the frame: columns X0 to X1-1, rows Y0 to Y1-1")
        .type_name("X0,Y0,X1,Y1");
}

std::optional<Rect> CropOption::read(const Camera& camera, double panel_bytes) const {
    const auto [width, height] = camera.resolution;
    std::optional<Rect> crop;
    if (!text_.empty()) crop = rectangle("--crop", text_, width, height);
    require_picture_memory(crop ? crop->x1 - crop->x0 : width, crop ? crop->y1 - crop->y0 : height, panel_bytes);
    return crop;
}

DeviceOption::DeviceOption(Command command) {
    command
        .add_option("--device", device_,
                    "Device that renders: auto uses a GPU where one works; default: environment variable LFDSIM_DEVICE, else auto")
        .type_name("auto|cpu|cuda|cuda:N");
}

void DeviceOption::apply() const { set_default_device(device_); }

void print_made(const Made& made, bool json, const std::string& more_text, const Json& more) {
    // Time of tracing alone: files and start are the same for all kernels.
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
