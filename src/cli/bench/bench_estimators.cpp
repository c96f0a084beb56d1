#include "base/constants.h"
#include "base/seconds.h"
#include "cli/bench/bench.h"
#include "cli/bench/bench_cases.h"
#include "cli/options/panel_source.h"
#include "cli/program/arguments.h"
#include "engine/devices/memory.h"
#include "engine/estimator/panel_planes.h"
#include "engine/render.h"
#include "files/description/display_file.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

// Group "estimators": error against time. A part of the picture is rendered with many samples of other seeds, which is the
// reference, then by each way of sampling with more and more samples. A user waits for an error, so the ways are compared by the
// time that each takes to reach the same one (docs/performance.md, "Measuring by hand").
namespace lfdsim::cli {
namespace {

/// A way of sampling. A new one needs one more line in `estimators`, and nothing else.
struct Contender {
    const char* name;
    void (*choose)(Display&);
};
constexpr Contender estimators[] = {
    {"point, sobol", [](Display& d) { d.render.estimator = Estimator::point, d.render.sampling = Sampling::sobol; }},
    {"point, random", [](Display& d) { d.render.estimator = Estimator::point, d.render.sampling = Sampling::random; }},
    {"filtered", [](Display& d) { d.render.estimator = Estimator::filtered; }},
};
constexpr const Contender &brute_force = estimators[0], &papers = estimators[1];

constexpr std::int64_t papers_samples = 100;
constexpr std::int64_t sample_counts[] = {1, 4, 9, 16, 36, 64, papers_samples, 256, 1024};
constexpr std::int64_t reference_samples = 16384;  // a pixel, in each of two halves; their difference gives the error of their mean

/// The error of a picture.
struct Error {
    double rmse, brightness;  // rmse: in linear light; brightness: mean light over the reference's, less 1
};
Error error_of(const Image& a, const Image& truth) {
    double squares = 0, sum = 0, wanted = 0;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) {
        const double d = double(a.rgb[i]) - truth.rgb[i];
        squares += d * d;
        sum += a.rgb[i];
        wanted += truth.rgb[i];
    }
    return {std::sqrt(squares / double(a.rgb.size())), sum / wanted - 1};
}

/// The error and the time of a way of sampling with a number of samples a pixel.
struct Spent {
    const Contender* estimator;
    std::int64_t samples;
    Error error;
    Timing time;
};

/// A median of a timing's runs.
using Clock = double (Timing::*)() const;
/// A comparison of times by one clock: its key in JSON and its name in the table.
struct Ratio {
    const char *key, *name;
    Clock clock;
};
constexpr Ratio printed_ratios[] = {{"time_to_papers_error_over_papers", "time", &Timing::median},
                                    {"processor_time_to_papers_error_over_papers", "processor time", &Timing::processor_median}};

/// The shortest time that the estimator was measured to take to an RMSE of `rmse` or less; none if no measured number of samples
/// reaches it.
std::optional<double> seconds_to(double rmse, const Contender& estimator, const std::vector<Spent>& points, Clock clock) {
    std::optional<double> least;
    for (const Spent& p : points) {
        if (p.estimator != &estimator || p.error.rmse > rmse) continue;
        const double seconds = (p.time.*clock)();
        least = least ? std::min(*least, seconds) : seconds;
    }
    return least;
}

/// A display with the content that its panel shows, and the part of the frame that is compared.
struct BenchView {
    Display display;
    std::string content;
    Texels panel;
    Rect crop;
    SummedPanel summed{panel};  // is made once, as for several views

