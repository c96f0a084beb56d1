#include "analysis/pictures/directions.h"

#include "analysis/pictures/views.h"
#include "base/constants.h"
#include "engine/render.h"
#include "image/sheet.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>

namespace lfdsim {
namespace {

constexpr int sheet_width = 480, strip_width = 400;  // pixels, of one picture of the contact sheets and of the animation
constexpr int views = 7, frames = 32;
constexpr double picture_error = 0.005;  // of a pixel, over a white screen's light: these pictures are only looked at

/// Returns the angle of the farthest views: 30 degrees, or 5 degrees beyond the field of view if that is more.
double most_deg(const Subject& s) { return std::clamp(std::ceil(0.5 * s.theory(0).fov_deg) + 5, 30., 75.); }

/// Returns the display with a camera of that many columns and the same frame.
Display sized(Display d, int width) {
    const double per = double(width) / double(d.camera.resolution[0]);
    d.camera.resolution = {width, std::max<std::int64_t>(16, std::lround(per * double(d.camera.resolution[1])))};
    return d;
}

/// A view and the photograph from the same position.
struct Pair {
    Image simulated, photograph;
};

Pair look(Subject& s, const Display& sized, double horizontal, double vertical, const Job& job) {
    const Display seen = seen_from(sized, horizontal, vertical);
    Quiet quiet(job);
    const double white = s.white_field(job);
    RenderOptions how = s.rendering();
    if (!seen.render.samples) how.target_error = picture_error * white;
    Rendering r = render(seen, s.geometry(), s.panel(job), how, quiet);
    Picture photograph = reference_photograph(seen, s.geometry(), s.scene(), s.threads(), {}, quiet);
    if (!r.complete || !photograph.complete) throw Stopped{};
    expose(r.image, white);
    return {std::move(r.image), std::move(photograph.image)};
}

}  // namespace

std::int64_t directions_steps(const Subject&) { return 8; }

Result measure_directions(Subject& s, Job& job) {
    Result result;
    const double most = most_deg(s);
    const Display small = sized(s.display(), sheet_width);
    std::vector<double> angles;
    for (int k = 0; k < views; ++k) angles.push_back(most * (2 * k - views + 1) / (views - 1));
    for (const std::string axis : {"horizontal", "vertical"}) {
        std::vector<Image> simulated, photographs;
        std::vector<std::string> labels;
        for (const double angle : angles) {
            Pair pair = axis == "horizontal" ? look(s, small, angle, 0, job) : look(s, small, 0, angle, job);
            simulated.push_back(std::move(pair.simulated));
            photographs.push_back(std::move(pair.photograph));
            labels.push_back(fmt::format("display, {:+.3g}\xc2\xb0", angle));
        }
        for (const double angle : angles) labels.push_back(fmt::format("scene, {:+.3g}\xc2\xb0", angle));
        std::move(photographs.begin(), photographs.end(), std::back_inserter(simulated));
        result.pictures.push_back(
            {"directions-" + axis,
             fmt::format("Views along the {} circle from {:.3g} to {:.3g} degrees, and the scene itself from the same positions",
                         axis, -most, most),
             contact_sheet(simulated, labels, views)});
        job.advance(3);
    }
    Animation strip{
        "directions",
        fmt::format("The camera moves back and forth between {:.3g} and {:.3g} degrees: display and scene", -most, most),
        {},
        0.1};
    const Display tiny = sized(s.display(), strip_width);
    for (int k = 0; k < frames; ++k) {
        const double angle = most * std::sin(2 * pi * k / frames);
        const Pair pair = look(s, tiny, angle, 0, job);
        strip.frames.push_back(contact_sheet(std::array{pair.simulated, pair.photograph},
                                             std::array{fmt::format("display, {:+.0f}\xc2\xb0", angle), std::string("scene")}, 2));
    }
    job.advance(2);
    result.animations.push_back(std::move(strip));
    result.figures["angles_deg"] = angles;
    return result;
}

}  // namespace lfdsim
