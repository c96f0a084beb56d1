#include "analysis/core/elemental_panel.h"
#include "analysis/pictures/shown_content.h"
#include "base/counted.h"
#include "base/seconds.h"
#include "content/content.h"
#include "engine/devices/memory.h"
#include "engine/render.h"
#include "geometry/geometry.h"
#include "image/compare/above_white.h"
#include "image/compare/compare.h"
#include "image/formats/encoding.h"
#include "python/arrays.h"
#include "python/content.h"
#include "python/parts.h"
#include "python/work.h"

#include <fmt/format.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <chrono>
#include <memory>
#include <optional>

namespace lfdsim::python {
namespace {

namespace nb = nanobind;

using Notes = std::vector<std::string>;

/// A picture, and the warnings of making it.
struct PictureWithWarnings {
    Image image;
    Notes notes;
    /// Moves the picture into a Python object; needs Python's lock.
    nb::typed<nb::tuple, Pictured, Notes> objects() { return nb::make_tuple(array_of(std::move(image)), notes); }
};

/// The panel's picture of the display's content, linear light. Throws InputError.
PictureWithWarnings elemental(const Display& display, const Geometry& geometry, int threads, Job& job) {
    require_panel_memory(display);
    PictureWithWarnings made;
    ShownContent content = shown_content(display, geometry, scene_of(display, geometry, made.notes, job), threads, job);
    if (content.inverse) made.notes.insert(made.notes.end(), content.inverse->warnings.begin(), content.inverse->warnings.end());
    Picture& picture = content.picture;
    if (picture.dark > 0)
        made.notes.push_back(
            fmt::format("the light of {} never leaves its lens: black is shown there",
                        counted(picture.dark, display.panel.subpixels == SubpixelLayout::none ? "pixel" : "subpixel")));
    made.image = std::move(picture.image);
    return made;
}

nb::typed<nb::tuple, Pictured, Notes> elemental_images(const Display& display, int threads, const nb::object& progress) {
    PictureWithWarnings made;
    run(progress, [&](Job& job) { made = elemental(display, resolve(display), threads, job); });
    return made.objects();
}

/// The panel's picture that best shows the wanted pictures, linear light, to the eyes (docs/inverse.md).
nb::typed<nb::tuple, Pictured, Notes> invert_pictures(const Display& display, const std::vector<AnyPixels>& targets,
                                                      const std::vector<Vec3d>& eyes_mm, int threads, const nb::object& progress) {
    PictureWithWarnings made;
    run(progress, [&](Job& job) {
        require_panel_memory(display);
        EyePictures wanted{eyes_mm, {}};
        for (std::size_t k = 0; k < targets.size(); ++k)
            wanted.pictures.push_back(image_of(targets[k], display.panel.encoding, fmt::format("targets[{}]", k)));
        InvertedPanel panel = invert(display, resolve(display), wanted, threads, job);
        made = {std::move(panel.picture.image), std::move(panel.report.warnings)};
    });
    return made.objects();
}

nb::typed<nb::tuple, Pictured, Notes> photograph(const Display& display, const std::optional<CropBox>& crop, int threads,
                                                 const nb::object& progress) {
    PictureWithWarnings made;
    run(progress, [&](Job& job) {
        require_picture_memory(display.camera.resolution[0], display.camera.resolution[1], 0);
        const Geometry geometry = resolve(display);
        const ContentScene scene = scene_of(display, geometry, made.notes, job);
        made.image = reference_photograph(display, geometry, scene, threads, rect_of(crop), job).image;
    });
    return made.objects();
}

/// A picture that a panel shows, as the renderer reads it.
struct PreparedPanel {
    std::int64_t columns, rows;
    ShownPanel shown;
};

/// Throws InputError, which states both sizes, unless the picture has the panel's pixels.
void check_size(std::int64_t columns, std::int64_t rows, const Display& display) {
    const auto [its_columns, its_rows] = display.panel.pixels;
    if (columns != its_columns || rows != its_rows)
        throw InputError("panel",
                         fmt::format("is {} x {} pixels, the panel has {} x {} (panel.pixels); the sizes must be equal: an "
                                     "array of shape ({}, {}, 3)",
                                     columns, rows, its_columns, its_rows, its_rows, its_columns));
}

std::shared_ptr<const PreparedPanel> prepare(const Display& display, const AnyPixels& pixels, int threads,
                                             const nb::object& progress) {
    check_size(columns_of(pixels), rows_of(pixels), display);
    std::shared_ptr<const PreparedPanel> made;
    run(progress, [&](Job&) {
        made.reset(new PreparedPanel{columns_of(pixels), rows_of(pixels),
                                     ShownPanel(texels_of(pixels, display.panel.encoding, "panel"), threads)});
    });
    return made;
}

/// Renders the display with a prepared panel, else with the panel's picture `pixels`, else with the display's content. Returns the
/// picture, the warnings, and the seconds that rendering takes in C++, without the content and without Python.
nb::typed<nb::tuple, Pictured, Notes, double> render(const Display& display, const std::optional<AnyPixels>& pixels,
                                                     const PreparedPanel* panel, const std::optional<CropBox>& crop, int threads,
                                                     const std::string& device, const std::string& kernel,
                                                     const nb::object& progress) {
    if (pixels) check_size(columns_of(*pixels), rows_of(*pixels), display);
    if (panel) check_size(panel->columns, panel->rows, display);
    PictureWithWarnings made;
    double seconds = 0;
    run(progress, [&](Job& job) {
        const Rect part = rect_of(crop).value_or(Rect{0, 0, int(display.camera.resolution[0]), int(display.camera.resolution[1])});
        require_picture_memory(part.x1 - part.x0, part.y1 - part.y0, texel_bytes(display));
        const Geometry geometry = resolve(display);
        RenderOptions options{threads, kernel, rect_of(crop)};
        options.device = device;
        const auto seen = [&](const auto& shown) {
            const auto start = std::chrono::steady_clock::now();
            made.image = lfdsim::render(display, geometry, shown, options, job).image;
            seconds = seconds_since(start);
        };
        if (panel) return seen(panel->shown.summed());
        if (pixels) return seen(texels_of(*pixels, display.panel.encoding, "panel"));
        PictureWithWarnings content = elemental(display, geometry, threads, job);
        made.notes = std::move(content.notes);
        CutOff cut;
        cut.add(content.image);
        if (const std::string text = cut.text(); !text.empty())
            made.notes.push_back("the panel's content: " + text + "; the panel shows no more");
        if (!job.cancelled()) seen(shown_texels(content.image, display.panel.encoding));
    });
    return nb::make_tuple(array_of(std::move(made.image)), made.notes, seconds);
}

Pictured test_pattern(const Display& display, const std::string& name, int cell_pixels, const std::array<double, 2>& view,
                      double edge_deg, double depth_mm) {
    Image image;
    run(nb::none(), [&](Job&) {
        require_panel_memory(display);
        image = pattern(name, display, resolve(display), {cell_pixels, view[0], view[1], edge_deg, depth_mm});
    });
    return array_of(std::move(image));
}

nb::typed<nb::dict, std::string, double> compare(const AnyPixels& a, const AnyPixels& b, const std::optional<CropBox>& crop,
                                                 bool linear) {
    Comparison c{};
    run(nb::none(), [&](Job&) {
        const Encoding encoding = linear ? Encoding::linear : Encoding::srgb;
        const Image first = image_of(a, encoding, "a"), second = image_of(b, encoding, "b");
        try {
            c = lfdsim::compare(first, second, rect_of(crop));
        } catch (const InputError& error) {
            throw InputError(crop ? "crop" : "a, b", error.problems.front().what);
        }
    });
    nb::dict all;
    visit_figures(c, [&](const char* name, auto value) { all[name] = value; });
    return all;
}

/// The 8-bit codes, by the panel's encoding, with which the panel shows light.
nb::ndarray<nb::numpy, std::uint8_t> codes(const Display& display, const AnyPixels& light) {
    auto all = std::make_unique<std::vector<std::uint8_t>>();
    run(nb::none(), [&](Job&) { *all = encode8(panel_image_of(light, display.panel.encoding, "panel"), display.panel.encoding); });
    std::uint8_t* const data = all->data();
    const nb::capsule owner(all.get(), [](void* p) noexcept { delete static_cast<std::vector<std::uint8_t>*>(p); });
    all.release();
    return nb::ndarray<nb::numpy, std::uint8_t>(data, {std::size_t(rows_of(light)), std::size_t(columns_of(light)), 3}, owner);
}

/// Returns the files that a model is read from: its own, and those that it names.
std::vector<std::string> files_of_model(const std::string& path) { return info(*load_model(path)).files; }

}  // namespace

void add_pictures(nb::module_& m) {
    m.def("invert_pictures", invert_pictures, nb::arg("display"), nb::arg("targets"), nb::arg("eyes_mm"), nb::arg("threads"),
          nb::arg("progress").none());
    m.def("elemental_images", elemental_images, nb::arg("display"), nb::arg("threads"), nb::arg("progress").none());
    m.def("files_of_model", files_of_model, nb::arg("path"));
    m.def("photograph", photograph, nb::arg("display"), nb::arg("crop").none(), nb::arg("threads"), nb::arg("progress").none());
    nb::class_<PreparedPanel>(m, "Panel");
    m.def("prepare", prepare, nb::arg("display"), nb::arg("pixels"), nb::arg("threads"), nb::arg("progress").none());
    m.def("render", render, nb::arg("display"), nb::arg("pixels").none(), nb::arg("panel").none(), nb::arg("crop").none(),
          nb::arg("threads"), nb::arg("device"), nb::arg("kernel"), nb::arg("progress").none());
    m.def("pattern", test_pattern, nb::arg("display"), nb::arg("name"), nb::arg("cell_pixels"), nb::arg("view"),
          nb::arg("edge_deg"), nb::arg("depth_mm"));
    m.def("require_memory", require_memory, nb::arg("where"), nb::arg("what"), nb::arg("bytes"));
    m.def("compare", compare, nb::arg("a"), nb::arg("b"), nb::arg("crop").none(), nb::arg("linear"));
    m.def("codes", codes, nb::arg("display"), nb::arg("panel"));
}

}  // namespace lfdsim::python
