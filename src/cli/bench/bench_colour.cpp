#include "cli/bench/bench.h"
#include "cli/bench/bench_cases.h"
#include "display/colour.h"
#include "engine/estimator/panel_planes.h"
#include "engine/render.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

// Group "colour": the time of a picture with three wavelengths relative to that with one, and of a panel with subpixels relative to
// whole pixels. The pictures are checked, too: the time of a wrong picture is worth nothing.
namespace lfdsim::cli {
namespace {

/// A display without and with colour, and the error of the latter's picture.
struct ColourCase {
    const char* name;
    void (*plain)(Display&);
    void (*colour)(Display&);
    const char* error_name;
    double (*error)(const Display& plain, const Display& colour, const Rect&, Bench&);  // 0 for a correct picture
};

Image picture_of(const Display& d, const Texels& panel, const Rect& crop, Bench& bench) {
    return render(d, resolve(d), panel, {bench.settings.threads, bench.settings.kernel, crop}, bench.job()).image;
}

/// The greatest difference, in linear light, between a channel and its picture through glass of the constant index that the glass
/// has at the channel's wavelength.
double bands_error(const Display&, const Display& colour, const Rect& crop, Bench& bench) {
    const Texels panel = noise_panel(colour);
    const Image all = picture_of(colour, panel, crop, bench);
    float greatest = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        const Image one = picture_of(at_wavelength(colour, colour.panel.wavelengths_nm[c]), panel, crop, bench);
        for (std::size_t i = c; i < all.rgb.size(); i += 3) greatest = std::max(greatest, std::abs(all.rgb[i] - one.rgb[i]));
    }
    return double(greatest);
}

/// The error of a white panel: the mean light of its picture divided by that with whole pixels, less 1.
double white_error(const Display& plain, const Display& colour, const Rect& crop, Bench& bench) {
    const auto light = [&](const Display& d) {
        Texels white(d.panel.pixels[0], d.panel.pixels[1]);
        std::fill_n(white.data(), white.columns() * white.rows() * 4, 1.0f);
        double sum = 0;
        for (const float one : picture_of(d, white, crop, bench).rgb) sum += double(one);
        return sum;
    };
    return light(colour) / light(plain) - 1;
}

constexpr ColourCase pairs[] = {
    {"asphere, three bands over one", make_asphere,
     [](Display& d) {
         make_asphere(d);
         Surface& flat = d.lens.as<SurfaceLens>().surfaces[0];
         flat.index.reset();
         flat.glass = Glass{"", Formula::nd_vd, {1.49, 57.4}};
     },
     "greatest difference from constant indices", bands_error},
    {"strips, stripes over whole pixels", make_strips,
     [](Display& d) {
         make_strips(d);
         d.panel.subpixels = SubpixelLayout::rgb_stripe;
         d.panel.aperture_ratio = 0.65;
     },
     "white's mean, less 1", white_error},
};

constexpr Duty estimators_of_colour[] = {{"points", [](Display& d) { d.render.estimator = Estimator::point; }},
                                         {"filtered", [](Display& d) {
                                              d.render.estimator = Estimator::filtered;
                                              d.render.samples = 4;
                                          }}};

void compare(const ColourCase& pair, const Duty& estimator, Bench& bench) {
    Display displays[2] = {bench_display(), bench_display()};
    pair.plain(displays[0]);
    pair.colour(displays[1]);
    for (Display& d : displays) estimator.change(d);
    const Rect crop = band(displays[0], bench.settings.quick ? 16 : 216);
    const double error = pair.error(displays[0], displays[1], crop, bench);
    const Texels texels = noise_panel(displays[0]);
    const SummedPanel panel(texels, bench.settings.threads);
    for (const Display& d : displays) planes_of(panel, panel_reading(d));  // builds the tables before anything is timed
    std::vector<Case> cases;
    for (const Display& d : displays)
        cases.push_back(rendering(pair.name, d, panel, {bench.settings.threads, bench.settings.kernel, crop}));
    const std::vector<Timing> times = bench.measure("colour", cases);
    if (times.size() < 2) return;  // after a signal
    const auto [values, text] = over(times[1], times[0]);
    Json row{{"name", pair.name}, {"estimator", estimator.name}};
    row.update(values);
    row["error"] = {{"of", pair.error_name}, {"value", error}};
    bench.row("colour", std::move(row),
              fmt::format("{:<34} {:<9} {}; {} {:.2g}", pair.name, estimator.name, text, pair.error_name, error));
}

}  // namespace

void bench_colour(Bench& bench) {
    bench.heading("Colour: time of a picture relative to that without the feature, the middle rows of 3840 x 2160");
    for (const ColourCase& pair : pairs)
        for (const Duty& estimator : estimators_of_colour)
            if (!bench.cancelled()) compare(pair, estimator, bench);
}

}  // namespace lfdsim::cli
