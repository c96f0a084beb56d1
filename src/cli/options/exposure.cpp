#include "cli/options/exposure.h"

#include "cli/program/arguments.h"
#include "engine/views/screen.h"
#include "image/compare/region.h"

#include <fmt/format.h>
#include <algorithm>

namespace lfdsim::cli {
namespace {

/// Returns the mean light of the pixels that show the screen, over all colours.
double mean_light(const Image& image, const Region& screen) {
    double sum = 0;
    for (std::size_t k = 0; k < screen.rows.size(); ++k)
        for (int x = screen.rows[k].from; x < screen.rows[k].to; ++x) {
            const float* const light = image.at(x, screen.top + int(k));
            sum += double(light[0]) + double(light[1]) + double(light[2]);
        }
    return sum / (3 * double(screen.pixels()));
}

}  // namespace

void ExposureOption::check() const {
    const std::string& text = exposure_.text();
    if (text.empty() || text == "auto") return;
    const bool may_be_number = text.find_first_not_of("0123456789.+-eE") == std::string::npos;
    if (!may_be_number) throw InputError("--exposure", fmt::format("is \"{}\"; give a number such as 0.5, or auto", text));
    if (!(exposure_.number() > 0)) throw InputError("--exposure", fmt::format("is {}, allowed is more than 0, or auto", text));
}

std::optional<double> ExposureOption::factor(const Display& display, const Geometry& geometry, RenderOptions options,
                                             Job& job) const {
    if (exposure_.empty()) return {};
    if (exposure_.text() != "auto") return exposure_.number();
    const auto [columns, rows] = display.panel.pixels;
    Texels white(columns, rows);
    std::fill_n(white.data(), columns * rows * 4, 1.f);
    options.target_error.reset();
    options.crop.reset();  // parts of a picture have the exposure of the whole
    const Rendering r = render(display, geometry, white, options, job);
    const Region screen = screen_region(display, geometry).value_or(Region::of({0, 0, r.image.width, r.image.height}));
    const double mean = screen.pixels() > 0 ? mean_light(r.image, screen) : 0;
    if (!(mean > 0))
        throw InputError("--exposure", "is auto, but this picture would be dark even with a white panel; give a number");
    return 1 / mean;
}

void ExposureOption::apply(double factor, Rendering& r) {
    for (std::vector<float>* light : {&r.image.rgb, &r.error.rgb})
        for (float& x : *light) x *= float(factor);
    if (r.measured_error) *r.measured_error *= factor;
}

}  // namespace lfdsim::cli
