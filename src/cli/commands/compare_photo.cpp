#include "cli/commands/compare_photo.h"

#include "base/counted.h"
#include "cli/output/output.h"
#include "cli/program/arguments.h"
#include "cli/program/input_files.h"
#include "cli/program/interrupt.h"
#include "engine/devices/memory.h"
#include "engine/views/screen.h"
#include "files/description/display_file.h"
#include "image/overlay/overlay.h"
#include "image/overlay/overlay_picture.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <utility>

namespace lfdsim::cli {
namespace {

Corners read_corners(const List& list) {
    const std::string& option = list.name();
    const std::vector<std::string>& texts = list.texts();
    if (texts.size() != 4)
        throw InputError(option, fmt::format("has {}; give four, X,Y each: top left, top right, bottom right, bottom left",
                                             counted(texts.size(), "corner")));
    Corners corners;
    Faults faults;
    for (std::size_t k = 0; k < 4; ++k)
        faults.of([&] {
            const std::vector<double> xy = numbers(option, texts[k], "1204,387", "X,Y");
            corners[k] = {xy[0], xy[1]};
        });
    faults.report();
    check_corners(option, corners);
    return corners;
}

/// The corners of the screen in a view, pixels, from the display and the camera that the picture's metadata describes. Throws
/// InputError if it describes none, if the picture is a part of the frame, or if the screen has no four corners for that camera.
Corners corners_from_display(const std::string& path, const Metadata& about, const Image& view) {
    const auto text = about.find("display");
    if (text == about.end())
        throw InputError(path, "does not say which display it shows; give the corners of the screen in it: --view-corners");
    const Display display = parse_display(text->second, path + ": display");
    if (display.camera.resolution[0] != view.width || display.camera.resolution[1] != view.height)
        throw InputError(path, fmt::format("is {} x {} pixels, a part of the camera's {} x {}; render the whole frame, or give the "
                                           "corners of the screen in it: --view-corners",
                                           view.width, view.height, display.camera.resolution[0], display.camera.resolution[1]));
    const ScreenCorners corners = screen_corners(display, resolve(display));
    if (!corners.at)
        throw InputError(path, corners.missing + "; give four points that both pictures show: --corners and --view-corners");
    check_corners(path, *corners.at);
    return *corners.at;
}

}  // namespace

void PhotoOptions::run(const std::string& view_path, const std::string& photo_path, const Option& encoding, const Option& crop,
                       bool json) const {
    // The options, before any file is read.
    Faults faults;
    Corners view_corners;
    Image view;
    ScreenPhoto photo;
    faults.of([&] { photo.encoding = encoding_of(encoding); });
    faults.of([&] { photo.corners = read_corners(corners_); });
    if (view_corners_.given()) faults.of([&] { view_corners = read_corners(view_corners_); });
    faults.of([&] { remember_input("A", view_path); });
    faults.of([&] { remember_input("B", photo_path); });
    for (const Option& output : {difference_, overlay_})
        if (output.given()) faults.of([&] { check_output(output.text()); });
    if (!overlay_.empty() && overlay_.text() == difference_.text())
        faults.of([] { throw InputError("--overlay, --difference", "name the same file; give two names"); });
    faults.report();
    // The files: faults of both are reported together.
    faults.of([&] {
        view = read_image(view_path, Encoding::srgb);
        warn_of_colours(view_path, Encoding::srgb);
        warn_above_white(view_path, view);
        const Metadata about = read_metadata(view_path);
        if (about.count(incomplete_mark))
            spdlog::warn("{}: is marked incomplete: the run that made it was interrupted, and the rest is black", view_path);
        if (!view_corners_.given()) view_corners = corners_from_display(view_path, about, view);
        check_near("--view-corners", view_corners, view_path, view.width, view.height, 100);
    });
    faults.of([&] {
        photo.image = read_image(photo_path, photo.encoding);
        warn_of_colours(photo_path, photo.encoding);
        warn_above_white(photo_path, photo.image);
        photo.codes = holds_codes(photo_path);
        check_near("--corners", photo.corners, photo_path, photo.image.width, photo.image.height, 0.5);
    });
    std::optional<Rect> part;
    faults.of([&] {
        if (!crop.empty() && view.width > 0) part = rectangle(crop.name(), crop.text(), view.width, view.height);
    });
    faults.report();
    require_memory(view_path, fmt::format("mapping a photograph onto {} x {} pixels", view.width, view.height),
                   overlay_bytes(view.width, view.height) + picture_bytes(photo.image.width, photo.image.height));
    const Overlay overlay = lay_over(view, view_corners, std::move(photo), {fit_corners_, fit_blur_, part});
    const auto& [found, screen, m] = overlay;

    for (const auto& [output, draw] : {std::pair(overlay_, &overlay_picture), {difference_, &difference_picture}}) {
        if (output.empty()) continue;
        guard_output(output.text());
        write_image(output.text(), draw(m, screen), {8, Encoding::srgb, {{"Software", software}}});
    }
    const std::int64_t pixels = screen.pixels();
    if (json) {
        Json all;
        visit_figures(overlay, [&](const char* name, const auto& value) { all[name] = value; });
        if (!fit_blur_) all["blur_px"] = nullptr;
        all["view_corners"] = view_corners;
        return print_json(all);
    }
    std::string text = fmt::format(
        "SSIM         {:.6f}\n"
        "PSNR         {:.3f} dB (linear light)\n"
        "RMSE         {:.6g} (linear light of the view)\n"
        "gains        {:.4g} {:.4g} {:.4g} (photograph / view: red, green, blue)\n",
        m.ssim, m.psnr_db, m.rmse, m.gains[0], m.gains[1], m.gains[2]);
    if (fit_blur_) text += fmt::format("blur         {:.3f} pixels of the view (standard deviation)\n", m.blur_px);
    if (fit_corners_) {
        text += "corners     ";
        for (const auto& [x, y] : found) text += fmt::format(" {:.2f},{:.2f}", x, y);
        text += " (fitted)\n";
    }
    text += fmt::format("pixels       {} on the screen, {:.2f} % of them not saturated\n", pixels, 100 * m.used);
    print(text);
}

}  // namespace lfdsim::cli
