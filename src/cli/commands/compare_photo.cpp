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

Corners read_corners(const char* option, const std::vector<std::string>& texts) {
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

/// From the display that the picture carries.
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

Json pairs(const Corners& corners) {
    Json all = Json::array();
    for (const Point& p : corners) all.push_back(Json::array({p[0], p[1]}));
    return all;
}

}  // namespace

PhotoOptions::PhotoOptions(Command command) {
    constexpr const char* four = "X,Y X,Y X,Y X,Y";
    corners_option_ = command.add_option(
        "--corners", corners_,
        "B is a photograph of the display: the outer corners of its lens array there (of the part that is lit, "
        "where the array reaches over the panel), in pixels from the upper left corner of the picture as viewers "
        "show it; top left, top right, bottom right, bottom left of the screen as its viewer sees it");
    const Option view_corners =
        command.add_option("--view-corners", view_corners_,
                           "The same corners in A; default: from the display description stored in a picture made by lfdsim");
    for (Option option : {corners_option_, view_corners}) option.type_name(four).expected(1, 4);
    command.add_flag("--fit-corners", fit_corners_, "Move each corner by up to 5 pixels of the photograph for the best agreement");
    command.add_flag("--fit-blur", fit_blur_, "Blur A by the Gaussian that makes it most similar to the photograph");
    overlay_option_ =
        command.add_option("-o,--overlay", overlay_, "Picture to write: both side by side, as a checkerboard and half of each");
    difference_option_ =
        command.add_option("--difference", difference_, "Picture to write: where the photograph is brighter or darker");
    for (Option option : {overlay_option_, difference_option_}) option.type_name("FILE");
}

void PhotoOptions::run(const std::string& view_path, const std::string& photo_path, const std::string& encoding_name,
                       const std::string& crop, bool json) const {
    Faults faults;
    Corners view_corners;
    Image view;
    ScreenPhoto photo;
    faults.of([&] {
        photo.encoding = word("--encoding", encoding_name, {"srgb", "linear"}) == "srgb" ? Encoding::srgb : Encoding::linear;
    });
    faults.of([&] { photo.corners = read_corners("--corners", corners_); });
    if (!view_corners_.empty()) faults.of([&] { view_corners = read_corners("--view-corners", view_corners_); });
    faults.of([&] { check_input("A", view_path); });
    faults.of([&] { check_input("B", photo_path); });
    if (difference_option_.count() > 0) faults.of([&] { check_output(difference_, "--difference"); });
    if (overlay_option_.count() > 0) faults.of([&] { check_output(overlay_, "--overlay"); });
    if (!overlay_.empty() && overlay_ == difference_)
        faults.of([] { throw InputError("--overlay, --difference", "are two pictures of one name; give two names"); });
    faults.report();
    faults.of([&] {
        view = read_image(view_path, Encoding::srgb);
        warn_above_white(view_path, view);
        const Metadata about = read_metadata(view_path);
        if (about.count(incomplete_mark))
            spdlog::warn("{}: is marked incomplete: the run that made it was interrupted, and the rest is black", view_path);
        if (view_corners_.empty()) view_corners = corners_from_display(view_path, about, view);
        check_near("--view-corners", view_corners, view_path, view.width, view.height, 100);
    });
    faults.of([&] {
        photo.orientation = read_orientation(photo_path);
        photo.image = read_image(photo_path, photo.encoding);
        warn_above_white(photo_path, photo.image);
        photo.codes = holds_codes(photo_path);
        const bool turned = photo.orientation >= 5;
        const auto [width, height] = std::pair(photo.image.width, photo.image.height);
        check_near("--corners", photo.corners, photo_path, turned ? height : width, turned ? width : height, 0.5);
    });
    std::optional<Rect> part;
    faults.of([&] {
        if (!crop.empty() && view.width > 0) part = rectangle("--crop", crop, view.width, view.height);
    });
    faults.report();
    require_memory(view_path, fmt::format("mapping a photograph onto {} x {} pixels", view.width, view.height),
                   overlay_bytes(view.width, view.height) + picture_bytes(photo.image.width, photo.image.height));
    const auto [found, screen, m] = lay_over(view, view_corners, std::move(photo), {fit_corners_, fit_blur_, part});

    const Metadata about{{"Software", "lfdsim " LFDSIM_VERSION}};
    if (!overlay_.empty()) {
        guard_output(overlay_);
        write_image(overlay_, overlay_picture(m, screen), {8, Encoding::srgb, about});
    }
    if (!difference_.empty()) {
        guard_output(difference_);
        write_image(difference_, difference_picture(m, screen), {8, Encoding::srgb, about});
    }
    const std::int64_t pixels = screen.pixels();
    if (json) {
        Json all{{"ssim", m.ssim},
                 {"rmse", m.rmse},
                 {"psnr_db", m.psnr_db},
                 {"gains", m.gains},
                 {"blur_px", fit_blur_ ? Json(m.blur_px) : Json()},
                 {"pixels", pixels},
                 {"unsaturated_share", m.used},
                 {"corners", pairs(found)},
                 {"view_corners", pairs(view_corners)}};
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
