#include "inverse/inverse.h"

#include "base/input_error.h"
#include "base/on_threads.h"
#include "base/seconds.h"
#include "content/pictures/field_picture.h"
#include "display/keys.h"
#include "engine/devices/memory.h"
#include "engine/render.h"
#include "geometry/lens_misalignment.h"
#include "image/formats/image_file.h"
#include "inverse/box_solver.h"
#include "inverse/eye_views.h"
#include "inverse/fitted_views.h"
#include "inverse/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

namespace lfdsim {
namespace {

constexpr double usual_prior = 0.001;
constexpr std::int64_t content_samples = 16, held_out_content_samples = 64, held_out_rays = 512;
constexpr int patience = 5;             // steps after which held-out eyes must have gained ...
constexpr double least_gain_db = 0.01;  // ... this much, or the fit ends
constexpr const char* warning_of_errors =
    "the panel is made for the display as described, and shown by one with assembly errors: content.made_for = \"built\" makes it "
    "for that one";

/// Returns a panel picture as the unknowns of a fit, cut to 0 .. 1.
PanelVector vector_of(const Image& image) {
    PanelVector x(image.rgb.size() / 3 * 4, 0);
    for (std::size_t p = 0; p < image.rgb.size() / 3; ++p)
        for (std::size_t c = 0; c < 3; ++c) x[4 * p + c] = std::clamp(image.rgb[3 * p + c], 0.f, 1.f);
    return x;
}

Image image_of(const PanelVector& x, const Display& d) {
    Image image(int(d.panel.pixels[0]), int(d.panel.pixels[1]));
    for (std::size_t p = 0; p < image.rgb.size() / 3; ++p)
        for (std::size_t c = 0; c < 3; ++c) image.rgb[3 * p + c] = x[4 * p + c];
    return image;
}

/// Returns the picture that a fit begins with: content.inverse.start, or the prior's centre. Throws InputError for another size.
PanelVector start_of(const Request& request, const PanelVector& centre) {
    const std::string& file = request.keys().start;
    if (file.empty()) return centre;
    const Image image = read_image(file, request.display.panel.encoding);
    if (image.width != request.display.panel.pixels[0] || image.height != request.display.panel.pixels[1])
        throw InputError("content.inverse.start",
                         fmt::format("{} has {} x {} pixels, the panel {} x {}", file, image.width, image.height,
                                     request.display.panel.pixels[0], request.display.panel.pixels[1]));
    return vector_of(image);
}

/// Content that needs no fit, by the traced or the integrated pick-up.
struct SimpleContent {
    PickupKind pickup;
    Image image;
};

/// The centre x0 of the prior, what kind of content it is, and how near it comes to what held-out eyes should see.
struct Centre {
    PanelVector x;
    PickupKind content = PickupKind::inverse;
    Nearness held_out = {};
};

/// Returns the simple content, at the levels B and W, that is better for held-out eyes; the first if they compare none. Writes the
/// report's figures of each.
Centre centre_of(const std::vector<SimpleContent>& simple, const Exposure& exposure, const FittedViews& held_out,
                 InverseReport& report) {
    Centre best;
    for (const auto& [pickup, image] : simple) {
        PanelVector x = vector_of(image);
        for (float& light : x) light = float(exposure.black + (exposure.white - exposure.black) * double(light));
        const Nearness found = held_out.nearness(x);
        (pickup == PickupKind::traced ? report.held_out_traced : report.held_out_integrated) = found;
        if (best.x.empty() || found.psnr_db > best.held_out.psnr_db) best = {std::move(x), pickup, found};
    }
    return best;
}

/// Returns the centre where there is no simple content: M'VU t / bound, the mean of what the eyes should see of each pixel.
PanelVector mean_of_eyes(FittedViews& views, const Exposure& exposure, const PanelVector& bound) {
    PanelVector centre(bound.size(), float(exposure.black));
    PanelVector half;
    views.half_gradient(PanelVector(bound.size(), 0), half);
    for (std::size_t j = 0; j < bound.size(); ++j)
        if (bound[j] > 0) centre[j] = std::clamp(-half[j] / bound[j], 0.f, 1.f);
    return centre;
}

/// Returns whether the content has no light in any element that counts.
bool is_black(std::span<const View> views) {
    for (const View& view : views)
        for (std::size_t k = 0; k < view.content.rgb.size(); ++k)
            if (view.expected[k / 3] > 0 && view.content.rgb[k] > 0) return false;
    return true;
}

/// The result of solve().
struct Solved {
    PanelVector x;
    bool stopped = false;  // the job was cancelled
};

/// Takes steps from `start`, and returns the one that is best for held-out eyes, `start` included; without such eyes the last one.
/// Ends early where held-out eyes no longer gain. Writes the report's figure of held-out eyes.
Solved solve(const Request& request, FittedViews& views, const PanelVector& bound, const FittedViews* held_out,
             const PanelVector& start, const PanelVector& centre, InverseReport& report) {
    // The prior is relative to the mean of the bound, d_mean. A pixel has four numbers, three of which are unknowns.
    double mean = 0, met = 0;
    for (const float b : bound)
        if (b > 0) mean += double(b), ++met;
    if (!(met > 0)) throw no_light(request);
    report.unseen_percent = 100 * (1 - met / (double(bound.size()) * 0.75));
    BoxSolver solver(start, centre, bound, report.prior * mean / met);
    Solved best{start};
    if (held_out) report.held_out = held_out->nearness(start);
    PanelVector gradient;
    double waited_from = report.held_out.psnr_db;
    int waited = 0;
    const int steps = int(request.keys().iterations);
    const auto begun = std::chrono::steady_clock::now();
    for (int step = 1; step <= steps && !request.job.cancelled(); ++step) {
        const std::string so_far = held_out ? fmt::format(", held-out eyes {:.2f} dB", report.held_out.psnr_db) : "";
        const double left = seconds_since(begun) * (steps - step + 1) / std::max(step - 1, 1);
        request.job.stage(fmt::format("inverting, step {} of {}{}{}", step, steps, so_far,
                                      step > 1 ? fmt::format(", at most {:.0f} s left", std::ceil(left)) : ""),
                          1);
        views.half_gradient(solver.point(), gradient);
        if (request.job.cancelled()) break;
        solver.step(gradient);
        request.job.advance(1);
        report.iterations = step;
        if (!held_out) {
            best.x = solver.x();
            continue;
        }
        const Nearness now = held_out->nearness(solver.x());
        if (now.psnr_db > report.held_out.psnr_db) {
            best.x = solver.x();
            report.held_out = now;
        }
        if (++waited < patience) continue;
        if (report.held_out.psnr_db - waited_from < least_gain_db) break;
        waited_from = report.held_out.psnr_db;
        waited = 0;
    }
    best.stopped = request.job.cancelled();
    return best;
}

/// Fits the eyes' views, and compares the result at held-out eyes. The fit is pulled to and begins with the best of the simple
/// content; traced content is the result, not complete, if the job is cancelled before the first step.
InvertedPanel fit(const Request& request, std::span<const Eye> eyes, std::span<const Eye> held_out_eyes, const EyeCounts& counts,
                  std::int64_t rays, std::vector<SimpleContent> simple, InverseReport report) {
    const auto start = std::chrono::steady_clock::now();
    Job& job = request.job;
    const Inverse& keys = request.keys();
    const auto stopped = [&] {
        if (!simple.empty()) report.result = PickupKind::traced;
        return InvertedPanel{{simple.empty() ? Image(int(request.display.panel.pixels[0]), int(request.display.panel.pixels[1]))
                                             : std::move(simple.front().image),
                              false},
                             report};
    };
    // The views: what each eye should see and sees of a white panel, G, and the elements that count
    const double bytes = memory_for_rays(request, display_of(request, request.display, request.geometry, eyes.front(), rays));
    const Texels white = make_texels(pattern("white", request.display, request.geometry));
    const SummedPanel panel(white, request.threads);
    auto views = views_of(request, request.display, eyes, rays, white_points_for(request, counts, rays), content_samples, panel,
                          "photographs of the scene");
    if (!views) return stopped();
    auto others = views_of(request, request.shown, held_out_eyes, held_out_rays, white_points_for(request, counts, held_out_rays),
                           held_out_content_samples, panel, "held-out eyes");
    if (!others) return stopped();
    const Exposure exposure{keys.levels[0], keys.levels[1], gain_of(request, *views)};
    expect_light(*views, exposure.gain);
    expect_light(*others, exposure.gain);
    if (!keys.start.empty()) {
        if (const std::string colours = other_colours(keys.start, request.display.panel.encoding); !colours.empty())
            report.warnings.push_back(fmt::format("{}: {}", keys.start, colours));
        if (read_metadata(keys.start).contains(incomplete_mark))
            report.warnings.push_back(fmt::format("{}: is marked incomplete: the run that made it was interrupted", keys.start));
    }
    if (is_black(*views)) report.warnings.push_back("the content is black from these eyes: there is nothing to fit");
    const bool pixels = entries_are_pixels(request.display), codes = keys.weighting == ErrorOf::eye;
    FittedViews fitted(std::move(*views), pixels, codes, exposure, job), held_out(std::move(*others), pixels, codes, exposure, job);
    report.rays = fitted.rays();
    report.gain = exposure.gain;
    report.black = exposure.black;
    report.white = exposure.white;
    // Their rays, as far as there is memory; a quarter of it for held-out eyes, whose views are compared after each step
    job.stage("rays of the eyes", 1);
    const double left = bytes - held_out.keep_rows(bytes / 4);
    fitted.keep_rows(left);
    job.advance(1);
    const std::size_t size = std::size_t(request.display.panel.pixels[0]) * std::size_t(request.display.panel.pixels[1]) * 4;
    const PanelVector bound = fitted.bound(size);
    if (job.cancelled()) return stopped();
    if (request.boxes.size() == 2) report.crosstalk = fitted.crosstalk(std::size_t(report.places), size);
    const Centre centre =
        simple.empty() ? Centre{mean_of_eyes(fitted, exposure, bound)} : centre_of(simple, exposure, held_out, report);
    simple.clear();
    const bool scored = !std::isnan(centre.held_out.psnr_db);
    if (!held_out_eyes.empty() && !scored)
        report.warnings.push_back("held-out eyes see too little of the screen to be compared: the last step's panel is written");
    // The steps. Where simple content is better for held-out eyes, it is the result.
    Solved solved = solve(request, fitted, bound, scored ? &held_out : nullptr, start_of(request, centre.x), centre.x, report);
    if (scored && !(report.held_out.psnr_db > centre.held_out.psnr_db)) {
        solved.x = centre.x;
        report.held_out = centre.held_out;
        report.result = centre.content;
    }
    report.fitted = fitted.nearness(solved.x, std::size_t(report.places), std::size_t(report.places + 7) / 8);
    report.seconds = seconds_since(start);
    InvertedPanel made{{image_of(solved.x, request.display), !solved.stopped, report.rays, 0, report.seconds}, {}};
    double black = 0, full = 0;
    for (const float x : made.picture.image.rgb) black += x <= 0, full += x >= 1;
    report.at_black_percent = 100 * black / double(made.picture.image.rgb.size());
    report.at_white_percent = 100 * full / double(made.picture.image.rgb.size());
    made.report = std::move(report);
    return made;
}

/// Returns the report before the fit: the numbers of eyes and rays, and the pull to the prior, careful where there are few rays.
InverseReport planned(const Request& request, std::int64_t places, std::int64_t rays, const EyeCounts& counts) {
    InverseReport report;
    report.boxes = request.boxes;
    report.places = places;
    report.rays_per_element = rays;
    report.rows_per_unknown = counts.rows / counts.pixels;
    report.rays_per_unknown = counts.lit * double(rays) / counts.pixels;
    const bool few = are_few_rays(report.rows_per_unknown, report.rays_per_unknown);
    if (few) report.warnings.push_back(warning_of_few_rays(request, places, report.rows_per_unknown, report.rays_per_unknown));
    report.prior = request.keys().prior.value_or(few ? careful_prior : usual_prior);
    return report;
}

/// The display that content is made for: without errors, unless content is made for the display as built.
struct Meant {
    bool errors_unknown;
    Display display;
    Geometry geometry;
    Meant(const Display& d, const Geometry& g)
        : errors_unknown(knows_no_errors(d)),
          display(errors_unknown ? without_errors(d) : d),
          geometry(errors_unknown ? resolve(display) : g) {}
    Display by(PickupKind pickup) const {
        Display other = display;
        other.content.pickup = pickup;
        return other;
    }
};

/// Plans eyes and rays, fits them, and adds warnings to the report. `content_by` returns the content by another pick-up, which the
/// fit is compared with.
InvertedPanel fit_boxes(const Request& request, bool errors_unknown, const std::function<Picture(PickupKind)>& content_by) {
    std::vector<SimpleContent> simple;
    const auto stopped = [&] {
        InvertedPanel traced{{std::move(simple.front().image), false}, {}};
        traced.report.result = PickupKind::traced;
        return traced;
    };
    for (const PickupKind pickup : {PickupKind::traced, PickupKind::integrated}) {
        Picture made = content_by(pickup);
        simple.push_back({pickup, std::move(made.image)});
        if (!made.complete) return stopped();
    }
    return on_threads(request.threads, [&] {
        const Inverse& keys = request.keys();
        const Plan p = plan(request);
        if (request.job.cancelled()) return stopped();
        InverseReport report = planned(request, p.in_boxes, p.rays, p.counts);
        report.rim_places = std::int64_t(p.eyes.size()) - p.in_boxes;
        if (const double views = views_within(request.boxes, request.display, request.geometry);
            request.boxes.size() == 1 && views > 0 && views < 2)
            report.warnings.push_back(fmt::format(
                "the eyes' box is only {:.2g} views wide: all its eyes see nearly the same; give a wider one (--eyes-mm)", views));
        if (errors_unknown) report.warnings.emplace_back(warning_of_errors);
        // Held-out eyes continue the places in the boxes, with numbers, and so with shifts and rays, that no other eye has.
        const std::vector<Eye> held_out = eyes_at(places_within(request.boxes, p.in_boxes, keys.held_out), 2'000'000);
        InvertedPanel made = fit(request, p.eyes, held_out, p.counts, p.rays, std::move(simple), std::move(report));
        if (made.report.result != PickupKind::inverse && made.report.iterations > 0)
            made.report.warnings.push_back(fmt::format(
                "{} content is better for eyes that were not fitted, and is written: there are too few places or rays, or the "
                "display cannot show more",
                words<PickupKind>()[std::size_t(made.report.result)]));
        return made;
    });
}

}  // namespace

InvertedPanel invert(const Display& display, const Geometry& geometry, const ContentScene& scene, std::span<const EyeBox> boxes,
                     int threads, Job& job) {
    require_memory_for_panel(display);
    const Meant made(display, geometry);
    const Request request{made.display,
                          made.geometry,
                          display,
                          scene.centre_mm()[2],
                          photographs_of(scene, threads),
                          {boxes.begin(), boxes.end()},
                          threads,
                          job};
    return fit_boxes(request, made.errors_unknown,
                     [&](PickupKind pickup) { return elemental_images(made.by(pickup), made.geometry, scene, threads, job); });
}

InvertedPanel invert(const Display& display, const Geometry& geometry, const LightField& field, std::span<const EyeBox> boxes,
                     int threads, Job& job) {
    require_memory_for_panel(display);
    const Meant made(display, geometry);
    const double focus_z = made.geometry.vertex_plane_mm + field.grid().depth_mm;
    FieldRays rays;
    const Request request{made.display,
                          made.geometry,
                          display,
                          focus_z,
                          pictures_of(field, focus_z, boxes, rays),
                          {boxes.begin(), boxes.end()},
                          threads,
                          job};
    const auto require_views = [&] {
        if (!job.cancelled() && rays.all > 0 && rays.unseen == rays.all)
            throw InputError("content.inverse.eyes_mm",
                             "all rays from these eyes pass beside the views' cameras; give eyes that the cameras surround "
                             "(--eyes-mm), or more views");
    };
    InvertedPanel panel;
    try {
        panel = fit_boxes(request, made.errors_unknown, [&](PickupKind pickup) {
            return elemental_images(made.by(pickup), made.geometry, field, threads, job).picture;
        });
    } catch (const InputError&) {
        require_views();  // without any there is nothing that the display could show
        throw;
    }
    require_views();
    if (const double share = double(rays.unseen) / double(std::max<std::int64_t>(rays.all, 1)); share > 0.01)
        panel.report.warnings.push_back(
            fmt::format("{:.0f} % of the rays from these eyes pass beside the views' cameras and do not count: give "
                        "eyes that the cameras surround (--eyes-mm), or more views",
                        100 * share));
    return panel;
}

InvertedPanel invert(const Display& display, const Geometry& as_shown, const EyePictures& wanted, int threads, Job& job) {
    if (wanted.eyes_mm.empty() || wanted.eyes_mm.size() != wanted.pictures.size())
        throw InputError("targets", fmt::format("{} pictures for {} eyes; give one for each eye", wanted.pictures.size(),
                                                wanted.eyes_mm.size()));
    const auto [columns, rows] = display.camera.resolution;
    for (std::size_t k = 0; k < wanted.pictures.size(); ++k) {
        const Image& picture = wanted.pictures[k];
        const double wider = double(picture.width) * double(rows) / (double(picture.height) * double(columns));
        if (std::abs(wider - 1) > std::max(0.02, 1. / std::min(picture.width, picture.height)))
            throw InputError(fmt::format("targets[{}]", k),
                             fmt::format("has {} x {} pixels; give the proportions of the camera's picture, {} x {}", picture.width,
                                         picture.height, columns, rows));
        if (const auto least = std::ranges::min_element(picture.rgb); *least < 0)
            throw InputError(fmt::format("targets[{}]", k), fmt::format("has the light {}; there is none below 0", *least));
    }
    require_memory_for_panel(display);
    const Meant made(display, as_shown);
    const Request request{made.display, made.geometry, display, made.geometry.vertex_plane_mm + made.geometry.content_depth_mm, {},
                          {},           threads,       job};
    return on_threads(threads, [&] {
        std::vector<Eye> eyes;
        for (std::size_t k = 0; k < wanted.eyes_mm.size(); ++k)
            eyes.push_back({.place = wanted.eyes_mm[k], .number = std::int64_t(k), .picture = &wanted.pictures[k]});
        const EyeCounts counts = count(request, eyes);
        if (job.cancelled()) return InvertedPanel{{Image(int(display.panel.pixels[0]), int(display.panel.pixels[1])), false}, {}};
        const std::int64_t rays = request.keys().rays.value_or(rays_for(counts));
        InverseReport report = planned(request, std::int64_t(eyes.size()), rays, counts);
        if (made.errors_unknown) report.warnings.emplace_back(warning_of_errors);
        return fit(request, eyes, {}, counts, rays, {}, std::move(report));
    });
}

}  // namespace lfdsim
