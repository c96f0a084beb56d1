#include "analysis/resolution/fringes.h"

#include "analysis/core/channel_pixels.h"
#include "analysis/core/elemental_panel.h"
#include "analysis/pictures/views.h"
#include "base/constants.h"
#include "checks/depth_words.h"
#include "geometry/camera.h"
#include "image/sheet.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

constexpr double lenses_near_by = 16;                                    // across a picture from near by
constexpr int near_columns = 480, near_rows = 300, fringe_samples = 36;  // of such a picture; of each pixel
constexpr std::int64_t most_screen_columns = 960;

/// Returns a picture whose pixels are means over their area: single rays would beat with lenses and subpixels. Throws Stopped.
Image mean_picture(Display d, const Subject& s, const SummedPanel& panel, const Job& job) {
    d.camera.pixel_filter = PixelFilter::box;
    d.render.estimator = Estimator::filtered;
    d.render.samples = fringe_samples;
    return whole_picture(d, resolve(d), panel, s.rendering(), job);
}

/// Returns the display with a camera, at an angle, whose frame 16 lenses about the point (0, 0, z_mm) fill.
Display near_view(const Subject& s, double z_mm, double angle_deg) {
    const EdgeEye eye{angle_deg, s.viewing_distance_mm()};
    Display d = seen_by(s.display(), {eye.x_mm(), 0, eye.z_mm()});
    d.camera.target_mm = {0, 0, z_mm};
    d.camera.resolution = {near_columns, near_rows};
    d.camera.fov_deg.reset();
    d.camera.frame_width_mm = lenses_near_by * s.geometry().lattice.pitch[0] * std::abs(scale_to_plane(s.geometry(), z_mm, eye)) *
                              std::cos(angle_deg * degree);
    return d;
}

double mean_of(const Image& image) {
    double sum = 0;
    for (const float x : image.rgb) sum += double(x);
    return sum / double(image.rgb.size());
}

/// Scales pictures so that the brightest light in them is 1. Returns the factor.
double expose_together(const std::vector<Image*>& images) {
    float most = 0;
    for (const Image* image : images) most = std::max(most, *std::max_element(image->rgb.begin(), image->rgb.end()));
    if (!(most > 0)) return 1;
    for (Image* image : images)
        for (float& x : image->rgb) x /= most;
    return 1 / double(most);
}

/// Returns the bars themselves as the same camera sees them, white as bright as given.
Image bars_picture(const Display& d, const Bars& bars, double white) {
    constexpr int parts = 4;  // of a pixel, along each axis
    const CameraAxes axes = camera_axes(d.camera);
    const Vec3d& from = d.camera.position_mm;
    const double step = *d.camera.frame_width_mm / near_columns / parts;
    const std::array<double, 2> axis = across(bars);
    Image image(near_columns, near_rows);
    for (int row = 0; row < near_rows * parts; ++row)
        for (int column = 0; column < near_columns * parts; ++column) {
            const double right = (column + 0.5 - 0.5 * near_columns * parts) * step,
                         up = (0.5 * near_rows * parts - row - 0.5) * step;
            Vec3d to{};
            for (std::size_t k = 0; k < 3; ++k)
                to[k] = axes.forward[k] * axes.distance_mm + axes.right[k] * right + axes.up[k] * up;
            // The point of the bars' plane on the ray, across the bars
            const double far = (bars.z_mm - from[2]) / to[2];
            const double place = (from[0] + far * to[0]) * axis[0] + (from[1] + far * to[1]) * axis[1] - bars.offset_mm;
            if (place < 0 || place >= bars.width_mm) continue;
            float* const pixel = image.at(column / parts, row / parts);
            for (int c = 0; c < 3; ++c) pixel[c] += float(white / (parts * parts));
        }
    return image;
}

}  // namespace

void show_white_fringes(const Subject& s, const Job& job, Result& result) {
    if (!has_colours(s.display())) return;
    const auto white = bars_panel(s.display(), s.geometry(), {}, s.threads());
    Display whole = seen_from(s.display(), 0, 0);
    auto& [columns, rows] = whole.camera.resolution;
    if (columns > most_screen_columns) {
        rows = std::max<std::int64_t>(1, std::llround(double(rows) * double(most_screen_columns) / double(columns)));
        columns = most_screen_columns;
    }
    Image screen = mean_picture(whole, s, white->summed(), job);
    const double exposure = expose_together({&screen});
    result.pictures.push_back(
        {"uniformity-white", fmt::format("A white screen, seen on axis; its light times {:.3g}", exposure), std::move(screen)});
    Image close = mean_picture(near_view(s, s.geometry().vertex_plane_mm, 0), s, white->summed(), job);
    const double close_exposure = expose_together({&close});
    result.pictures.push_back({"uniformity-white-close",
                               fmt::format("The middle {:g} lenses of a white screen, from the same place; light times {:.3g}",
                                           lenses_near_by, close_exposure),
                               std::move(close)});
}

void show_edge_fringes(const Subject& s, double depth_mm, const std::vector<double>& angles, const Job& job, Result& result) {
    if (!has_colours(s.display())) return;
    constexpr double without_end_mm = 1e9;
    Bars bars = bars_across(directions(s.geometry()).front(), s.geometry().vertex_plane_mm + depth_mm);
    bars.width_mm = without_end_mm;
    const auto edge = bars_panel(s.display(), s.geometry(), bars, s.threads()),
               white = bars_panel(s.display(), s.geometry(), {}, s.threads());
    std::vector<Image> pictures;
    std::vector<std::string> labels;
    for (const double angle : {angles.front(), angles.back()}) {
        const Display seen = near_view(s, bars.z_mm, angle);
        pictures.push_back(mean_picture(seen, s, edge->summed(), job));
        pictures.push_back(bars_picture(seen, bars, mean_of(mean_picture(seen, s, white->summed(), job))));
        labels.push_back(fmt::format("display, {:.3g}\xc2\xb0", angle));
        labels.push_back(fmt::format("edge, {:.3g}\xc2\xb0", angle));
    }
    const double exposure = expose_together({&pictures[0], &pictures[1], &pictures[2], &pictures[3]});
    result.pictures.push_back({"mtf-edge",
                               fmt::format("A black and white edge {}, {:g} lenses wide, beside the ideal edge at the mean "
                                           "brightness of white; light times {:.3g}",
                                           depth_in_words(depth_mm), lenses_near_by, exposure),
                               contact_sheet(pictures, labels, 2)});
}

}  // namespace lfdsim