    std::string name() const {
        return fmt::format("{}, {}, crop {},{},{},{}", display.name, content, crop.x0, crop.y0, crop.x1, crop.y1);
    }
    Rendering rendered(const Bench& bench, const Contender& how, std::int64_t samples, std::int64_t seed, Job& job) const {
        Display d = display;
        how.choose(d);
        d.render.samples = samples;
        d.render.seed = seed;
        return render(d, resolve(d), summed, {bench.settings.threads, bench.settings.kernel, crop}, job);
    }
};

/// The picture that others are compared with.
struct Reference {
    Image image;
    std::int64_t samples;  // traced for each pixel
    double rmse;           // estimate of the error of `image`
};

/// The mean of two halves a, b of different seeds; none after a signal. If the error of each half is s, the RMS of a - b is sqrt(2)
/// s and the error of their mean s / sqrt(2), half of it.
std::optional<Reference> reference_of(const BenchView& view, Bench& bench) {
    const Rendering a = view.rendered(bench, brute_force, reference_samples, view.display.render.seed + 1, bench.job()),
                    b = view.rendered(bench, brute_force, reference_samples, view.display.render.seed + 2, bench.job());
    if (!a.complete || !b.complete) return {};
    Reference r{a.image, 0, error_of(a.image, b.image).rmse / 2};
    for (std::size_t i = 0; i < r.image.rgb.size(); ++i) r.image.rgb[i] = (a.image.rgb[i] + b.image.rgb[i]) / 2;
    r.samples = (a.samples + b.samples) / (std::int64_t(a.image.width) * a.image.height);
    return r;
}

// Times every way of sampling with every number of samples. Seconds are those of the whole call, so that an estimator's preparation
// counts, except for the panel's tables: these are made before, since all views share them.
std::vector<Spent> points_of(const BenchView& view, const Image& truth, Bench& bench) {
    std::vector<Spent> points;
    for (const Contender& e : estimators) {
        Display d = view.display;
        e.choose(d);
        planes_of(view.summed, panel_reading(d));
        for (const std::int64_t samples : sample_counts) points.push_back({&e, samples, {}, {}});
    }
    std::vector<Case> cases;
    for (Spent& p : points)
        cases.push_back({fmt::format("{}, {} samples", p.estimator->name, p.samples), [&](Job& job) {
                             const auto start = std::chrono::steady_clock::now();
                             const Rendering r = view.rendered(bench, *p.estimator, p.samples, view.display.render.seed, job);
                             const double seconds = seconds_since(start);
                             if (r.complete) p.error = error_of(r.image, truth);
                             return Run{seconds, double(r.samples)};
                         }});
    const std::vector<Timing> times = bench.measure("estimators", cases);
    points.resize(times.size());  // a signal may have left out the last cases
    for (std::size_t i = 0; i < times.size(); ++i) points[i].time = times[i];
    return points;
}

/// Adds a row with the errors and times of all ways and, for each way and clock, the shortest measured time to the error of
/// papers_samples random points, divided by the time that those take.
void report(const BenchView& view, const Reference& reference, const std::vector<Spent>& points, Bench& bench) {
    const auto wanted = std::find_if(points.begin(), points.end(),
                                     [](const Spent& p) { return p.estimator == &papers && p.samples == papers_samples; });
    Json rows = Json::array();
    std::string text = fmt::format("reference: {} samples a pixel, error {:.6f}\n", reference.samples, reference.rmse);
    for (const Spent& p : points) {
        rows.push_back({{"estimator", p.estimator->name},
                        {"samples", p.samples},
                        {"rmse", p.error.rmse},
                        {"brightness_error", p.error.brightness},
                        {"seconds", spread(p.time)}});
        text += fmt::format("  {:<20} {:5} samples   RMSE {:.6f}   brightness {:+.3f} %   {:.5f} s ({:.5f} .. {:.5f})\n",
                            p.estimator->name, p.samples, p.error.rmse, p.error.brightness * 100, p.time.median(),
                            p.time.seconds.front(), p.time.seconds.back());
    }
    Json all{{"display", view.display.name},
             {"content", view.content},
             {"angle_deg", bench.settings.angle_deg},
             {"crop", {view.crop.x0, view.crop.y0, view.crop.x1, view.crop.y1}},
             {"reference", {{"samples", reference.samples}, {"rmse", reference.rmse}}},
             {"points", rows}};
    if (wanted != points.end())
        for (const Ratio& c : printed_ratios) {
            text += fmt::format("  {} to the RMSE of {} samples of \"{}\", over theirs:", c.name, papers_samples, papers.name);
            Json ratios = Json::object();
            for (const Contender& e : estimators) {
                const std::optional<double> seconds = seconds_to(wanted->error.rmse, e, points, c.clock);
                const double ratio = seconds ? *seconds / (wanted->time.*c.clock)() : NAN;  // null in JSON
                ratios[e.name] = ratio;
                text += fmt::format(" {} {};", e.name, seconds ? fmt::format("{:.3f}", ratio) : "not reached");
            }
            text.back() = '\n';
            all[c.key] = std::move(ratios);
        }
    text.pop_back();
    bench.row("estimators", std::move(all), text);
}

void compare_estimators(const BenchView& view, Bench& bench) {
    bench.heading("Error against time: " + view.name());
    const std::optional<Reference> reference = reference_of(view, bench);
    if (!reference) return;
    if (reference->samples <= 2)
        return bench.not_measured("estimators", view.name(), "without diffuser, pixel filter and pupil one ray is exact");
    const std::vector<Spent> points = points_of(view, reference->image, bench);
    if (!points.empty()) report(view, *reference, points, bench);
}

// The part of the frame that is compared: --crop, or the middle of the frame, an eighth of its width and height (eyes and nose of
// the monkey), with --quick a 32nd. Throws InputError if the crop is wrong.
Rect crop_of(const Display& d, const BenchSettings& settings) {
    const auto [width, height] = d.camera.resolution;
    if (!settings.crop.empty()) return rectangle("--crop", settings.crop, width, height);
    const auto part = [&](std::int64_t n) { return int(std::max<std::int64_t>(1, n / (settings.quick ? 32 : 8))); };
    const int w = part(width), h = part(height), x = (int(width) - w) / 2, y = (int(height) - h) / 2;
    return {x, y, x + w, y + h};
}

/// Moves the camera about the vertical through its target, to the viewer's right for positive angles.
void walk(Camera& camera, double angle_deg) {
    const double a = angle_deg * degree, x = camera.position_mm[0] - camera.target_mm[0],
                 z = camera.position_mm[2] - camera.target_mm[2];
    camera.position_mm[0] = camera.target_mm[0] + x * std::cos(a) + z * std::sin(a);
    camera.position_mm[2] = camera.target_mm[2] + z * std::cos(a) - x * std::sin(a);
}

}  // namespace

