#include "inverse/inverse.h"

#include "base/input_error.h"
#include "engine/devices/memory.h"
#include "engine/render.h"
#include "geometry/lens_misalignment.h"
#include "image/formats/image_file.h"
#include "inverse/box_solver.h"
#include "inverse/fitted_views.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <random>

namespace lfdsim {
namespace {

constexpr double seen_share = 0.6;    // of the gain: an element that sees less of a white panel is at the border, or between lenses
constexpr double dim_share = 0.3;     // of the brightest: an element that sees less does not count for the gain
constexpr double rim_weight = 0.25;   // of eyes around the boxes
constexpr double usual_prior = 0.001, careful_prior = 0.3;
constexpr double rows_wanted = 4, rays_wanted = 160;  // for each panel pixel met
constexpr double fewest_rows = 2, fewest_rays = 20;  // below this the fit follows noise
constexpr std::int64_t rays_to_count = 4;            // of an element, to see how many pixels are met
constexpr std::int64_t content_samples = 16, held_out_content_samples = 64, held_out_rays = 512;
constexpr int patience = 5;            // steps in which held-out eyes must gain ...
constexpr double least_gain_db = 0.01;  // ... so much

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// What was asked for, with what it is of.
struct Request {
    const Display& display;  // that content is made for
    const Geometry& geometry;
    const Display& shown;  // as described, which held-out eyes see
    double content_z_mm;
    ContentOf content_of;
    std::vector<EyeBox> boxes;
    int threads;
    Job& job;
    const Inverse& keys() const { return display.content.inverse; }
};

/// A number of a grid's shift, uniform in [0, 1): the same for each seed and place.
std::pair<double, double> shift_of(const Request& request, std::int64_t place) {
    std::mt19937_64 random(std::uint64_t(request.display.render.seed) * 1000003 + std::uint64_t(place));
    const auto next = [&] { return double(random() >> 11) * 0x1p-53; };
    const double x = next();
    return {x, next()};
}

Texels white_texels(const Display& d) {
    Texels texels(d.panel.pixels[0], d.panel.pixels[1]);
    for (std::int64_t row = 0; row < texels.rows(); ++row)
        for (std::int64_t k = 0; k < texels.columns(); ++k)
            for (int c = 0; c < 3; ++c) texels.row(row)[4 * k + c] = 1;
    return texels;
}

float mean_of(const Image& image, std::size_t p) { return (image.rgb[3 * p] + image.rgb[3 * p + 1] + image.rgb[3 * p + 2]) / 3; }

/// Elements of a picture that are marked, without those next to one that is not, so many times.
std::vector<std::uint8_t> without_border(std::vector<std::uint8_t> marked, int width, int height, int times) {
    for (int t = 0; t < times; ++t) {
        const std::vector<std::uint8_t> before = marked;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                for (int dy = -1; dy <= 1; ++dy)
                    for (int dx = -1; dx <= 1; ++dx) {
                        const int i = x + dx, j = y + dy;
                        if (i < 0 || j < 0 || i >= width || j >= height || !before[std::size_t(j) * std::size_t(width) + std::size_t(i)])
                            marked[std::size_t(y) * std::size_t(width) + std::size_t(x)] = 0;
                    }
    }
    return marked;
}

/// Cancellation alone: pictures of eyes have stages of their own.
class Stages : public Job {
  public:
    explicit Stages(const Job& whole) : whole_(whole) {}
    bool cancelled() const override { return whole_.cancelled(); }

