#include "engine/devices/memory.h"
#include "engine/views/screen.h"
#include "geometry/geometry.h"
#include "image/compare/above_white.h"
#include "image/formats/image_file.h"
#include "image/overlay/overlay.h"
#include "image/overlay/overlay_picture.h"
#include "python/arrays.h"
#include "python/parts.h"
#include "python/work.h"

#include <fmt/format.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>

#include <optional>

// Comparisons of photographs of real displays with views of simulated ones; pictures as the bytes of PNG files.
namespace lfdsim::python {
namespace {

namespace nb = nanobind;

/// The corners of the screen in a view of the display's camera, pixels. Throws InputError if it has no four corners there.
Corners screen_corners(const Display& display) {
    const ScreenCorners corners = lfdsim::screen_corners(display, resolve(display));
    if (!corners.at)
        throw InputError("display, camera_mm, target_mm", corners.missing + "; give four points that view and photograph show");
    return *corners.at;
}

/// Lays a photograph over a view and compares them. Both corners are those of the screen, in pixels of their picture; `crop` is a
/// part of the view; `linear`: the photograph's codes are linear light, else sRGB. Throws InputError.
Overlay overlay(const AnyPixels& view, const AnyPixels& photo, const Corners& corners, const Corners& view_corners,
                const std::optional<CropBox>& crop, bool linear, bool fit_corners, bool fit_blur) {
    const auto columns = int(columns_of(view)), rows = int(rows_of(view));
    check_near("corners_px", corners, "the photograph", int(columns_of(photo)), int(rows_of(photo)), 0.5);
    check_near("view_corners_px", view_corners, "the view", columns, rows, 100);
    check_corners("corners_px", corners);
    check_corners("view_corners_px", view_corners);
    require_memory("view", fmt::format("mapping a photograph onto {} x {} pixels", columns, rows),
                   overlay_bytes(columns, rows) + picture_bytes(columns_of(photo), rows_of(photo)));
    OverlayOptions options{fit_corners, fit_blur, rect_of(crop)};
    const Encoding encoding = linear ? Encoding::linear : Encoding::srgb;
    Overlay made;
    run(nb::none(), [&](Job& job) {
        made = lay_over(image_of(view, Encoding::srgb, "view"), view_corners,
                        {image_of(photo, encoding, "photograph"), !std::holds_alternative<Pixels<float>>(photo), encoding, corners},
                        options, job);
    });
    return made;
}

nb::typed<nb::dict, std::string, nb::any> figures(const Overlay& o) {
    nb::dict all;
    visit_figures(o, [&](const char* name, const auto& value) { all[name] = value; });
    return all;
}

/// The bytes of a PNG file of 8 bits in sRGB, and the warning of light that it cuts off, or an empty text.
nb::typed<nb::tuple, nb::bytes, std::string> png(const AnyPixels& picture) {
    std::string bytes;
    CutOff cut;
    run(nb::none(), [&](Job&) {
        const Image image = image_of(picture, Encoding::srgb, "picture");
        cut.add(image);
        bytes = image_bytes(".png", image);
    });
    return nb::make_tuple(nb::bytes(bytes.data(), bytes.size()), cut.text());
}

}  // namespace

void add_photographs(nb::module_& m) {
    m.def("screen_corners", screen_corners, nb::arg("display"));
    nb::class_<Overlay>(m, "Overlay")
        .def("figures", figures)
        .def("simulated", [](const Overlay& o) { return array_of(Image(o.match.simulated)); })
        .def("photograph", [](const Overlay& o) { return array_of(Image(o.match.photograph)); })
        .def("sheet", [](const Overlay& o) { return array_of(overlay_picture(o.match, o.screen)); })
        .def("difference", [](const Overlay& o) { return array_of(difference_picture(o.match, o.screen)); });
    m.def("overlay", overlay, nb::arg("view"), nb::arg("photograph"), nb::arg("corners"), nb::arg("view_corners"),
          nb::arg("crop").none(), nb::arg("linear"), nb::arg("fit_corners"), nb::arg("fit_blur"));
    m.def("png", png, nb::arg("picture"));
}

}  // namespace lfdsim::python