std::vector<Display> bench_displays(const BenchSettings& settings) {
    std::vector<Display> all;
    Faults faults;
    for (const std::string& file : settings.displays) faults.of([&] { all.push_back(read_display(file)); });
    if (settings.displays.empty()) all.push_back(bench_display());
    for (Display& d : all) {
        walk(d.camera, settings.angle_deg);
        if (const std::vector<Problem> wrong = validate(d); !wrong.empty())
            faults.of([&] { throw InputError("--angle-deg", d.name + ": " + wrong.front().what); });
    }
    for (const Display& d : all)
        faults.of([&] {
            const Rect crop = crop_of(d, settings);
            require_picture_memory(crop.x1 - crop.x0, crop.y1 - crop.y0,
                                   texel_bytes(d) + picture_bytes(d.panel.pixels[0], d.panel.pixels[1]));
        });
    faults.report();
    return all;
}

void bench_estimators(Bench& bench) {
    for (Display& display : bench_displays(bench.settings)) {
        if (bench.settings.model_given || display.content.model.empty()) display.content.model = bench.settings.model;
        display.content.objects.clear();
        const Geometry geometry = resolve(display);
        const Rect crop = crop_of(display, bench.settings);
        const auto compare_with = [&](const std::string& content, const Image& shown) {
            if (!bench.cancelled())
                compare_estimators({display, content, shown_texels(shown, display.panel.encoding), crop}, bench);
        };
        compare_with("checkerboard", pattern("checkerboard", display, geometry));
        const std::filesystem::path model = display.content.model;
        if (bench.cancelled()) return;
        if (!std::filesystem::exists(model)) {
            bench.not_measured("estimators", display.name + ", model", model.string() + " does not exist; give --model");
            continue;
        }
        const ContentScene scene = load_scene(display, geometry);
        compare_with(model.filename(), elemental_images(display, geometry, scene, bench.settings.threads, bench.job()).image);
    }
}

}  // namespace lfdsim::cli
