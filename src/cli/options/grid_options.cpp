#include "cli/options/grid_options.h"

#include "analysis/pictures/shown_content.h"
#include "base/constants.h"
#include "cli/program/arguments.h"
#include "cli/program/input_files.h"
#include "display/keys.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>

namespace lfdsim::cli {

ViewsWish GridOptions::read() const {
    ViewsWish wish;
    Faults faults;
    const auto value = [&](const Option& option, const Range& range, std::optional<double>& to) {
        faults.of(option, [&] {
            to = option.number();
            if (!range.contains(*to))
                throw InputError(option.name(), fmt::format("is {}, allowed is {}", option.text(), range.text()));
        });
    };
    value(width_, positive_length, wish.width_mm);
    value(depth_, any_length, wish.depth_mm);
    value(distance_, positive_length, wish.distance_mm);
    value(cone_, Range{0, 170, true}, wish.cone_deg);
    faults.of(cameras_, [&] { wish.cone = cameras_.word() == "ends" ? ConeCameras::ends : ConeCameras::bins; });
    faults.of(baseline_, [&] {
        const bool both = baseline_.text().find(',') != std::string::npos;
        const std::vector<double> xy = numbers(baseline_.name(), baseline_.text(), both ? "12,8" : "12", "B or BX,BY");
        for (const double step : xy)
            if (!positive_length.contains(step))
                throw InputError(baseline_.name(), fmt::format("is {}, allowed is {}", step, positive_length.text()));
        wish.baseline_mm = {xy.front(), xy.back()};
    });
    if (wish.baseline_mm && wish.cone_deg)
        faults.of(
            [] { throw InputError("--baseline-mm, --view-cone-deg", "both determine the cameras' positions; give one of them"); });
    faults.report();
    return wish;
}

ViewsPlace views_place(const Display& display, const Geometry& geometry) {
    ViewsPlace place{geometry.panel_width_mm,
                     geometry.panel_height_mm,
                     geometry.vertex_plane_mm,
                     geometry.content_depth_mm,
                     display.content.viewing_distance_mm,
                     display.content.view_cone_deg};
    if (line_of_eyes(geometry.lattice) == 1) {  // eyes side by side see the same, wherever they are: no quilt is made for that
        place.view_cone_deg.reset();
        place.zone_width_mm = infinity;
        return place;
    }
    place.lens_mm = display.array.pitch_mm[0] / geometry.lattice.cos_turn;
    // W = (D' - z_H') p' / (g cos(alpha)): docs/model.md, "Grids of views".
    const double away = place.viewing_distance_mm - geometry.rear_principal_mm;
    place.zone_width_mm =
        away * theory(display, geometry).along[0].elemental_pitch_mm / (geometry.gap_mm * geometry.lattice.cos_turn);
    return place;
}

std::string grid_text(const ViewGrid& grid) {
    const auto &first = grid.camera_mm.front(), &last = grid.camera_mm.back();
    return fmt::format(
        "{} x {} views over {:.4g} x {:.4g} mm, {:.4g} mm from their focus of {:.4g} x {:.4g} mm at a depth of {:.4g} mm",
        grid.columns, grid.rows, last[0] - first[0], first[1] - last[1], grid.distance_mm, grid.width_mm, grid.height_mm,
        grid.depth_mm);
}

Json grid_json(const ViewGrid& grid) {
    const auto &first = grid.camera_mm.front(), &last = grid.camera_mm.back();
    return {{"columns", grid.columns},
            {"rows", grid.rows},
            {"cameras_width_mm", last[0] - first[0]},
            {"cameras_height_mm", first[1] - last[1]},
            {"camera_distance_mm", grid.distance_mm},
            {"focus_width_mm", grid.width_mm},
            {"focus_height_mm", grid.height_mm},
            {"focus_depth_mm", grid.depth_mm}};
}

void ViewsOption::check() {
    if (!given()) return;
    wish_ = grid_.read();
    source_ = find_views(views_.text());
    if (flip_) flip(source_);
    for (const auto* const files : {&source_.pictures, &source_.depths, &source_.read})
        for (const std::filesystem::path& file : *files)
            if (!file.empty()) remember_input("a file of the views", file);
}

ViewsOption::PanelOfViews ViewsOption::make(const Display& display, const Geometry& geometry, int threads,
                                            Progress& progress) const {
    // The views, with warnings about assumptions and about their order.
    std::optional<ReadViews> views = read_views(source_, wish_, views_place(display, geometry), progress);
    progress.end();
    if (!views) end_interrupted();
    for (const std::filesystem::path& picture : source_.pictures)  // they are of one camera: one warning says it
        if (warn_of_colours(picture.string(), Encoding::srgb)) break;
    for (const std::string& note : views->notes) spdlog::warn("{}: {}", source_.name, note);
    if (views->doubt.against_depth)
        spdlog::warn("{}: near points of its depth map move from view to view as far points should: the views are pseudoscopic{}",
                     source_.name, flip_ ? "; leave out --flip-views" : "; --flip-views reverses them");
    else if (views->doubt.axes_disagree)
        spdlog::warn(
            "{}: the motion from column to column and that from row to row contradict each other in depth: rows or columns are in "
            "reversed order",
            source_.name);
    // The panel, by the pick-up of the description.
    const ViewGrid& grid = views->field.grid();
    if (line_of_eyes(geometry.lattice) == 1 && grid.rows == 1 && grid.columns > 1)
        spdlog::warn("{}: its cameras are side by side, but {}: all eyes get the same view. Give a grid of more than one row",
                     source_.name, same_from_both_sides(geometry.lattice));
    const bool inverse = display.content.pickup == PickupKind::inverse;
    PanelOfViews made{{}, "", grid_json(grid)};
    if (inverse) {
        const std::vector<EyeBox> eyes = inverse_eyes(display, geometry, threads, progress);
        if (eyes.empty()) end_interrupted();
        InvertedPanel panel = invert(display, geometry, views->field, eyes, threads, progress);
        made.field.picture = std::move(panel.picture);
        made.inverse = std::move(panel.report);
    } else {
        made.field = elemental_images(display, geometry, views->field, threads, progress);
    }
    // The description of the views and their grid, in words and as JSON.
    const double rays = double(std::max<std::int64_t>(made.field.picture.rays, 1));
    made.json.update({{"form", std::string(name_of(source_.form))},
                      {"view_width", views->width},
                      {"view_height", views->height},
                      {"by_depth", views->field.by_depth()},
                      {"flipped", source_.flipped},
                      {"beside_cameras", made.field.beside_cameras},
                      {"beside_focus", made.field.beside_focus}});
    made.text = fmt::format("; {}{}", grid_text(grid), views->field.by_depth() ? ", by depth" : "");
    if (made.field.beside_cameras > 0)
        made.text += fmt::format("; {:.1f} % of the rays pass beside the cameras and are black",
                                 100 * double(made.field.beside_cameras) / rays);
    if (made.field.beside_focus > 0)
        made.text +=
            fmt::format("; {:.1f} % pass beside the views' edges and are black", 100 * double(made.field.beside_focus) / rays);
    if (2 * double(made.field.beside_cameras + made.field.beside_focus) > rays)
        spdlog::warn(
            "{}: more than half of the panel is black, as its rays pass beside the views: their cameras or focus are not where "
            "this display shows them (--focus-width-mm, --focus-depth-mm)",
            source_.name);
    return made;
}

}  // namespace lfdsim::cli