  private:
    const Job& whole_;
};

/// An eye, and what a view of it is made of.
struct Eye {
    Vec3d place;
    std::int64_t number;  // decides its grid's shift
    float weight;
    const Image* picture = nullptr;  // what it should see, where that is given
};

Display display_of(const Request& request, const Display& display, const Geometry& geometry, const Eye& eye, std::int64_t rays) {
    const auto [x, y] = shift_of(request, eye.number);
    Display seen = eye.picture ? seen_by_camera_at(display, geometry, eye.place, {eye.picture->width, eye.picture->height})
                               : seen_by_eye(display, geometry, eye.place, request.content_z_mm, x, y);
    seen.render.samples = rays;
    // Rays of their own for each eye: what a fit makes of one eye's noise is then noise for the next.
    seen.render.seed = std::int64_t((std::uint64_t(display.render.seed) + 0x9e3779b97f4a7c15u * std::uint64_t(eye.number)) >> 1);
    return seen;
}

/// The views of eyes as a display shows them. Nothing if the job is cancelled.
std::optional<std::vector<View>> views_of(const Request& request, const Display& display, std::span<const Eye> eyes, std::int64_t rays,
                                          std::int64_t samples, const SummedPanel& white, const char* stage) {
    const Geometry geometry = resolve(display);
    request.job.stage(stage, std::int64_t(eyes.size()));
    std::vector<std::optional<View>> made(eyes.size());
    Stages quiet(request.job);
    tbb::parallel_for(std::size_t(0), eyes.size(), [&](std::size_t k) {
        if (request.job.cancelled()) return;
        const Eye& eye = eyes[k];
        const Display seen = display_of(request, display, geometry, eye, rays);
        const Geometry there = resolve(seen);
        Image content = eye.picture ? *eye.picture : request.content_of(seen, there, samples, 1, quiet);
        Display filtered = seen;
        filtered.render.estimator = Estimator::filtered;
        filtered.render.samples.reset();
        RenderOptions options;
        options.threads = 1;  // eyes are shared by the threads
        options.device = "cpu";
        Rendering bright = render(filtered, there, white, options, quiet);
        if (request.job.cancelled()) return;
        made[k] = View{ViewRows(seen, there), eye.weight, std::move(content), std::move(bright.image), {}};
        request.job.advance(1);
    });
    std::vector<View> views;
    for (std::optional<View>& view : made) {
        if (!view) return {};
        views.push_back(std::move(*view));
    }
    return views;
}

/// The median light of a white panel over the elements that are not dim, of eyes in the boxes.
double gain_of(std::span<const View> views) {
    std::vector<float> light;
    for (const View& view : views)
        if (view.weight == 1)
            for (std::size_t p = 0; p < view.white.rgb.size() / 3; ++p) light.push_back(mean_of(view.white, p));
    const float brightest = light.empty() ? 0 : *std::max_element(light.begin(), light.end());
    std::erase_if(light, [&](float x) { return !(x >= float(dim_share) * brightest) || !(x > 0); });
    if (light.empty()) throw InputError("content.inverse.eyes_mm", "no ray from these eyes ends on the panel");
    const auto middle = light.begin() + std::ptrdiff_t(light.size() / 2);
    std::nth_element(light.begin(), middle, light.end());
    return *middle;
}

void count_elements(std::vector<View>& views, double gain, int border) {
    for (View& view : views) {
        std::vector<std::uint8_t> bright(view.white.rgb.size() / 3);
        for (std::size_t p = 0; p < bright.size(); ++p) bright[p] = mean_of(view.white, p) > float(seen_share * gain);
        view.counted = without_border(std::move(bright), view.white.width, view.white.height, border);
    }
}

/// How many panel pixels the eyes meet, elements that see light, and rays with light.
struct Counts {
    double pixels = 0, rows = 0, lit = 0;
};

Counts count(const Request& request, std::span<const Eye> eyes) {
    const auto [columns, rows] = request.display.panel.pixels;
    std::vector<std::uint8_t> met(std::size_t(columns) * std::size_t(rows), 0);
    std::vector<Counts> each(eyes.size());
    tbb::parallel_for(std::size_t(0), eyes.size(), [&](std::size_t k) {
        Counts& counts = each[k];
        const Display seen = display_of(request, request.display, request.geometry, eyes[k], rays_to_count);
        const PanelRays rays(seen, resolve(seen));
        std::vector<PanelRay> found;
        rays.trace({0, 0, int(seen.camera.resolution[0]), int(seen.camera.resolution[1])}, found);
        const bool subpixels = seen.panel.subpixels != SubpixelLayout::none || seen.panel.aperture_ratio < 1;
        const auto samples = std::size_t(rays.samples());
        for (std::size_t p = 0; p < found.size(); p += samples) {
            bool lit = false;
            for (std::size_t s = p; s < p + samples; ++s)
                if (found[s].share > 0) {
                    std::atomic_ref(met[subpixels ? found[s].place >> 2 : found[s].place]).store(1, std::memory_order_relaxed);
                    counts.lit += 1 / double(samples);  // for one ray an element
                    lit = true;
                }
            counts.rows += lit;
        }
    });
    Counts counts;
    for (const Counts& one : each) counts = {0, counts.rows + one.rows, counts.lit + one.lit};
    counts.pixels = double(std::count(met.begin(), met.end(), 1));
    return counts;
}

std::vector<Eye> eyes_at(std::span<const Vec3d> places, std::int64_t first, float weight) {
    std::vector<Eye> eyes;
    for (const Vec3d& place : places) eyes.push_back({place, first + std::int64_t(eyes.size()), weight});
    return eyes;
}

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

Nearness mean_nearness(const FittedViews& views, const PanelVector& x, std::size_t most) {
    Nearness mean;
    double eyes = 0;
    const std::size_t step = (views.views().size() + most - 1) / std::max<std::size_t>(most, 1);
    for (std::size_t k = 0; k < views.views().size(); k += std::max<std::size_t>(step, 1)) {
        const Nearness one = views.nearness(k, x);
        if (std::isnan(one.psnr_db) || std::isnan(one.ssim)) continue;
        mean = {mean.psnr_db + one.psnr_db, mean.ssim + one.ssim};
        ++eyes;
    }
    const double nan = std::numeric_limits<double>::quiet_NaN();
    return eyes > 0 ? Nearness{mean.psnr_db / eyes, mean.ssim / eyes} : Nearness{nan, nan};
}

/// The picture that a fit begins with.
PanelVector start_of(const Request& request, const PanelVector& traced) {
    const std::string& file = request.keys().start;
    if (file.empty()) return traced;
    const Image image = read_image(file, request.display.panel.encoding);
    if (image.width != request.display.panel.pixels[0] || image.height != request.display.panel.pixels[1])
        throw InputError("content.inverse.start", fmt::format("{} has {} x {} pixels, the panel {} x {}", file, image.width, image.height,
                                                              request.display.panel.pixels[0], request.display.panel.pixels[1]));
    return vector_of(image);
}

/// Steps from `start`, those of the best held-out eyes; without them the last.
struct Solved {
    PanelVector x;
    int steps = 0;
    bool stopped = false, at_start = true;
};

Solved solve(const Request& request, FittedViews& views, const PanelVector& bound, const FittedViews* held_out, const PanelVector& start,
             const PanelVector& centre, InverseReport& report) {
    double mean = 0, met = 0;
    for (const float b : bound)
        if (b > 0) mean += double(b), ++met;
    if (!(met > 0)) throw InputError("content.inverse.eyes_mm", "no ray from these eyes ends on the panel");
    report.unseen_percent = 100 * (1 - met / (double(bound.size()) * 0.75));
    BoxSolver solver(start, centre, bound, report.prior * mean / met);
    Solved best{start};
    report.held_out_traced = held_out ? mean_nearness(*held_out, centre, 1000) : Nearness{};
    report.held_out = held_out ? mean_nearness(*held_out, start, 1000) : Nearness{};
    PanelVector gradient;
    double waited_from = report.held_out.psnr_db;
    int waited = 0;
    const int steps = int(request.keys().iterations);
    for (int step = 1; step <= steps && !request.job.cancelled(); ++step) {
        const std::string so_far = held_out ? fmt::format(", held-out eyes {:.2f} dB", report.held_out.psnr_db) : "";
        request.job.stage(fmt::format("inverting, step {} of {}{}", step, steps, so_far), 1);
        views.half_gradient(solver.point(), gradient);
        solver.step(gradient);
        request.job.advance(1);
        report.iterations = step;
        if (!held_out) {
            best = {solver.x(), step, false, false};
            continue;
        }
        const Nearness now = mean_nearness(*held_out, solver.x(), 1000);
        if (now.psnr_db > report.held_out.psnr_db) {
            best = {solver.x(), step, false, false};
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

template <class Do>
auto on_threads(int threads, const Do& do_it) {
    const int workers = threads > 0 ? threads : tbb::info::default_concurrency();
    const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism,
                                      std::size_t(std::max(workers, tbb::info::default_concurrency())));
    tbb::task_arena arena(workers);
    return arena.execute(do_it);
}

/// Bytes of rays that may be kept. Throws InputError if there is no room for the unknowns, or for one view.
double memory_for_rays(const Request& request, const Display& seen) {
    const Inverse& keys = request.keys();
    const double unknowns = 10 * texel_bytes(request.display);  // seven arrays of them, and integers of twice the size
    require_memory("panel.pixels", "the inverse pick-up's arrays of the panel", unknowns);
    const double view = double(seen.camera.resolution[0]) * double(seen.camera.resolution[1]) * double(*seen.render.samples) * sizeof(PanelRay);
    const double bytes = keys.memory_mb ? *keys.memory_mb * 1e6 : std::max(free_bytes() - unknowns, 0.) / 2;
    if (bytes < view)
        throw InputError("content.inverse.memory_mb", fmt::format("{:.0f} MB is less than the rays of one view take; give {:.0f} or more",
                                                                  bytes / 1e6, std::ceil(view / 1e6)));
    if (keys.memory_mb) require_memory("content.inverse.memory_mb", "rays that are kept", bytes);
    return bytes;
}

/// The places and the rays of an element, from the boxes and what their eyes meet.
struct Plan {
    std::vector<Eye> eyes;
    std::int64_t in_boxes, rays;
    Counts counts;  // of all eyes together, with one ray an element
};

Plan plan(const Request& request) {
    const Inverse& keys = request.keys();
    const double rim = keys.rim.value_or(is_strips(request.display.array) ? 0 : 2);
    const auto eyes_for = [&](std::int64_t places) {
        std::vector<Eye> eyes = eyes_at(places_within(request.boxes, 0, places), 0, 1);
        const std::vector<Vec3d> around = places_around(request.boxes, request.display, request.geometry, rim, places);
        for (const Eye& eye : eyes_at(around, 1'000'000, float(rim_weight))) eyes.push_back(eye);
        return eyes;
    };
    Plan p{};
    p.in_boxes = keys.places.value_or(views_within(request.boxes, request.display, request.geometry));
    for (int attempt = 0;; ++attempt) {
        const Counts inside = count(request, eyes_at(places_within(request.boxes, 0, p.in_boxes), 0, 1));
        if (!(inside.pixels > 0)) throw InputError("content.inverse.eyes_mm", "no ray from these eyes ends on the panel");
        const double ratio = inside.rows / inside.pixels;
        const bool fixed = keys.places || p.in_boxes == 1;
        if (fixed || ratio >= rows_wanted || attempt == 4) break;
        p.in_boxes = std::int64_t(std::ceil(double(p.in_boxes) * std::max(1.05 * rows_wanted / ratio, 1.02)));
    }
    p.eyes = eyes_for(p.in_boxes);
    p.counts = count(request, p.eyes);
    const double needed = rays_wanted * p.counts.pixels / p.counts.lit;
    p.rays = keys.rays.value_or(4 * std::clamp<std::int64_t>(std::int64_t(std::ceil(needed / 4)), 1, 1024));
    return p;
}

/// Fits the eyes' views; `traced`: the picture to which the fit is pulled and with which it begins, if there is one.
InvertedPanel fit(const Request& request, std::span<const Eye> eyes, std::span<const Eye> held_out_eyes, std::int64_t rays,
                  const std::optional<Picture>& traced, InverseReport report) {
    const auto start = Clock::now();
    Job& job = request.job;
    const Inverse& keys = request.keys();
    const auto stopped = [&] {
        InvertedPanel none{traced.value_or(Picture{Image(int(request.display.panel.pixels[0]), int(request.display.panel.pixels[1]))}), report};
        none.picture.complete = false;
        return none;
    };
    const double bytes = memory_for_rays(request, display_of(request, request.display, request.geometry, eyes.front(), rays));
    const Texels white = white_texels(request.display);
    const SummedPanel panel(white, request.threads);
    auto views = views_of(request, request.display, eyes, rays, content_samples, panel, "photographs of the scene");
    if (!views) return stopped();
    auto others = views_of(request, request.shown, held_out_eyes, held_out_rays, held_out_content_samples, panel, "held-out eyes");
    if (!others) return stopped();
    const Exposure exposure{keys.levels[0], keys.levels[1], gain_of(*views)};
    count_elements(*views, exposure.gain, 1);
    count_elements(*others, exposure.gain, 2);
    const bool pixels = entries_are_pixels(request.display), codes = keys.weighting == ErrorOf::eye;
    FittedViews fitted(std::move(*views), pixels, codes, exposure), held_out(std::move(*others), pixels, codes, exposure);
    report.rays = fitted.rays();
    report.gain = exposure.gain;
    report.black = exposure.black;
    report.white = exposure.white;
    job.stage("rays of the eyes", 1);
    const double left = bytes - held_out.keep_rows(bytes / 4, job);
    fitted.keep_rows(left, job);
    job.advance(1);
    const std::size_t size = std::size_t(request.display.panel.pixels[0]) * std::size_t(request.display.panel.pixels[1]) * 4;
    const PanelVector bound = fitted.bound(size);
    // The content's levels over the panel's light; without content the mean of what the eyes should see of each pixel.
    PanelVector centre(size, float(exposure.black));
    if (traced) {
        centre = vector_of(traced->image);
        for (float& x : centre) x = float(exposure.black + (exposure.white - exposure.black) * double(x));
    } else {
        PanelVector half;
        fitted.half_gradient(PanelVector(size, 0), half);
        for (std::size_t j = 0; j < size; ++j)
            if (bound[j] > 0) centre[j] = std::clamp(-half[j] / bound[j], 0.f, 1.f);
    }
    const bool scored = !held_out_eyes.empty();
    Solved solved = solve(request, fitted, bound, scored ? &held_out : nullptr, start_of(request, centre), centre, report);
    if (scored && !(report.held_out.psnr_db > report.held_out_traced.psnr_db)) {
        solved.x = centre;
        report.held_out = report.held_out_traced;
        report.traced = !solved.stopped || report.iterations > 0;
    }
    report.fitted = mean_nearness(fitted, solved.x, 8);
    report.seconds = seconds_since(start);
    report.rays_per_second = report.seconds > 0 ? double(report.rays) * std::max(report.iterations, 1) / report.seconds : 0;
    InvertedPanel made{{image_of(solved.x, request.display), !solved.stopped, report.rays, 0, report.seconds}, {}};
    double black = 0, full = 0;
    for (const float x : made.picture.image.rgb) black += x <= 0, full += x >= 1;
    report.at_black_percent = 100 * black / double(made.picture.image.rgb.size());
    report.at_white_percent = 100 * full / double(made.picture.image.rgb.size());
    made.report = std::move(report);
    return made;
}

void warn_of_few_rays(InverseReport& report, const Inverse& keys, double rows, double rays) {
    if (rows >= fewest_rows && rays >= fewest_rays) return;
    report.warnings.push_back(fmt::format(
        "the eyes' views have {:.2g} elements and {:.2g} rays with light for each panel pixel that they meet; below {} and {} the fit follows noise{}. "
        "Give content.inverse.places = {:.0f} or more, and no rays",
        rows, rays, fewest_rows, fewest_rays, keys.prior ? "" : fmt::format(", and is pulled to traced content (prior {})", careful_prior),
        std::ceil(double(report.places) * std::max(rows_wanted / rows, 1.))));
}

}  // namespace

ContentOf photographs_of(const ContentScene& scene) {
    return [scene](const Display& seen, const Geometry& geometry, std::int64_t samples, int threads, Job& job) {
        Display camera = seen;
        camera.render.samples = samples;
        return reference_photograph(camera, geometry, scene, threads, {}, job).image;
    };
}

InvertedPanel invert(const Display& display, const Geometry& as_shown, const ContentScene& scene, std::span<const EyeBox> boxes,
                     int threads, Job& job) {
    const bool unknown_errors = knows_no_errors(display);
    const Display meant = unknown_errors ? without_errors(display) : display;
    const Geometry geometry = unknown_errors ? resolve(meant) : as_shown;
    const Request request{meant, geometry, display, scene.centre_mm()[2], photographs_of(scene), {boxes.begin(), boxes.end()}, threads, job};
    Display by_traced = meant;
    by_traced.content.pickup = PickupKind::traced;
    const Picture traced = elemental_images(by_traced, geometry, scene, threads, job);
    if (!traced.complete) return {traced, {}};
    return on_threads(threads, [&] {
        const Inverse& keys = request.keys();
        const Plan p = plan(request);
        InverseReport report;
        report.places = p.in_boxes;
        report.rim_places = std::int64_t(p.eyes.size()) - p.in_boxes;
        report.rays_per_element = p.rays;
        report.rows_per_unknown = p.counts.rows / p.counts.pixels;
        report.rays_per_unknown = p.counts.lit * double(p.rays) / p.counts.pixels;
        const bool few = report.rows_per_unknown < fewest_rows || report.rays_per_unknown < fewest_rays;
        report.prior = keys.prior.value_or(few ? careful_prior : usual_prior);
        warn_of_few_rays(report, keys, report.rows_per_unknown, report.rays_per_unknown);
        if (unknown_errors)
            report.warnings.push_back(
                "the panel is made for the display as described, and shown by one with assembly errors: content.made_for = \"built\" makes "
                "it for that one");
        const std::vector<Eye> held_out = eyes_at(places_within(request.boxes, p.in_boxes, keys.held_out), 2'000'000, 1);
        InvertedPanel made = fit(request, p.eyes, held_out, p.rays, traced, std::move(report));
        if (made.report.traced)
            made.report.warnings.push_back("traced content serves eyes that were not fitted better, and is written: there are too few places or "
                                           "rays, or the display cannot show more");
        return made;
    });
}

InvertedPanel invert(const Display& display, const Geometry& as_shown, const EyePictures& wanted, int threads, Job& job) {
    if (wanted.eyes_mm.empty() || wanted.eyes_mm.size() != wanted.pictures.size())
        throw InputError("targets", fmt::format("{} pictures for {} eyes; give one for each eye", wanted.pictures.size(), wanted.eyes_mm.size()));
    const bool unknown_errors = knows_no_errors(display);
    const Display meant = unknown_errors ? without_errors(display) : display;
    const Geometry geometry = unknown_errors ? resolve(meant) : as_shown;
    const Request request{meant, geometry, display, geometry.vertex_plane_mm + geometry.content_depth_mm, {}, {}, threads, job};
    return on_threads(threads, [&] {
        std::vector<Eye> eyes;
        for (std::size_t k = 0; k < wanted.eyes_mm.size(); ++k)
            eyes.push_back({wanted.eyes_mm[k], std::int64_t(k), 1, &wanted.pictures[k]});
        const Counts counts = count(request, eyes);
        if (!(counts.pixels > 0)) throw InputError("target_eyes_mm", "no ray from these eyes ends on the panel");
        InverseReport report;
        report.places = std::int64_t(eyes.size());
        const double needed = rays_wanted * counts.pixels / counts.lit;
        report.rays_per_element =
            request.keys().rays.value_or(4 * std::clamp<std::int64_t>(std::int64_t(std::ceil(needed / 4)), 1, 1024));
        report.rows_per_unknown = counts.rows / counts.pixels;
        report.rays_per_unknown = counts.lit * double(report.rays_per_element) / counts.pixels;
        report.prior = request.keys().prior.value_or(usual_prior);
        return fit(request, eyes, {}, report.rays_per_element, {}, report);
    });
}

}  // namespace lfdsim
