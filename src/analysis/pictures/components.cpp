#include "analysis/pictures/components.h"

#include "analysis/core/elemental_panel.h"
#include "analysis/core/figure_json.h"
#include "analysis/pictures/shown_content.h"
#include "analysis/pictures/views.h"
#include "display/keys.h"
#include "geometry/lens_misalignment.h"
#include "image/scaled.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

/// Returns the display without its lenses and their errors: one cell as large as the panel whose lens has hardly any power (its
/// focal length is a kilometre), in the vertex plane.
Display diffuser_alone(const Display& d, const Geometry& g) {
    Display bare = without_errors(d);
    bare.lens = Lens{IdealLens{{}, longest_mm}, {}};
    bare.array = LensArray{};
    bare.array.count = {{1, 1}};
    bare.array.pitch_mm = 1.01 * std::max({g.panel_width_mm, g.panel_height_mm, g.array_width_mm, g.array_height_mm});
    bare.array.gap_mm = g.vertex_plane_mm;
    bare.array.aperture = Aperture::cell;
    return bare;
}

/// Returns the middle of a picture, at most `width` x `height` pixels.
Rect middle(int columns, int rows, int width, int height) {
    width = std::min(width, columns), height = std::min(height, rows);
    const int x = (columns - width) / 2, y = (rows - height) / 2;
    return {x, y, x + width, y + height};
}

Image cut(const Image& from, const Rect& r) {
    Image part(r.x1 - r.x0, r.y1 - r.y0);
    for (int y = r.y0; y < r.y1; ++y) std::copy_n(from.at(r.x0, y), std::size_t(part.width) * 3, part.at(0, y - r.y0));
    return part;
}

/// Returns a picture with pixels a whole number of times as wide and high.
Image enlarged(const Image& image, int times) {
    Image big(image.width * times, image.height * times);
    for (int y = 0; y < big.height; ++y)
        for (int x = 0; x < big.width; ++x) std::copy_n(image.at(x / times, y / times), 3, big.at(x, y));
    return big;
}

}  // namespace

std::int64_t components_steps(const Subject& s) { return s.display().diffuser ? 6 : 5; }

Result measure_components(Subject& s, Job& job) {
    Result result;
    const auto add = [&](const char* name, const std::string& caption, Image image) {
        result.pictures.push_back({std::string("components-") + name, caption, std::move(image)});
        job.advance(1);
    };
    const auto picture = [&](const Display& shown, const SummedPanel& panel, std::optional<Rect> crop = {}) {
        RenderOptions how = s.rendering();
        how.crop = crop;
        return whole_picture(shown, resolve(shown), panel, how, job);
    };
    const Display& d = s.display();
    const auto pixels_of_lens = [&](int axis) { return std::max(1, int(std::lround(s.theory(axis).views))); };
    const int lens_pixels = pixels_of_lens(0);
    const auto board = [&](int cell) {
        PatternOptions options;
        options.cell_pixels = cell;
        return ShownPanel(shown_texels(pattern("checkerboard", d, s.geometry(), options), d.panel.encoding), s.threads());
    };
    // Checks an eighth of a lens wide for the lenses, four lenses wide for the diffuser
    const int fine = std::max(1, lens_pixels / 8), coarse = 4 * lens_pixels;
    Display lenses = d;
    lenses.diffuser.reset();
    add("lenses", fmt::format("A checkerboard of {} panel pixels through the lens array alone", fine),
        picture(lenses, board(fine).summed()));
    if (d.diffuser)
        add("diffuser", fmt::format("A checkerboard of {} panel pixels through the diffuser alone, without lenses", coarse),
            picture(diffuser_alone(d, s.geometry()), board(coarse).summed()));
    else
        result.remarks.push_back("The display has no diffuser.");
    add("view", "The scene as the whole display shows it", picture(d, s.panel(job)));
    const int columns = int(d.camera.resolution[0]), rows = int(d.camera.resolution[1]);
    const Rect near = middle(columns, rows, columns / 6, rows / 6);
    Image close = picture(d, s.panel(job), near);
    add("view-close", "The middle sixth of the same picture", enlarged(close, std::max(1, 960 / close.width)));
    {
        Quiet quiet(job);
        const Picture elemental = shown_content(d, s.geometry(), s.scene(), s.threads(), quiet).picture;
        if (!elemental.complete) throw Stopped{};
        add("elemental", "The elemental images on the panel", reduced(elemental.image, 1920));
        const Rect middle_lenses = middle(elemental.image.width, elemental.image.height, 6 * lens_pixels, 4 * pixels_of_lens(1));
        close = cut(elemental.image, middle_lenses);
        add("elemental-close", "The elemental images of the middle 6 x 4 lenses", enlarged(close, std::max(1, 960 / close.width)));
    }
    result.figures["pixels_per_lens"] = axes_json(d.array, s.theory(0).views, s.theory(1).views);
    return result;
}

}  // namespace lfdsim
