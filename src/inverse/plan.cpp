#include "inverse/plan.h"

#include "base/input_error.h"
#include "engine/devices/memory.h"
#include "engine/views/panel_rays.h"
#include "geometry/subpixels.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <random>
#include <utility>

namespace lfdsim {
namespace {

constexpr std::int64_t fewest_places = 24;  // of a box: with 6 or 8 some eyes between them lose 1 to 2.6 dB
constexpr std::int64_t most_places = 1024;  // unless a number is given: where views have too few elements, more take very long
constexpr double rim_weight = 0.25;         // of all eyes around the boxes, relative to that of all eyes in them
constexpr double fewest_rows = 2, fewest_rays = 20;  // for each panel pixel met: below this the fit follows noise
constexpr std::int64_t rays_to_count = 4;            // of an element, to count the pixels that are met

/// Returns the bytes of the unknowns: seven arrays of them, and integers of twice the size.
double unknowns_bytes(const Display& d) { return 10 * texel_bytes(d); }

/// Returns the shift of an eye's grid of elements, along both axes uniform in [0, 1): a function of seed and number alone.
std::pair<double, double> shift_of(const Request& request, std::int64_t place) {
    std::mt19937_64 random(std::uint64_t(request.display.render.seed) * 1000003 + std::uint64_t(place));
    const auto next = [&] { return double(random() >> 11) * 0x1p-53; };
    const double x = next();
    return {x, next()};
}

}  // namespace

std::vector<Eye> eyes_at(std::span<const Vec3d> places, std::int64_t first, float weight) {
    std::vector<Eye> eyes;
    for (const Vec3d& place : places) eyes.push_back({place, first + std::int64_t(eyes.size()), weight});
    return eyes;
}

Display display_of(const Request& request, const Display& display, const Geometry& geometry, const Eye& eye, std::int64_t rays) {
    const auto [x, y] = shift_of(request, eye.number);
    Display seen = eye.picture ? seen_by_camera_at(display, geometry, eye.place, {eye.picture->width, eye.picture->height})
                               : seen_by_eye(display, geometry, eye.place, request.content_z_mm, x, y);
    seen.render.samples = rays;
    // Each eye has different rays: what a fit makes of one eye's noise is then noise for the next.
    seen.render.seed = std::int64_t((std::uint64_t(display.render.seed) + 0x9e3779b97f4a7c15u * std::uint64_t(eye.number)) >> 1);
    return seen;
}

InputError no_light(const Request& request) {
    const char* const none = "no ray from these eyes ends on the panel";
    return request.boxes.empty() ? InputError("target_eyes_mm", none)
                                 : InputError("content.inverse.eyes_mm",
                                              fmt::format("{}; give a box from which the display is bright (--eyes-mm)", none));
}

EyeCounts count(const Request& request, std::span<const Eye> eyes) {
    const auto [columns, rows] = request.display.panel.pixels;
    std::vector<std::uint8_t> met(std::size_t(columns) * std::size_t(rows), 0);
    std::vector<EyeCounts> each(eyes.size());
    tbb::parallel_for(std::size_t(0), eyes.size(), [&](std::size_t k) {
        if (request.job.cancelled()) return;
        EyeCounts& counts = each[k];
        const Display seen = display_of(request, request.display, request.geometry, eyes[k], rays_to_count);
        const PanelRays rays(seen, resolve(seen));
        std::vector<PanelRay> found;
        rays.trace({0, 0, int(seen.camera.resolution[0]), int(seen.camera.resolution[1])}, found);
        const bool subpixels = !lights_whole_pixels(seen.panel);
        const auto samples = std::size_t(rays.samples());
        for (std::size_t p = 0; p < found.size(); p += samples) {
            bool lit = false;
            for (std::size_t s = p; s < p + samples; ++s)
                if (found[s].share > 0) {
                    std::atomic_ref(met[found[s].pixel(subpixels)]).store(1, std::memory_order_relaxed);
                    counts.lit += 1 / double(samples);  // for one ray an element
                    lit = true;
                }
            counts.rows += lit;
        }
    });
    EyeCounts counts;
    for (const EyeCounts& one : each) counts = {0, counts.rows + one.rows, counts.lit + one.lit};
    counts.pixels = double(std::count(met.begin(), met.end(), 1));
    if (!(counts.pixels > 0) && !request.job.cancelled()) throw no_light(request);
    return counts;
}

std::int64_t rays_for(const EyeCounts& counts) {
    const double needed = rays_wanted * counts.pixels / counts.lit;
    return 4 * std::clamp<std::int64_t>(std::int64_t(std::ceil(needed / 4)), 1, 1024);
}

bool are_few_rays(double rows, double rays) { return rows < fewest_rows || rays < fewest_rays; }

std::string warning_of_few_rays(const Request& request, std::int64_t places, double rows, double rays) {
    const Inverse& keys = request.keys();
    const bool pictures = request.boxes.empty();
    std::vector<std::string> remedies;
    if (rows < fewest_rows || !keys.rays) {
        const double enough = std::ceil(double(places) * std::max({rows_wanted / rows, keys.rays ? 1. : fewest_rays / rays, 1.}));
        remedies.push_back(pictures ? fmt::format("give pictures for {:.0f} eyes or more", enough)
                                    : fmt::format("give content.inverse.places = {:.0f} or more", enough));
    }
    if (keys.rays) remedies.emplace_back("leave out content.inverse.rays");
    const std::string pulled = fmt::format(", and is pulled to {} (prior {})",
                                           pictures ? "the mean of the pictures" : "traced or integrated content", careful_prior);
    return fmt::format(
        "the eyes' views have {:.3g} elements and {:.3g} rays with light for each panel pixel that they meet; below {} "
        "and {} the fit follows noise{}; {}",
        rows, rays, fewest_rows, fewest_rays, keys.prior ? "" : pulled, fmt::join(remedies, ", and "));
}

std::int64_t white_points_for(const Request& request, const EyeCounts& counts, std::int64_t rays) {
    const bool subpixels = request.display.panel.subpixels != SubpixelLayout::none;
    const double lit_share = counts.lit / counts.rows / (subpixels ? 3 : 1);  // of the rays, in one colour
    return rays * std::clamp<std::int64_t>(std::int64_t(std::ceil(4 / lit_share)), 4, 16);
}

Plan plan(const Request& request) {
    // As many eyes in the boxes as views lie side by side, or as are given
    const Inverse& keys = request.keys();
    const double rim = keys.rim.value_or(is_strips(request.display.array) ? 0 : 3);
    Plan p{};
    const double views = views_within(request.boxes, request.display, request.geometry);
    const auto boxes = std::int64_t(request.boxes.size());
    if (keys.places && *keys.places < 2 * boxes && views > 0)
        throw InputError("content.inverse.places",
                         fmt::format("is {}; give at least two for each box of eyes that is not a point", *keys.places));
    p.in_boxes = keys.places.value_or(
        views > 0 ? std::max(fewest_places * boxes, std::int64_t(std::min(std::ceil(views), double(most_places)))) : boxes);
    // More of them, until their views have rows_wanted elements for each panel pixel met
    for (int attempt = 0;; ++attempt) {
        const EyeCounts inside = count(request, eyes_at(places_within(request.boxes, 0, p.in_boxes), 0));
        if (request.job.cancelled()) return p;
        const double ratio = inside.rows / inside.pixels;
        const bool fixed = keys.places || views == 0;
        if (fixed || ratio >= rows_wanted || attempt == 4) break;
        if (p.in_boxes >= most_places) break;
        p.in_boxes =
            std::min(std::int64_t(std::ceil(double(p.in_boxes) * std::max(1.05 * rows_wanted / ratio, 1.02))), most_places);
    }
    // As many around the boxes; four times as many, with as much weight in all, around boxes with width and height, whose rim has
    // corners
    p.eyes = eyes_at(places_within(request.boxes, 0, p.in_boxes), 0);
    const bool areas =
        std::ranges::any_of(request.boxes, [](const EyeBox& box) { return box.high[0] > box.low[0] && box.high[1] > box.low[1]; });
    const int times = areas ? 4 : 1;
    const std::vector<Vec3d> around = places_around(request.boxes, request.display, request.geometry, rim, times * p.in_boxes);
    for (const Eye& eye : eyes_at(around, 1'000'000, float(rim_weight / times))) p.eyes.push_back(eye);
    p.counts = count(request, p.eyes);
    if (request.job.cancelled()) return p;
    p.rays = keys.rays.value_or(rays_for(p.counts));
    return p;
}

void require_memory_for_panel(const Display& d) {
    require_memory("panel.pixels", "the inverse pick-up, with its arrays of the panel's size,",
                   unknowns_bytes(d) + picture_bytes(d.panel.pixels[0], d.panel.pixels[1]));
}

double memory_for_rays(const Request& request, const Display& seen) {
    const Inverse& keys = request.keys();
    const double unknowns = unknowns_bytes(request.display);
    const double view =
        double(seen.camera.resolution[0]) * double(seen.camera.resolution[1]) * double(*seen.render.samples) * sizeof(PanelRay);
    const double bytes = keys.memory_mb ? *keys.memory_mb * 1e6 : std::max(free_bytes() - unknowns, 0.) / 2;
    if (bytes < view)
        throw InputError("content.inverse.memory_mb",
                         fmt::format("{:.0f} MB is less than the rays of one view take; give {:.0f} or more", bytes / 1e6,
                                     std::ceil(view / 1e6)));
    if (keys.memory_mb) require_memory("content.inverse.memory_mb", "rays that are kept", bytes);
    return bytes;
}

}  // namespace lfdsim
